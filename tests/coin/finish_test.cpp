#include <Inventor/SoDB.h>
#include <gtest/gtest.h>

#include "coin/scenes.hpp"
#include "coin/stage.hpp"

namespace umbrage::coin::test {
namespace {

// Coin can be left, as SoQt::done() does; nothing of it can be used afterwards, so this has a program of its own.
TEST(Finish, OfCoinWorksAfterPicturesWithShadows) {
  {
    const auto stage = Stage::make(160, 120);
    if (stage != nullptr) {
      const auto root = sceneOf(room("", kThreeLights, "ShadowStyle { style CASTS_SHADOW }" + kSolids));
      stage->draw(root.get());
      EXPECT_FALSE(groupOf(root.get())->lastError());
    } else {
      startCoin();
    }
  }
  SoDB::finish();
}

}  // namespace
}  // namespace umbrage::coin::test

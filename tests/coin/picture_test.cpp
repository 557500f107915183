#include <gtest/gtest.h>

#include "coin/scenes.hpp"
#include "coin/stage.hpp"
#include "coin/truth.hpp"
#include "umbrage/coin/exact_shadow_group.hpp"

namespace umbrage::coin::test {
namespace {

TEST(Picture, ShadowsStandWhereRaysSayAndNowhereElse) {
  const auto stage = Stage::make(320, 240);
  if (!stage) GTEST_SKIP() << "no OpenGL here";
  for (const char* method : {"AUTOMATIC", "Z_PASS", "Z_FAIL", "RAY_TRACED"}) {
    const auto root = sceneOf(room(std::string("method ") + method, kThreeLights, kSolids));
    auto* group = groupOf(root.get());
    const auto shadowed = stage->draw(root.get());
    ASSERT_FALSE(group->lastError()) << group->lastError()->text();
    expectTrueShadows(*group, method);
    expectCoinsOwnPicture(*stage, root.get(), *group, shadowed);
    EXPECT_GT(group->report().passes, 3u);
    save(shadowed, std::string("coin_") + method);
  }
}

}  // namespace
}  // namespace umbrage::coin::test

#pragma once

#include <gtest/gtest.h>

#include <string>

#include "coin/scenes.hpp"
#include "coin/stage.hpp"
#include "coin/truth.hpp"

// What tests of single pictures share.
namespace umbrage::coin::test {

constexpr int kWidth = 320, kHeight = 240;

#define STAGE_OR_SKIP(stage)                       \
  const auto stage = Stage::make(kWidth, kHeight); \
  if (!stage) GTEST_SKIP() << "no OpenGL here"

/// Draws it, and holds masks and picture against the truth.
inline image::RgbaImage judged(Stage& stage, SoNode* root, const std::string& what) {
  auto* group = groupOf(root);
  const auto picture = stage.draw(root);
  EXPECT_FALSE(group->lastError()) << what << ": " << group->lastError()->text();
  expectTrueShadows(*group, what);
  expectCoinsOwnPicture(stage, root, *group, picture);
  save(picture, "coin_" + what);
  return picture;
}

inline std::size_t shadowed(const LightShadow& light) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < light.mask.light.size(); ++i)
    count += light.mask.covered.pixels()[i] != 0 && light.mask.light.pixels()[i] == 0;
  return count;
}

/// Coin's own number of render caches for as long as it lives; the other tests have none.
class CachesAsCoinHasThem {
 public:
  CachesAsCoinHasThem() { SoSeparator::setNumRenderCaches(2); }
  CachesAsCoinHasThem(const CachesAsCoinHasThem&) = delete;
  CachesAsCoinHasThem& operator=(const CachesAsCoinHasThem&) = delete;
  ~CachesAsCoinHasThem() { SoSeparator::setNumRenderCaches(0); }
};

}  // namespace umbrage::coin::test

#pragma once

#include <string>

#include "coin/stage.hpp"
#include "umbrage/coin/exact_shadow_group.hpp"

namespace umbrage::coin::test {

/// How masks compare with rays.
struct Strayed {
  std::size_t masks = 0, covered = 0, differing = 0, far = 0;
};

/// The masks of a report against ray_traced, by the judge's rule: a pixel that differs is far unless a true edge is near it. Pixels where rays meet
/// first what the picture looks through are left out: the depth test knows them.
/// REQUIRES: the report has a camera.
[[nodiscard]] Strayed strayed(const ShadowReport& report);

/// No pixel is far.
void expectTrueShadows(const SoExactShadowGroup& group, const std::string& what);

/// Where all lights reach, the picture is the one that Coin draws without shadows (within 2/255); where a light does not reach, it is the one that Coin
/// draws without that light. Where Coin puts shapes off (transparent ones, annotations), they are in full light, and only the first is looked at.
void expectCoinsOwnPicture(Stage& stage, SoNode* root, SoExactShadowGroup& group, const image::RgbaImage& shadowed);

/// As NAME.png in the folder that UMBRAGE_TEST_PICTURES names, if any: to be looked at.
void save(const image::RgbaImage& picture, const std::string& name);

}  // namespace umbrage::coin::test

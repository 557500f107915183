#include "coin/truth.hpp"

#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/elements/SoLazyElement.h>
#include <Inventor/elements/SoMultiTextureImageElement.h>
#include <Inventor/nodes/SoAnnotation.h>
#include <Inventor/nodes/SoLight.h>
#include <Inventor/nodes/SoShape.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <vector>

#include "coin/scenes.hpp"
#include "umbrage/png/png.hpp"
#include "umbrage/shadow/edge_finder.hpp"
#include "umbrage/techniques/cpu/registry.hpp"

namespace umbrage::coin::test {
namespace {

constexpr std::size_t kMostLookedAt = 256;  ///< a mask with more suspicious pixels than this is simply wrong
constexpr std::size_t kMostSets =
    24;  ///< of lights that do not reach some pixels, each drawn once more: those of most pixels

bool edgeWithin(const image::GreyImage& edges, int x, int y) {
  for (int v = y - 1; v <= y + 1; ++v)
    for (int u = x - 1; u <= x + 1; ++u)
      if (edges.contains(u, v) && edges(u, v) != 0) return true;
  return false;
}

/// Pixels where rays see what the picture's view looks through, which they know nothing of; with their neighbours, where chance says what is seen.
image::GreyImage beyondJudgement(const ShadowReport& report, const image::Image<std::uint32_t>& triangle) {
  image::GreyImage out(triangle.width(), triangle.height());
  if (report.unseen.empty()) return out;
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x) {
      if (triangle(x, y) == shadow::kNoTriangle || report.unseen[triangle(x, y)] == 0) continue;
      for (const int v : {y - 1, y, y + 1})
        for (const int u : {x - 1, x, x + 1})
          if (out.contains(u, v)) out(u, v) = 1;
    }
  }
  return out;
}

void judge(const LightShadow& given, const shadow::LightMask& truth, const image::GreyImage& left,
           const scene::Camera& camera, const shadow::EdgeFinder& finder, Strayed& out) {
  const auto edges = shadow::edgePixels(truth);
  std::size_t lookedAt = 0;
  ++out.masks;
  for (int y = 0; y < edges.height(); ++y) {
    for (int x = 0; x < edges.width(); ++x) {
      if (left(x, y) != 0) continue;
      out.covered += truth.covered(x, y);
      if (given.mask.covered(x, y) == truth.covered(x, y) && given.mask.light(x, y) == truth.light(x, y)) continue;
      ++out.differing;
      if (edgeWithin(edges, x, y)) continue;
      if (++lookedAt <= kMostLookedAt && finder.edgeNear(camera, given.light, x, y).value_or(false)) continue;
      ++out.far;
    }
  }
}

std::vector<SoNode*> nodesOf(const ShadowReport& report) {
  std::vector<SoNode*> nodes;
  for (const LightShadow& light : report.lights) nodes.push_back(const_cast<SoNode*>(light.node));
  return nodes;
}

bool hasDelayed(SoNode* root) {
  bool found = false;
  SoCallbackAction action;
  const auto annotation = [](void* data, SoCallbackAction*, const SoNode*) {
    *static_cast<bool*>(data) = true;
    return SoCallbackAction::CONTINUE;
  };
  const auto shape = [](void* data, SoCallbackAction* a, const SoNode*) {
    SoState* state = a->getState();
    *static_cast<bool*>(data) |= SoMultiTextureImageElement::containsTransparency(state) != FALSE;
    for (int i = 0; i < SoLazyElement::getInstance(state)->getNumTransparencies(); ++i)
      *static_cast<bool*>(data) |= SoLazyElement::getTransparency(state, i) > 0.0f;
    return SoCallbackAction::PRUNE;
  };
  action.addPreCallback(SoAnnotation::getClassTypeId(), annotation, &found);
  action.addPreCallback(SoShape::getClassTypeId(), shape, &found);
  action.apply(root);
  return found;
}

}  // namespace

Strayed strayed(const ShadowReport& report) {
  Strayed out;
  if (report.lights.empty()) return out;
  std::shared_ptr<shadow::Technique> truth = std::move(*techniques::cpuTechniques().front().create());
  if (!truth->prepare(report.geometry)) return out;
  std::vector<scene::Light> lights;
  for (const LightShadow& light : report.lights) lights.push_back(light.light);
  const auto shading = truth->shade({*report.camera, lights});
  const shadow::EdgeFinder finder(report.geometry, truth);
  const auto left = beyondJudgement(report, shading->surface.triangle);
  for (std::size_t i = 0; i < lights.size(); ++i)
    judge(report.lights[i], shading->masks[i], left, *report.camera, finder, out);
  return out;
}

void expectTrueShadows(const SoExactShadowGroup& group, const std::string& what) {
  const ShadowReport& report = group.report();
  ASSERT_TRUE(report.camera) << what;
  const Strayed s = strayed(report);
  EXPECT_GT(s.covered, 0u) << what;
  EXPECT_EQ(s.far, 0u) << what << ": of " << s.covered << " pixels " << s.differing << " differ";
}

void expectCoinsOwnPicture(Stage& stage, SoNode* root, SoExactShadowGroup& group, const image::RgbaImage& shadowed) {
  const ShadowReport report = group.report();
  // Which lights do not reach a pixel, as bits.
  image::Image<std::uint64_t> off(shadowed.width(), shadowed.height());
  std::map<std::uint64_t, std::size_t> pixels;
  for (std::size_t i = 0; i < off.size(); ++i) {
    for (std::size_t k = 0; k < report.lights.size(); ++k) {
      const auto& mask = report.lights[k].reach;
      off.pixels()[i] |= std::uint64_t{mask.covered.pixels()[i] != 0 && mask.light.pixels()[i] == 0} << k;
    }
    ++pixels[off.pixels()[i]];
  }
  std::vector<std::pair<std::size_t, std::uint64_t>> sets;
  for (const auto& [set, count] : pixels) sets.emplace_back(count, set);
  std::ranges::sort(sets, std::greater());
  sets.resize(std::min(sets.size(), kMostSets));
  const auto nodes = nodesOf(report);
  group.isActive = FALSE;
  const bool delays = hasDelayed(root);
  for (const auto& [count, set] : sets) {
    if (delays && set != 0) continue;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      if ((set >> k & 1u) != 0) static_cast<SoLight*>(nodes[k])->on = FALSE;
    const auto own = stage.draw(root);
    for (SoNode* node : nodes) static_cast<SoLight*>(node)->on = TRUE;
    const Difference found =
        largestDifference(own, shadowed, [&, only = set](int x, int y) { return off(x, y) == only; });
    EXPECT_LE(found.most, 2) << "lights off: " << set << ", " << found.pixels << " of " << count
                             << " pixels, the worst at " << found.x << ", " << found.y;
  }
  group.isActive = TRUE;
}

void save(const image::RgbaImage& picture, const std::string& name) {
  const char* folder = std::getenv("UMBRAGE_TEST_PICTURES");
  if (folder == nullptr) return;
  image::RgbImage opaque(picture.width(), picture.height());
  for (std::size_t i = 0; i < opaque.size(); ++i) {
    const auto& p = picture.pixels()[i];
    opaque.pixels()[i] = {p.r, p.g, p.b};
  }
  EXPECT_TRUE(png::write(std::string(folder) + "/" + name + ".png", opaque));
}

}  // namespace umbrage::coin::test

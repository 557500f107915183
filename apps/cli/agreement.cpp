#include "agreement.hpp"

#include <algorithm>
#include <utility>

#include "umbrage/shadow/true_edges.hpp"

namespace umbrage::cli {
namespace {

constexpr const char* kTruth = "ray_traced";
constexpr int kSamples = 32;
constexpr std::size_t kMostLookedAt = 256;  // a mask with more suspicious pixels is simply wrong

using Pixel = std::pair<int, int>;

bool edgeNear(const image::GreyImage& edges, Pixel pixel, int tolerance) {
  for (int y = pixel.second - tolerance; y <= pixel.second + tolerance; ++y)
    for (int x = pixel.first - tolerance; x <= pixel.first + tolerance; ++x)
      if (edges.contains(x, y) && edges(x, y) != 0) return true;
  return false;
}

std::vector<Pixel> suspects(const shadow::LightMask& mask, const shadow::LightMask& truth, int tolerance) {
  const auto edges = shadow::edgePixels(truth);
  std::vector<Pixel> pixels;
  for (int y = 0; y < edges.height(); ++y)
    for (int x = 0; x < edges.width(); ++x) {
      const bool same = mask.covered(x, y) == truth.covered(x, y) && mask.light(x, y) == truth.light(x, y);
      if (!same && !edgeNear(edges, {x, y}, tolerance)) pixels.emplace_back(x, y);
    }
  return pixels;
}

/// Looks at single pixels closely, with rays.
class Magnifier {
 public:
  static Result<Magnifier> make(const std::shared_ptr<const shadow::Geometry>& geometry) {
    auto chosen = chooseTechnique(kTruth);
    if (!chosen) return tl::unexpected(chosen.error());
    if (const auto prepared = chosen->technique->prepare(geometry); !prepared) return tl::unexpected(prepared.error());
    return Magnifier(geometry, std::move(chosen->technique));
  }

  /// Is there a true edge in the pixel or one of its eight neighbours?
  [[nodiscard]] Result<bool> seesEdge(const scene::Camera& camera, const scene::Light& light, Pixel pixel) const {
    const scene::Camera fine = shadow::magnified(camera, pixel.first, pixel.second, kSamples);
    const auto truth = technique_->shade({fine, {&light, 1}});
    if (!truth) return tl::unexpected(truth.error());
    scene::Camera window = fine;
    window.width = window.height = 1;
    const auto edges = shadow::trueEdges(geometry_->surfaces, window, fine.width, truth->surface, truth->masks.front());
    return edges(0, 0) != 0;
  }

 private:
  Magnifier(std::shared_ptr<const shadow::Geometry> geometry, std::unique_ptr<shadow::Technique> technique)
      : geometry_(std::move(geometry)), technique_(std::move(technique)) {}
  std::shared_ptr<const shadow::Geometry> geometry_;
  std::unique_ptr<shadow::Technique> technique_;
};

}  // namespace

Result<std::vector<Agreement>> compareMasks(const Drawing& mine, const Drawing& theirs, const View& view,
                                            const std::shared_ptr<const shadow::Geometry>& geometry) {
  const bool swapped = mine.traits.name == kTruth;
  const auto& masks = (swapped ? theirs : mine).shading.masks;
  const auto& truths = (swapped ? mine : theirs).shading.masks;
  const int tolerance = std::max(mine.traits.edgeTolerancePx, theirs.traits.edgeTolerancePx);
  const auto magnifier = Magnifier::make(geometry);
  if (!magnifier) return tl::unexpected(magnifier.error());
  std::vector<Agreement> lights;
  for (std::size_t i = 0; i < masks.size(); ++i) {
    const auto difference = shadow::compare(masks[i], truths[i], shadow::edgePixels(truths[i]), tolerance);
    const auto pixels = suspects(masks[i], truths[i], tolerance);
    Agreement agreement{difference.differing, pixels.size(), difference.covered};
    for (std::size_t k = 0; k < pixels.size() && pixels.size() <= kMostLookedAt; ++k) {
      const auto edge = magnifier->seesEdge(view.camera, view.lights[i], pixels[k]);
      if (!edge) return tl::unexpected(edge.error());
      if (*edge) --agreement.astray;
    }
    lights.push_back(agreement);
  }
  return lights;
}

}  // namespace umbrage::cli

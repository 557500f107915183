#include "judging.hpp"

#include <algorithm>
#include <cmath>

namespace umbrage::cli {
namespace {

constexpr image::Rgb8 kWrong{220, 0, 0};
constexpr double kFaintest = 0.25;  // of what differs at all, so that it is seen

Result<shadow::EdgeFinder> edgeFinderFor(const std::shared_ptr<const shadow::Geometry>& geometry,
                                         const std::string& name) {
  auto truth = chooseTechnique(name);
  if (!truth) return tl::unexpected(truth.error());
  if (const auto prepared = truth->technique->prepare(geometry); !prepared) return tl::unexpected(prepared.error());
  return shadow::EdgeFinder(geometry, std::move(truth->technique));
}

std::uint8_t mixed(std::uint8_t a, std::uint8_t b, double part) {
  return static_cast<std::uint8_t>(std::lround(a + part * (b - a)));
}

void redden(image::Rgb8& pixel, int difference) {
  const double part = std::max(kFaintest, std::sqrt(difference / 255.0));
  pixel = {mixed(pixel.r, kWrong.r, part), mixed(pixel.g, kWrong.g, part), mixed(pixel.b, kWrong.b, part)};
}

}  // namespace

const char* truthFor(const shadow::Traits& traits) {
  return traits.soft ? "soft_rays" : traits.tinted ? "transparent_rays" : "ray_traced";
}

Result<std::vector<Agreement>> compareDrawings(const Drawing& a, const Drawing& b, const View& view,
                                               const std::shared_ptr<const shadow::Geometry>& geometry) {
  const auto edges = edgeFinderFor(geometry, truthFor(a.traits));
  if (!edges) return tl::unexpected(edges.error());
  const bool swapped = a.traits.name == truthFor(a.traits);
  const int tolerance = std::max(a.traits.edgeTolerancePx, b.traits.edgeTolerancePx);
  return compareMasks((swapped ? b : a).shading.masks, (swapped ? a : b).shading.masks, {view.camera, view.lights},
                      tolerance, *edges);
}

image::RgbImage differencePicture(const Drawing& a, const Drawing& b) {
  const auto& seen = b.shading.surface.triangle;
  image::RgbImage picture(seen.width(), seen.height(), image::Rgb8{255, 255, 255});
  for (std::size_t light = 0; light < b.shading.masks.size(); ++light) {
    const auto mine = shadow::fileImage(a.shading.masks[light]);
    const auto theirs = shadow::fileImage(b.shading.masks[light]);
    for (std::size_t i = 0; i < picture.size(); ++i) {
      auto& pixel = picture.pixels()[i];
      const int difference = std::abs(mine.pixels()[i] - theirs.pixels()[i]);
      if (light == 0) pixel.r = pixel.g = pixel.b = static_cast<std::uint8_t>(160 + theirs.pixels()[i] / 3);
      if (difference != 0) redden(pixel, difference);
    }
  }
  return picture;
}

}  // namespace umbrage::cli

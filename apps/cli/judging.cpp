#include "judging.hpp"

#include <algorithm>
#include <cmath>

#include "umbrage/shadow/unshadowed.hpp"

namespace umbrage::cli {
namespace {

constexpr image::Rgb8 kWrong{220, 0, 0}, kUnknown{150, 175, 215};
constexpr double kFaintest = 0.25;  // of what differs at all, so that it is seen

Result<std::unique_ptr<shadow::Technique>> prepared(const std::string& name,
                                                    const std::shared_ptr<const shadow::Geometry>& geometry) {
  auto chosen = chooseTechnique(name);
  if (!chosen) return tl::unexpected(chosen.error());
  if (const auto done = chosen->technique->prepare(geometry); !done) return tl::unexpected(done.error());
  return std::move(chosen->technique);
}

int toleranceOf(const Drawing& a, const Drawing& b) {
  return std::max(a.traits.edgeTolerancePx, b.traits.edgeTolerancePx);
}

/// Masks of which what is not known is taken from the other drawing.
std::vector<shadow::LightMask> knownMasks(const Drawing& drawing, const Drawing& other) {
  std::vector<shadow::LightMask> masks = drawing.shading.masks;
  for (std::size_t i = 0; i < masks.size() && !drawing.shading.unshadowed.empty(); ++i)
    masks[i] = shadow::whereKnown(std::move(masks[i]), drawing.shading.unshadowed, other.shading.masks[i]);
  return masks;
}

std::uint8_t mixed(std::uint8_t a, std::uint8_t b, double part) {
  return static_cast<std::uint8_t>(std::lround(a + part * (b - a)));
}

void redden(image::Rgb8& pixel, int difference) {
  const double part = std::max(kFaintest, std::sqrt(difference / 255.0));
  pixel = {mixed(pixel.r, kWrong.r, part), mixed(pixel.g, kWrong.g, part), mixed(pixel.b, kWrong.b, part)};
}

}  // namespace

const char* truthFor(const shadow::Traits& traits, const View& view) {
  const bool soft = traits.soft && (traits.tinted || std::ranges::any_of(view.lights, scene::isArea));
  return soft ? "soft_rays" : traits.tinted ? "transparent_rays" : "ray_traced";
}

std::size_t unknownPixels(const Drawing& drawing) {
  return static_cast<std::size_t>(std::ranges::count(drawing.shading.unshadowed.pixels(), std::uint8_t{1}));
}

Result<std::vector<Agreement>> compareDrawings(const Drawing& a, const Drawing& b, const View& view,
                                               const std::shared_ptr<const shadow::Geometry>& geometry) {
  const std::string name = truthFor(a.traits, view);
  auto truth = prepared(name, geometry);
  if (!truth) return tl::unexpected(truth.error());
  const shadow::EdgeFinder edges(geometry, std::move(*truth));
  const bool swapped = a.traits.name == name;
  const auto ofA = knownMasks(a, b), ofB = knownMasks(b, a);
  return compareMasks(swapped ? ofB : ofA, swapped ? ofA : ofB, {view.camera, view.lights}, toleranceOf(a, b), edges);
}

Result<std::vector<VeilAgreement>> compareVeilsOf(const Drawing& a, const Drawing& b, const View& view,
                                                  const std::shared_ptr<const shadow::Geometry>& geometry) {
  if (a.shading.veils.empty() && b.shading.veils.empty()) return std::vector<VeilAgreement>();
  const std::string name = truthFor(a.traits, view);
  const auto truth = prepared(name, geometry);
  if (!truth) return tl::unexpected(truth.error());
  const bool swapped = a.traits.name == name;
  const shadow::Frame frame{
      .camera = view.camera, .lights = view.lights, .veilLayers = view.veilLayers, .soft = view.soft};
  return compareVeils((swapped ? b : a).shading, (swapped ? a : b).shading, frame, geometry->filters, toleranceOf(a, b),
                      **truth);
}

image::RgbImage differencePicture(const Drawing& a, const Drawing& b) {
  const auto& seen = b.shading.surface.triangle;
  image::RgbImage picture(seen.width(), seen.height(), image::Rgb8{255, 255, 255});
  const auto ofA = knownMasks(a, b), ofB = knownMasks(b, a);
  for (std::size_t light = 0; light < b.shading.masks.size(); ++light) {
    const auto mine = shadow::fileImage(ofA[light]), theirs = shadow::fileImage(ofB[light]);
    for (std::size_t i = 0; i < picture.size(); ++i) {
      auto& pixel = picture.pixels()[i];
      const int difference = std::abs(mine.pixels()[i] - theirs.pixels()[i]);
      if (light == 0) pixel.r = pixel.g = pixel.b = static_cast<std::uint8_t>(160 + theirs.pixels()[i] / 3);
      if (difference != 0) redden(pixel, difference);
    }
  }
  for (const auto* drawing : {&a, &b})
    for (std::size_t i = 0; i < drawing->shading.unshadowed.size(); ++i)
      if (drawing->shading.unshadowed.pixels()[i] != 0) picture.pixels()[i] = kUnknown;
  return picture;
}

}  // namespace umbrage::cli

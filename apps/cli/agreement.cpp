#include "agreement.hpp"

#include <cmath>
#include <utility>

namespace umbrage::cli {
namespace {

constexpr std::size_t kMostLookedAt = 256;  // a mask with more suspicious pixels is simply wrong

using Pixel = std::pair<int, int>;

bool edgeNear(const image::GreyImage& edges, Pixel pixel, int tolerance) {
  for (int y = pixel.second - tolerance; y <= pixel.second + tolerance; ++y)
    for (int x = pixel.first - tolerance; x <= pixel.first + tolerance; ++x)
      if (edges.contains(x, y) && edges(x, y) != 0) return true;
  return false;
}

std::vector<Pixel> suspects(const shadow::LightMask& mask, const shadow::LightMask& reference,
                            const image::GreyImage& edges, int tolerance) {
  std::vector<Pixel> pixels;
  for (int y = 0; y < edges.height(); ++y)
    for (int x = 0; x < edges.width(); ++x) {
      if (shadow::differAt(mask, reference, x, y) && !edgeNear(edges, {x, y}, tolerance)) pixels.emplace_back(x, y);
    }
  return pixels;
}

Vec3 lightAt(const shadow::LightMask& mask, std::size_t pixel) {
  return mask.tint.empty() ? Vec3(mask.light.pixels()[pixel] / 255.0) : shadow::partsOf(mask.tint.pixels()[pixel]);
}

double rmsDifference(const shadow::LightMask& mask, const shadow::LightMask& reference) {
  double squares = 0.0;
  std::size_t covered = 0;
  for (std::size_t i = 0; i < reference.covered.size(); ++i) {
    if (reference.covered.pixels()[i] == 0) continue;
    const Vec3 difference = lightAt(mask, i) - lightAt(reference, i);
    squares += glm::dot(difference, difference) / 3.0;
    ++covered;
  }
  return covered == 0 ? 0.0 : std::sqrt(squares / double(covered));
}

}  // namespace

Result<std::vector<Agreement>> compareMasks(std::span<const shadow::LightMask> mine,
                                            std::span<const shadow::LightMask> reference, const shadow::Frame& frame,
                                            int tolerance, const shadow::EdgeFinder& edges) {
  std::vector<Agreement> lights;
  for (std::size_t i = 0; i < mine.size(); ++i) {
    const auto shown = shadow::edgePixels(reference[i]);
    const auto difference = shadow::compare(mine[i], reference[i], shown, tolerance);
    const auto pixels = suspects(mine[i], reference[i], shown, tolerance);
    Agreement agreement{difference.differing, pixels.size(), difference.covered, rmsDifference(mine[i], reference[i])};
    for (std::size_t k = 0; k < pixels.size() && pixels.size() <= kMostLookedAt; ++k) {
      const auto edge = edges.edgeNear(frame.camera, frame.lights[i], pixels[k].first, pixels[k].second);
      if (!edge) return tl::unexpected(edge.error());
      if (*edge) --agreement.astray;
    }
    lights.push_back(agreement);
  }
  return lights;
}

}  // namespace umbrage::cli

#include "agreement.hpp"

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

}  // namespace

Result<std::vector<Agreement>> compareMasks(std::span<const shadow::LightMask> mine,
                                            std::span<const shadow::LightMask> reference, const shadow::Frame& frame,
                                            int tolerance, const shadow::EdgeFinder& edges) {
  std::vector<Agreement> lights;
  for (std::size_t i = 0; i < mine.size(); ++i) {
    const auto shown = shadow::edgePixels(reference[i]);
    const auto difference = shadow::compare(mine[i], reference[i], shown, tolerance);
    const auto pixels = suspects(mine[i], reference[i], shown, tolerance);
    Agreement agreement{difference.differing, pixels.size(), difference.covered};
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

#include "umbrage/shadow/light_mask.hpp"

namespace umbrage::shadow {
namespace {

constexpr std::uint8_t kNoSurfaceCode = 128;

bool anyNonzeroNear(const image::GreyImage& picture, int x, int y, int radius) {
  for (int v = y - radius; v <= y + radius; ++v)
    for (int u = x - radius; u <= x + radius; ++u)
      if (picture.contains(u, v) && picture(u, v) != 0) return true;
  return false;
}

bool differ(const LightMask& a, const LightMask& b, int x, int y) {
  if (a.covered(x, y) != b.covered(x, y) || a.light(x, y) != b.light(x, y)) return true;
  return !a.tint.empty() && !b.tint.empty() && !(a.tint(x, y) == b.tint(x, y));
}

}  // namespace

image::GreyImage fileImage(const LightMask& mask) {
  image::GreyImage out(mask.light.width(), mask.light.height());
  for (std::size_t i = 0; i < out.size(); ++i)
    out.pixels()[i] = mask.covered.pixels()[i] != 0 ? mask.light.pixels()[i] : kNoSurfaceCode;
  return out;
}

MaskDifference compare(const LightMask& mask, const LightMask& truth, const image::GreyImage& edges, int edgeTolerance) {
  UMBRAGE_CHECK(mask.light.width() == truth.light.width() && mask.light.height() == truth.light.height() &&
                    edges.width() == truth.light.width() && edges.height() == truth.light.height(),
                "masks of different sizes");
  MaskDifference difference;
  for (int y = 0; y < truth.light.height(); ++y) {
    for (int x = 0; x < truth.light.width(); ++x) {
      difference.covered += truth.covered(x, y) != 0;
      if (!differ(mask, truth, x, y)) continue;
      ++difference.differing;
      difference.farFromEdge += !anyNonzeroNear(edges, x, y, edgeTolerance);
    }
  }
  return difference;
}

image::GreyImage edgePixels(const LightMask& truth) {
  image::GreyImage edges(truth.light.width(), truth.light.height());
  const auto mark = [&](int x0, int y0, int x1, int y1) {
    if (!edges.contains(x1, y1)) return;
    const bool same = truth.covered(x0, y0) == truth.covered(x1, y1) && truth.light(x0, y0) == truth.light(x1, y1);
    if (!same) edges(x0, y0) = edges(x1, y1) = 255;
  };
  for (int y = 0; y < edges.height(); ++y) {
    for (int x = 0; x < edges.width(); ++x) {
      mark(x, y, x + 1, y);
      mark(x, y, x, y + 1);
    }
  }
  return edges;
}

}  // namespace umbrage::shadow

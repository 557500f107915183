#include "umbrage/shadow/light_mask.hpp"

#include <algorithm>
#include <cmath>

namespace umbrage::shadow {
namespace {

constexpr std::uint8_t kNoSurfaceCode = 128;
constexpr int kTintStep = 65535 / 255;  // below it no eye and no file tells tints apart

// The nearest of 8 bits: 65535 = 255 x 257.
std::uint8_t codeOf(std::uint16_t part) { return static_cast<std::uint8_t>((part + 128u) / 257u); }

int apart(std::uint16_t a, std::uint16_t b) { return std::abs(int(a) - int(b)); }

bool anyNonzeroNear(const image::GreyImage& picture, int x, int y, int radius) {
  for (int v = y - radius; v <= y + radius; ++v)
    for (int u = x - radius; u <= x + radius; ++u)
      if (picture.contains(u, v) && picture(u, v) != 0) return true;
  return false;
}

}  // namespace

bool differAt(const LightMask& a, const LightMask& b, int x, int y) {
  if (a.covered(x, y) != b.covered(x, y)) return true;
  if (a.tint.empty() || b.tint.empty()) return a.light(x, y) != b.light(x, y);
  const Tint &p = a.tint(x, y), &q = b.tint(x, y);
  return std::max({apart(p.r, q.r), apart(p.g, q.g), apart(p.b, q.b)}) > kTintStep;
}

image::GreyImage fileImage(const LightMask& mask) {
  image::GreyImage out(mask.light.width(), mask.light.height());
  for (std::size_t i = 0; i < out.size(); ++i)
    out.pixels()[i] = mask.covered.pixels()[i] != 0 ? mask.light.pixels()[i] : kNoSurfaceCode;
  return out;
}

Tint tintOf(const Vec3f& parts) {
  const auto code = [](float part) {
    return static_cast<std::uint16_t>(std::clamp(part, 0.0f, 1.0f) * 65535.0f + 0.5f);
  };
  return {code(parts.x), code(parts.y), code(parts.z)};
}

std::uint8_t luminanceCode(const Tint& tint) {
  return static_cast<std::uint8_t>(std::lround((0.2126 * tint.r + 0.7152 * tint.g + 0.0722 * tint.b) / 257.0));
}

image::RgbImage tintedFileImage(const LightMask& mask) {
  UMBRAGE_CHECK(!mask.tint.empty(), "a mask without a tint");
  image::RgbImage out(mask.tint.width(), mask.tint.height(), {kNoSurfaceCode, kNoSurfaceCode, kNoSurfaceCode});
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Tint& tint = mask.tint.pixels()[i];
    if (mask.covered.pixels()[i] != 0) out.pixels()[i] = {codeOf(tint.r), codeOf(tint.g), codeOf(tint.b)};
  }
  return out;
}

MaskDifference compare(const LightMask& mask, const LightMask& truth, const image::GreyImage& edges,
                       int edgeTolerance) {
  UMBRAGE_CHECK(mask.light.width() == truth.light.width() && mask.light.height() == truth.light.height() &&
                    edges.width() == truth.light.width() && edges.height() == truth.light.height(),
                "masks of different sizes");
  MaskDifference difference;
  for (int y = 0; y < truth.light.height(); ++y) {
    for (int x = 0; x < truth.light.width(); ++x) {
      difference.covered += truth.covered(x, y) != 0;
      if (!differAt(mask, truth, x, y)) continue;
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

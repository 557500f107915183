#include "umbrage/shadow/composite.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "umbrage/shadow/finders/threads.hpp"
#include "umbrage/shadow/painter.hpp"

namespace umbrage::shadow {
namespace {

constexpr int kCurveSteps = 1 << 14;

double srgbCurve(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

// The curve in steps fine enough to give the exact code or its neighbour everywhere.
const std::array<std::uint8_t, kCurveSteps + 1>& curveTable() {
  static const auto table = [] {
    std::array<std::uint8_t, kCurveSteps + 1> codes{};
    for (int i = 0; i <= kCurveSteps; ++i)
      codes[i] = static_cast<std::uint8_t>(std::lround(255.0 * srgbCurve(double(i) / kCurveSteps)));
    return codes;
  }();
  return table;
}

image::Rgb8 encode(const Vec3& linear) { return {encodeSrgb(linear.x), encodeSrgb(linear.y), encodeSrgb(linear.z)}; }

Vec3 maskValue(const LightMask& mask, int x, int y) {
  if (mask.tint.empty()) return Vec3(mask.light(x, y) / 255.0);
  return partsOf(mask.tint(x, y));
}

// The veils of a pixel, the farthest first, each over what is behind it. `faces`: those of the pixel before, which mostly shows the same.
Vec3 veiled(Vec3 behind, const Painter& painter, const Vec3& eye, const Vec3& ray, std::span<const Veil> veils,
            std::size_t first, std::span<const LightMask> masks, std::vector<Face>& faces) {
  if (faces.size() < veils.size()) faces.resize(veils.size());
  for (std::size_t k = veils.size(); k-- > 0;) {
    Face& face = faces[k];
    painter.turnTo(veils[k].triangle, face);
    const Vec3 own = painter.colour(face, eye + double(veils[k].depth) * ray, ray,
                                    [&](std::size_t i) { return partsOf(masks[i].veils[first + k]); });
    behind = face.passing * behind + face.material->opacity * own;
  }
  return behind;
}

image::RgbImage paint(const scene::Scene& scene, const scene::Surfaces& surfaces, const scene::Camera& camera,
                      const SurfaceBuffer& seen, const VeilBuffer& veils, std::span<const scene::Light> lights,
                      std::span<const LightMask> masks, const CompositeOptions& options) {
  UMBRAGE_CHECK(lights.size() == masks.size(), "one mask a light");
  UMBRAGE_CHECK(seen.triangle.width() == camera.width && seen.triangle.height() == camera.height, "picture size");
  const Painter painter(scene, surfaces, lights, options);
  const scene::PixelRays rays = scene::pixelRays(camera);
  const Vec3 eye = camera.eye - surfaces.origin;
  const auto code = [](double srgb) {
    return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(srgb, 0.0, 1.0)));
  };
  const image::Rgb8 background{code(options.background.x), code(options.background.y), code(options.background.z)};
  const Vec3 far(decodeSrgb(background.r), decodeSrgb(background.g), decodeSrgb(background.b));

  image::RgbImage picture(camera.width, camera.height, background);
  const auto shadeRow = [&](int y) {
    Face face;
    std::vector<Face> faces;
    for (int x = 0; x < camera.width; ++x) {
      const std::uint32_t t = seen.triangle(x, y);
      const std::size_t pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(camera.width) + static_cast<std::size_t>(x);
      const std::span<const Veil> before = veils.at(pixel);
      if (t == kNoTriangle && before.empty()) continue;
      const Vec3 ray = rays.through(x + 0.5, y + 0.5);
      Vec3 colour = far;
      if (t != kNoTriangle) {
        painter.turnTo(t, face);
        colour = painter.colour(face, eye + double(seen.depth(x, y)) * ray, ray,
                                [&](std::size_t i) { return maskValue(masks[i], x, y); });
      }
      if (!before.empty()) colour = veiled(colour, painter, eye, ray, before, veils.first[pixel], masks, faces);
      picture(x, y) = encode(colour);
    }
  };
  constexpr std::size_t kRowsPerThread = 64;
  const auto rows = static_cast<std::size_t>(camera.height);
  const auto threads = static_cast<unsigned>(std::min<std::size_t>(threadCount(0), 1 + rows / kRowsPerThread));
  inParts(rows, 1, threads, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) shadeRow(static_cast<int>(y));
  });
  return picture;
}

}  // namespace

std::uint8_t encodeSrgb(double linear) {
  const double bounded = linear > 0.0 ? std::min(linear, 1.0) : 0.0;  // not-a-number is black
  return curveTable()[static_cast<std::size_t>(bounded * kCurveSteps + 0.5)];
}

double decodeSrgb(std::uint8_t code) {
  const double v = code / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

double skyLight(double ambient, const Vec3& normal, const Vec3& up) {
  return ambient * (kSkyBase + (1.0 - kSkyBase) * glm::dot(normal, up));
}

image::RgbImage composite(const scene::Scene& scene, const scene::Surfaces& surfaces, const scene::Camera& camera,
                          const SurfaceBuffer& seen, std::span<const scene::Light> lights,
                          std::span<const LightMask> masks, const CompositeOptions& options) {
  return paint(scene, surfaces, camera, seen, {}, lights, masks, options);
}

image::RgbImage composite(const scene::Scene& scene, const scene::Surfaces& surfaces, const scene::Camera& camera,
                          const Shading& shading, std::span<const scene::Light> lights,
                          const CompositeOptions& options) {
  return paint(scene, surfaces, camera, shading.surface, shading.veils, lights, shading.masks, options);
}

image::RgbImage averaged(const image::RgbImage& picture, int n) {
  UMBRAGE_CHECK(n > 0 && picture.width() % n == 0 && picture.height() % n == 0, "blocks of n x n pixels");
  std::array<double, 256> linear{};
  for (int code = 0; code < 256; ++code) linear[code] = decodeSrgb(static_cast<std::uint8_t>(code));
  image::RgbImage out(picture.width() / n, picture.height() / n);
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x) {
      Vec3 sum(0.0);
      for (int v = 0; v < n; ++v) {
        const image::Rgb8* row = picture.row(y * n + v) + x * n;
        for (int u = 0; u < n; ++u) sum += Vec3(linear[row[u].r], linear[row[u].g], linear[row[u].b]);
      }
      out(x, y) = encode(sum / double(n * n));
    }
  }
  return out;
}

}  // namespace umbrage::shadow

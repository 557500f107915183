#pragma once

#include <span>

#include "umbrage/image/image.hpp"
#include "umbrage/scene/camera.hpp"
#include "umbrage/scene/scene.hpp"
#include "umbrage/scene/surfaces.hpp"
#include "umbrage/shadow/light_mask.hpp"
#include "umbrage/shadow/smooth_normals.hpp"
#include "umbrage/shadow/surface_buffer.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::shadow {

struct CompositeOptions {
  double ambient = 0.25;                  ///< light from everywhere, before the lights
  Vec3 background{0.93, 0.95, 0.97};      ///< sRGB, where no surface is
  const SmoothNormals* smooth = nullptr;  ///< of the surfaces; null: flat shading
  /// With `smooth`: light that falls flatter than the facets of a curved surface can tell fades out, so that the border of the surface's own shadow
  /// does not show its facets. No mask changes, so shadows of other things, and where things touch, stay where they are.
  /// Source: compare M. Chiang, Y. K. Li and B. Burley, Taming the shadow terminator, 2019.
  bool hideTerminator = false;
};

/// Share of the ambient light that comes from everywhere alike; the rest comes from above, so that faces in shadow still
/// show their form.
inline constexpr double kSkyBase = 0.75;

/// Ambient light on a face: ambient x (kSkyBase + (1 - kSkyBase) x cosine between its visible normal and the up axis).
[[nodiscard]] double skyLight(double ambient, const Vec3& normal, const Vec3& up);

/// The picture on the CPU: linear emission + colour x (sky light + sum over lights of mask x colour x intensity x |cosine|), flat
/// two-sided shading, then the sRGB transfer curve. Where nothing is shadowed it equals the picture without shadows.
/// REQUIRES: masks and lights of one length; sizes as the camera's.
[[nodiscard]] image::RgbImage composite(const scene::Scene& scene, const scene::Surfaces& surfaces,
                                        const scene::Camera& camera, const SurfaceBuffer& seen,
                                        std::span<const scene::Light> lights, std::span<const LightMask> masks,
                                        const CompositeOptions& options = {});

/// The same of a shading, with its veils over what lies behind them: each lets through its transmittance of that, and adds its own picture x opacity.
[[nodiscard]] image::RgbImage composite(const scene::Scene& scene, const scene::Surfaces& surfaces,
                                        const scene::Camera& camera, const Shading& shading,
                                        std::span<const scene::Light> lights, const CompositeOptions& options = {});

/// A picture an n-th as wide and high: every pixel the mean, in linear light, of n x n. REQUIRES: n > 0 divides both sides.
[[nodiscard]] image::RgbImage averaged(const image::RgbImage& picture, int n);

/// A linear value in [0, 1] (clamped) as an 8-bit sRGB code, and back.
[[nodiscard]] std::uint8_t encodeSrgb(double linear);
[[nodiscard]] double decodeSrgb(std::uint8_t code);

}  // namespace umbrage::shadow

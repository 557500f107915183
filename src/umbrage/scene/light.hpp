#pragma once

#include <string>
#include <variant>

#include "umbrage/base/angle.hpp"
#include "umbrage/math/vec.hpp"

namespace umbrage::scene {

struct PointLight {
  Vec3 position{0.0};
};
/// `direction` is the way the light travels; any length but zero.
struct DirectionalLight {
  Vec3 direction{0.0, 0.0, -1.0};
};
/// A point light that reaches only directions within `cutoff` of `direction`; 0 < cutoff <= 180 degrees.
struct SpotLight {
  Vec3 position{0.0};
  Vec3 direction{0.0, 0.0, -1.0};
  Angle cutoff = Angle::degrees(45);
};

/// A flat, round light of some size. It shines to the side that `direction` points to, alike from all its points; radius > 0.
struct DiscLight {
  Vec3 centre{0.0};
  Vec3 direction{0.0, 0.0, -1.0};
  double radius = 1.0;
};
/// A flat light: all points centre + a u + b v for a and b from -1 to 1. It shines to the side of u x v; u and v are not in line.
struct RectangleLight {
  Vec3 centre{0.0};
  Vec3 u{1.0, 0.0, 0.0}, v{0.0, -1.0, 0.0};
};
/// A ball that shines alike from all its points; radius > 0.
struct SphereLight {
  Vec3 centre{0.0};
  double radius = 1.0;
};
/// A light at infinity that is a disc in the sky, as the sun: from all directions within `radius` of the opposite of `direction`; 0 < radius < 90
/// degrees.
struct SunLight {
  Vec3 direction{0.0, 0.0, -1.0};
  Angle radius = Angle::degrees(0.2665);
};

/// A light in world coordinates. No attenuation with distance: brightness is colour x intensity x cosine.
struct Light {
  std::variant<PointLight, DirectionalLight, SpotLight, DiscLight, RectangleLight, SphereLight, SunLight> shape;
  Vec3 colour{1.0};  ///< linear RGB
  double intensity = 1.0;
  std::string name;
};

/// Whether it has an extent, so that shadows have soft borders. To whom does not know that it is its centre.
[[nodiscard]] bool isArea(const Light& light);

/// (position - origin, 1), or (unit vector towards the light, 0); of lights with an extent that of the centre.
[[nodiscard]] Vec4 homogeneous(const Light& light, const Vec3& origin);

/// The vector from a point (relative to `origin`) to a homogeneous light; not normalised.
inline Vec3 towardsLight(const Vec4& light, const Vec3& point) { return Vec3(light) - point * light.w; }

/// True when `point` (world) lies inside the spot's cone, its border included; always true for other lights and at the apex.
[[nodiscard]] bool insideCone(const Light& light, const Vec3& point);

/// From farther away light is as good as parallel, and products of distances leave the range of single precision.
inline constexpr double kFarthestLight = 1e15;

/// True when position, direction, colour and intensity are finite, the position no farther than kFarthestLight from the world's origin, the direction
/// not zero and the cone sensible.
[[nodiscard]] bool isValid(const Light& light);

}  // namespace umbrage::scene

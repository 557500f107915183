#pragma once

#include <optional>

#include "umbrage/math/vec.hpp"

// What happens to light where two clear media meet. Directions and normals are unit vectors; a normal lies on the side that light comes from.
namespace umbrage::optics {

[[nodiscard]] inline Vec3 reflected(const Vec3& direction, const Vec3& normal) {
  return direction - 2.0 * glm::dot(direction, normal) * normal;
}

/// The way on beyond the interface, from a medium of index `from` into one of index `to`; nothing where all light is reflected.
/// Source: W. Snellius's law, as R. Descartes gave it, 1637.
[[nodiscard]] std::optional<Vec3> refracted(const Vec3& direction, const Vec3& normal, double from, double to);

/// The part of unpolarised light that is reflected; 1 where all is.
/// Source: A. Fresnel, 1823.
[[nodiscard]] double reflectance(const Vec3& direction, const Vec3& normal, double from, double to);

}  // namespace umbrage::optics

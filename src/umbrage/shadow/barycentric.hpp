#pragma once

#include "umbrage/scene/surfaces.hpp"

namespace umbrage::shadow {

/// Where a point of a triangle's plane lies between its corners: how much of each it has, which adds up to 1. A point beside the triangle is taken for
/// one of its border. `point` is relative to the origin of the surfaces.
[[nodiscard]] Vec3 barycentric(const scene::Surfaces& surfaces, std::uint32_t triangle, const Vec3& point);

}  // namespace umbrage::shadow

#pragma once

#include "umbrage/scene/scene.hpp"

namespace umbrage::benchmarks {

/// The nearest point whose coordinates are whole multiples of 1/1024.
[[nodiscard]] Vec3 snapped(const Vec3& p);

/// Adds a square of the given half side at height 0, around the origin, which casts nothing.
void addGround(scene::Scene& scene, double halfSide, std::uint32_t material);

}  // namespace umbrage::benchmarks

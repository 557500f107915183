#pragma once

#include <memory>

#include "umbrage/scene/light.hpp"
#include "umbrage/shadow/caster_set.hpp"

namespace umbrage::render {

/// Casters in a space of their own, and where they stand. A caster that moves is the same casters with another pose; one that
/// changes its shape is other casters.
/// REQUIRES: casters is not null; toWorld is affine and invertible (turned, scaled, sheared or mirrored as you like).
struct PosedCasters {
  std::shared_ptr<const shadow::CasterSet> casters;
  Mat4 toWorld{1.0};
};

/// The light as the casters see it, homogeneous, relative to casters->origin. The same bits for every pose that differs by a
/// translation alone, when the light is a direction.
[[nodiscard]] Vec4 lightFrom(const PosedCasters& posed, const scene::Light& light);

/// A point of the world in the casters' own space, relative to casters->origin.
[[nodiscard]] Vec3 pointFrom(const PosedCasters& posed, const Vec3& world);

/// A box of the world as the casters see it: a box of their own space that holds it, relative to casters->origin.
[[nodiscard]] Box3 boxFrom(const PosedCasters& posed, const Box3& world);

/// True when the pose turns left into right.
[[nodiscard]] bool mirrors(const PosedCasters& posed);

/// A box around the casters in the world. Empty when they are.
[[nodiscard]] Box3 worldBounds(const PosedCasters& posed);

}  // namespace umbrage::render

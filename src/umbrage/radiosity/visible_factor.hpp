#pragma once

#include <array>

#include "umbrage/trace/occlusion.hpp"

namespace umbrage::radiosity {

/// A small piece of one side of a surface.
struct Receiver {
  Vec3 point;         ///< relative to the origin of the surfaces, inside a triangle
  Vec3 normal;        ///< unit, on that side
  double lift = 0.0;  ///< rays start so far above the surface
};

/// One side of a flat triangle that gives off light alike everywhere.
struct Emitter {
  std::array<Vec3, 3> corner;  ///< relative to the origin of the surfaces
  Vec3 normal;                 ///< unit, on that side
  double lift = 0.0;           ///< rays end so far above it
};

/// How far above a triangle's surface rays start, so that rounding makes none meet it: `point` of it, by its coordinates.
[[nodiscard]] double liftOf(const trace::Occlusion& occlusion, std::uint32_t triangle, const Vec3& point);

/// How finely a triangle is looked at.
struct VisibilityAccuracy {
  double coarse = 0.02;  ///< pieces with a larger form factor are looked at in parts even where all rays agree
  double fine = 2e-4;    ///< pieces with a smaller one are not looked at in parts
  int depth = 4;         ///< a triangle is cut in four so often at most
};

/// polygonFactor() of what is seen of the emitter past all casters: the triangle is cut into four again and again where rays to its corners and to
/// somewhere in each of its quarters disagree; each piece counts by its exact factor.
/// Source: J. R. Wallace, K. A. Elmquist and E. A. Haines, A Ray Tracing Algorithm for Progressive Radiosity, 1989, for rays from where light is
/// received to samples of what gives it off.
[[nodiscard]] double visibleFactor(const trace::Occlusion& occlusion, const Receiver& receiver, const Emitter& emitter,
                                   const VisibilityAccuracy& accuracy = {});

}  // namespace umbrage::radiosity

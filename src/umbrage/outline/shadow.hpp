#pragma once

#include <string>
#include <vector>

#include "umbrage/base/error.hpp"
#include "umbrage/base/progress.hpp"
#include "umbrage/outline/casters.hpp"
#include "umbrage/outline/region.hpp"
#include "umbrage/sun/sun.hpp"

namespace umbrage::outline {

/// Where the shadow of a point one unit above a horizontal plane falls: so far east and north of the point. `north`: true north
/// lies so much clockwise of the y axis. REQUIRES: the sun is above the horizon.
[[nodiscard]] Vec2 shadowSlope(const sun::SunPosition& sun, Angle north = {});

enum class Grouping {
  parts,   ///< a region for each part, which may overlap others'
  merged,  ///< one region for all parts together
};

/// What lies in the shadow of something. `name` is the part's; empty when merged.
struct Shadow {
  std::string name;
  Region region;
};

/// The shadows on the horizontal plane at `height` of everything above it, for each slope (see shadowSlope): the union of the
/// projected triangles, whatever their topology, cut off at the plane.
/// 1. Ground that a solid stands on is in its shadow; a surface in the plane itself casts nothing.
/// 2. Every corner lies within 2^-29 of the size of what is united (a part, or parts whose shadows touch) of its exact place.
/// 3. Holes are kept. Parts without shadow have no entry when grouped by parts.
/// The outer list follows `slopes`. Uses all cores. Errors: cancelled.
[[nodiscard]] Result<std::vector<std::vector<Shadow>>> shadowsOnPlane(const std::vector<CasterPart>& casters,
                                                                      double height, const std::vector<Vec2>& slopes,
                                                                      Grouping grouping,
                                                                      const ProgressSink& progress = {});

}  // namespace umbrage::outline

#pragma once

#include "umbrage/outline/shadow.hpp"

namespace umbrage::outline {

/// The way of the shadow of a point one unit above a plane, while the sun is at least at some elevation: a polyline of slopes
/// (shadowSlope) within `deviation` of the curve, everywhere.
struct SlopePath {
  std::vector<Vec2> slopes;
  double deviation = 0.0;
  sun::Instant from, to;
};

/// When a sweep looks at the sun, and how closely its way is followed.
struct SweepPeriod {
  sun::Place place;
  Angle north;  ///< true north lies so much clockwise of the y axis
  sun::Instant from, to;
  Angle leastElevation = Angle::degrees(3);  ///< above 0: at the horizon shadows have no end
  double tolerance = 1e-4;  ///< of the slope: an error of the border of one ten-thousandth of the height
};

/// The paths of the times when the sun is high enough, in order; none in the polar night. The sun is the centre of the disc, geometric,
/// its declination moving.
/// REQUIRES: from < to, leastElevation > 0, tolerance > 0.
[[nodiscard]] std::vector<SlopePath> slopePaths(const SweepPeriod& period);

/// The ground that is in shadow at some moment: the union of the shadows (see shadowsOnPlane) over paths of the sun.
/// 1. Between the corners of a path nothing is sampled: the shadow of an edge sweeps a convex hull there, exactly.
/// 2. The border is within `bound` of the exact one: the deviation of the paths times the height of what casts.
struct Envelope {
  std::vector<Shadow> shadows;
  double bound = 0.0;  ///< in the scene's unit
};
/// Uses all cores. Errors: cancelled.
[[nodiscard]] Result<Envelope> sweepShadows(const std::vector<CasterPart>& casters, double height,
                                            const std::vector<SlopePath>& paths, Grouping grouping,
                                            const ProgressSink& progress = {});

}  // namespace umbrage::outline

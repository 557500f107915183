#pragma once

#include "umbrage/outline/casters.hpp"

namespace umbrage::outline::detail {

/// What of a part lies above a height; heights count from it. A triangle with no corner above it is gone, one that is cut gets new
/// corners on it, shared by all triangles of the edge that was cut.
[[nodiscard]] CasterPart above(const CasterPart& part, double height);

}  // namespace umbrage::outline::detail

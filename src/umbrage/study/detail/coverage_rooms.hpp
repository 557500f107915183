#pragma once

#include <array>
#include <utility>
#include <vector>

#include "umbrage/study/detail/hours_tree.hpp"
#include "umbrage/study/detail/sun_leg.hpp"

namespace umbrage::study::detail {

/// Where the stretches of one coverage lie; it grows when they are many.
struct CoverageRoom {
  std::vector<float> from, to;
  CoverageRoom();
};

/// Those of a group's points, and as many to try something in.
struct CoverageRooms {
  std::array<CoverageRoom, kGroup> rooms, probes;
};

/// Says which rooms this thread's coverages lie in. REQUIRES: they outlive the coverages.
void useRooms(CoverageRooms& rooms);
/// Makes room in a coverage of this thread.
void growCoverage(Coverage& coverage);
/// Nothing is covered yet.
[[nodiscard]] Coverage emptyCoverage(CoverageRoom& room, const SunLeg& leg);
/// Of the stretches between `first` and `last` that are not covered; empty when there is none.
[[nodiscard]] std::pair<float, float> longestGap(const Coverage& covered, float first, float last);

}  // namespace umbrage::study::detail

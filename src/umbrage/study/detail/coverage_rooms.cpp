#include "umbrage/study/detail/coverage_rooms.hpp"

#include <algorithm>

namespace umbrage::study::detail {
namespace {

constexpr std::int32_t kRoom = 48, kSpare = 24;

// The traversal knows plain data only, so a coverage finds its room by its own thread.
thread_local CoverageRooms* roomsOfThread = nullptr;

}  // namespace

CoverageRoom::CoverageRoom() : from(kRoom + kSpare, kNever), to(kRoom + kSpare, kNever) {}

void useRooms(CoverageRooms& rooms) { roomsOfThread = &rooms; }

void growCoverage(Coverage& c) {
  for (auto* rooms : {&roomsOfThread->rooms, &roomsOfThread->probes})
    for (CoverageRoom& room : *rooms) {
      if (room.from.data() != c.from) continue;
      c.capacity *= 2;
      room.from.resize(static_cast<std::size_t>(c.capacity + kSpare), kNever);
      room.to.resize(static_cast<std::size_t>(c.capacity + kSpare), kNever);
      c.from = room.from.data(), c.to = room.to.data();
      return;
    }
}

Coverage emptyCoverage(CoverageRoom& room, const SunLeg& leg) {
  std::fill_n(room.from.begin(), 16, kNever);
  std::fill_n(room.to.begin(), 16, kNever);
  const auto first = float(leg.first), last = float(leg.last);
  return {room.from.data(),
          room.to.data(),
          0,
          static_cast<std::int32_t>(room.from.size()) - kSpare,
          first,
          64.0f / (last - first),
          0};
}

std::pair<float, float> longestGap(const Coverage& covered, float first, float last) {
  std::pair<float, float> longest{first, first};
  float from = first;
  for (std::int32_t i = 0; i <= covered.count; ++i) {
    const float to = i == covered.count ? last : std::min(covered.from[i], last);
    if (to - from > longest.second - longest.first) longest = {from, to};
    if (i < covered.count) from = std::max(from, covered.to[i]);
  }
  return longest;
}

}  // namespace umbrage::study::detail

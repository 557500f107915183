#include "umbrage/shadow/averted_faces.hpp"

#include <algorithm>
#include <atomic>

#include "umbrage/shadow/finders/threads.hpp"

namespace umbrage::shadow {
namespace {

// Below this sine the eye may be on either side, as far as double arithmetic and the rounding of what is drawn can tell.
constexpr double kSurely = 0x1p-18;

// The height of the eye over a triangle with sorted corners relative to it, in the sense of lightSide; 0 when in doubt.
int surelyOnSide(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = glm::cross(b - a, c - a);
  const double height = glm::dot(normal, a);
  if (height * height <= kSurely * kSurely * glm::dot(normal, normal) * glm::dot(a, a)) return 0;
  return height < 0.0 ? +1 : -1;
}

}  // namespace

std::vector<std::uint8_t> avertedFaces(const Geometry& geometry, const Vec3& eye) {
  const CasterSet& casters = geometry.casters;
  const std::size_t count = casters.triangles.size();
  std::vector<std::uint8_t> averted(geometry.surfaces.triangles.size(), 0), outside(casters.componentCount, 0);
  std::vector<std::int8_t> side(count, 0);
  constexpr std::size_t kPerThread = 16384;
  const auto threads = static_cast<unsigned>(std::min<std::size_t>(threadCount(0), 1 + count / kPerThread));
  inParts(count, 64, threads, [&](unsigned, std::size_t begin, std::size_t end) {
    for (auto t = static_cast<std::uint32_t>(begin); t < end; ++t) {
      if (casters.outward[t] == 0) continue;
      const int at = surelyOnSide(casters.corner(t, 0) - eye, casters.corner(t, 1) - eye, casters.corner(t, 2) - eye);
      side[t] = static_cast<std::int8_t>(at * casters.outward[t]);
      if (side[t] > 0) std::atomic_ref(outside[casters.componentOf[t]]).store(1, std::memory_order_relaxed);
    }
  });
  for (std::uint32_t t = 0; t < count; ++t)
    if (side[t] < 0 && outside[casters.componentOf[t]] != 0) averted[casters.surfaceTriangle[t]] = 1;
  return averted;
}

}  // namespace umbrage::shadow

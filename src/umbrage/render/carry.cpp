#include "umbrage/render/carry.hpp"

#include <vector>

namespace umbrage::render {
namespace {

constexpr std::uint32_t kNotYet = ~std::uint32_t{0};

// A point in two floats a component, as the shaders have it.
struct Halves {
  explicit Halves(const Vec3& v) : high(v), low(v - Vec3(high)) {}
  [[nodiscard]] Vec3f to(const Vec3f& p) const { return (p - high) - low; }
  Vec3f high, low;
};

}  // namespace

void carryOnProcessor(const shadow::CasterSet& casters, const Vec3& eye, LightVolume& volume) {
  const Halves fromEye(eye), fromLight{Vec3(volume.light)};
  const auto carried = [&](std::uint32_t index) {
    const std::uint32_t i = index / 2;
    const Vec3f& p = casters.positions[i];
    if (index % 2 == 0) return Vec4f(fromEye.to(p), 1.0f);
    if (!volume.farPoints.empty()) return volume.farPoints[i];
    return Vec4f(volume.light.w == 0.0 ? -fromLight.high : fromLight.to(p), 0.0f);
  };
  std::vector<std::uint32_t> place(2 * casters.positions.size(), kNotYet);
  const auto placeOf = [&](std::uint32_t index) {
    if (place[index] == kNotYet) {
      place[index] = static_cast<std::uint32_t>(volume.points.size());
      volume.points.push_back(carried(index));
    }
    return place[index];
  };
  for (const VolumeGroup& group : volume.groups)
    for (const IndexRange& range : {group.passSides, group.failSides, group.turnedSides, group.failCaps})
      for (std::size_t i = range.first; i < range.first + range.count; ++i)
        volume.indices[i] = placeOf(volume.indices[i]);
}

}  // namespace umbrage::render

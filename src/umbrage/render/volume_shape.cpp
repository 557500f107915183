#include <array>

#include "umbrage/render/detail/volume_shape.hpp"
#include "umbrage/shadow/finders/threads.hpp"

namespace umbrage::render::detail {
namespace {

constexpr std::uint32_t kComponentsWorthThreads = 1024;

}  // namespace

void VolumeShape::endVolumes(const Components& atEye) {
  if (!input_.options.finite) return;
  Box3 room = input_.receivers;
  room.add(input_.eye);
  reach_ = shadow::reachWithin(input_.casters, input_.light, room, atEye);
}

Components VolumeShape::withoutReceivers() const {
  const std::uint32_t count = input_.casters.componentCount;
  Components without(count, 0);
  const unsigned threads = count >= kComponentsWorthThreads ? shadow::threadCount(0) : 1;
  shadow::inParts(count, 64, threads, [&](unsigned, std::size_t begin, std::size_t end) {
    for (auto c = static_cast<std::uint32_t>(begin); c < end; ++c) without[c] = holdsReceivers(c) ? 0 : 1;
  });
  return without;
}

bool VolumeShape::holdsReceivers(std::uint32_t component) const {
  const Box3& box = input_.casters.componentBounds[component];
  std::array<Vec4, 16> hull;
  for (std::size_t i = 0; i < 8; ++i) {
    const Vec3 corner((i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                      (i & 4) != 0 ? box.max.z : box.min.z);
    hull[i] = relative(Vec4(corner, 1.0));
    hull[8 + i] = relative(farEnd(component, corner));
  }
  return !input_.tiles->behindAll(hull) && !input_.tiles->beforeAll(hull);
}

bool VolumeShape::mayCount(std::uint32_t a, std::uint32_t b, std::uint32_t component) const {
  const Vec3 from = input_.casters.position(a), to = input_.casters.position(b);
  const std::array<Vec4, 4> hull{relative(Vec4(from, 1.0)), relative(Vec4(to, 1.0)), relative(farEnd(component, from)),
                                 relative(farEnd(component, to))};
  return !input_.tiles->behindAll(hull);
}

Vec4 VolumeShape::farEnd(std::uint32_t component, const Vec3& corner) const {
  if (input_.options.finite) return shadow::farPoint(reach_, component, corner, input_.light);
  return {corner * input_.light.w - Vec3(input_.light), 0.0};
}

}  // namespace umbrage::render::detail

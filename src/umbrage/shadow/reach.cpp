#include "umbrage/shadow/reach.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "umbrage/base/check.hpp"

namespace umbrage::shadow {
namespace {

// The planes lie this share of the room's radius outside it: what single precision makes of a volume's end stays clear of receivers.
constexpr double kMargin = 0x1p-10;
// Sine of the least angle at which light may meet a plane; below it the volume would be drawn out to nearly infinity anyway.
constexpr double kLeastSine = 0.02;

int axisOf(int plane) { return plane / 2; }
double sideOf(int plane) { return plane % 2 == 0 ? -1.0 : 1.0; }

// How long the shadow of a box is on its way to a plane, at most; infinite where some ray does not get there.
double lengthTo(int plane, double level, const Box3& box, const Vec4& light) {
  const int axis = axisOf(plane);
  const double side = sideOf(plane);
  const Vec3 fromMin = box.min * light.w - Vec3(light), fromMax = box.max * light.w - Vec3(light);
  const double farthest = glm::length(glm::max(glm::abs(fromMin), glm::abs(fromMax)));
  const double slowest = std::min(side * fromMin[axis], side * fromMax[axis]);
  if (!(slowest > kLeastSine * farthest)) return std::numeric_limits<double>::infinity();
  const double way = std::max(side * (level - box.min[axis]), side * (level - box.max[axis]));
  return way / slowest * farthest;
}

std::uint8_t bestPlane(const std::array<double, 6>& levels, const Box3& box, const Vec4& light) {
  std::uint8_t best = Reach::kEndless;
  double shortest = std::numeric_limits<double>::infinity();
  for (int plane = 0; plane < 6; ++plane) {
    const double length = lengthTo(plane, levels[static_cast<std::size_t>(plane)], box, light);
    if (length < shortest) {
      shortest = length;
      best = static_cast<std::uint8_t>(plane);
    }
  }
  return best;
}

}  // namespace

std::size_t Reach::endlessCount() const {
  return static_cast<std::size_t>(std::count(plane.begin(), plane.end(), kEndless));
}

Reach reachWithin(const CasterSet& casters, const Vec4& light, const Box3& room,
                  std::span<const std::uint8_t> endless) {
  UMBRAGE_CHECK(endless.empty() || endless.size() == casters.componentCount, "one entry a component");
  Reach reach;
  reach.plane.reserve(casters.componentCount);
  Box3 all = room;
  if (!casters.bounds.empty()) all.add(casters.bounds);
  const double margin = kMargin * all.radius();
  for (int plane = 0; plane < 6; ++plane)
    reach.level[static_cast<std::size_t>(plane)] =
        (plane % 2 == 0 ? all.min : all.max)[axisOf(plane)] + sideOf(plane) * margin;
  for (std::uint32_t c = 0; c < casters.componentCount; ++c)
    reach.plane.push_back(!endless.empty() && endless[c] != 0
                              ? Reach::kEndless
                              : bestPlane(reach.level, casters.componentBounds[c], light));
  return reach;
}

Vec4 farPoint(const Reach& reach, std::uint32_t component, const Vec3& corner, const Vec4& light) {
  const Vec3 away = corner * light.w - Vec3(light);
  const std::uint8_t plane = reach.plane[component];
  if (plane == Reach::kEndless) return {away, 0.0};
  const int axis = axisOf(plane);
  Vec3 end = corner + (reach.level[plane] - corner[axis]) / away[axis] * away;
  end[axis] = reach.level[plane];
  return {end, 1.0};
}

std::vector<Vec4f> farPoints(const CasterSet& casters, const Reach& reach, const Vec4& light, const Vec3& eye) {
  std::vector<Vec4f> points(casters.positions.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const std::uint32_t component = casters.componentOfPosition[i];
    if (component == kNoComponent) continue;
    const Vec4 end = farPoint(reach, component, casters.position(i), light);
    points[i] = Vec4f(end - Vec4(eye * end.w, 0.0));
  }
  return points;
}

}  // namespace umbrage::shadow

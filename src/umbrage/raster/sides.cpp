#include "umbrage/raster/sides.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace umbrage::raster {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// How far away from the light a side must be carried to be beyond the room; false when it lies beyond it anyway.
// The parts of the two ways; infinite where the light shines along the room's sides or from within.
bool waysOut(const Box3& room, const Vec3& a, const Vec3& b, const Vec4& light, double& wayA, double& wayB) {
  const Vec3 fromA = a * light.w - Vec3(light), fromB = b * light.w - Vec3(light);
  double best = kInfinity;
  wayA = wayB = best;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(fromA[axis] * fromB[axis] > 0.0)) continue;
    const double level = fromA[axis] > 0.0 ? room.max[axis] : room.min[axis];
    const double toA = (level - a[axis]) / fromA[axis], toB = (level - b[axis]) / fromB[axis];
    if (toA < 0.0 && toB < 0.0) return false;
    if (std::max(toA, toB) < best) best = std::max(toA, toB), wayA = std::max(0.0, toA), wayB = std::max(0.0, toB);
  }
  return true;
}

// Beyond one side of the picture with all corners; with a corner at infinity never.
bool isOutside(const PixelSpace& space, const std::array<Vec3, 4>& hull) {
  const double width = space.width, height = space.height;
  const auto all = [&](auto beyond) { return std::all_of(hull.begin(), hull.end(), beyond); };
  return all([&](const Vec3& p) { return p.x < 0.0; }) || all([&](const Vec3& p) { return p.x > width * p.z; }) ||
         all([&](const Vec3& p) { return p.y < 0.0; }) || all([&](const Vec3& p) { return p.y > height * p.z; }) ||
         all([](const Vec3& p) { return p.z < 0.0; });
}

// Whether a box may hold something between the eye and the light.
bool mayLieBetween(const Box3& box, const Vec3& eye, const Vec4& light) {
  const double margin = 0x1p-30 * (glm::length(eye) + glm::length(box.max) + glm::length(box.min));
  return meetsWay(box, margin, eye, light);
}

// The part of one triangle in the count at the eye: 1 when the eye lies in its shadow; -1 when its sides are wound the other way round, since
// `lightSide`, which decides that, was rounded otherwise than what the eye sees of it.
int shadowAtEye(const std::array<Sighted, 3>& corner, int lightSide, const Sighted& light) {
  int turn = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const int side = sideSeen(corner[k], corner[(k + 1) % 3], light);
    if (side == 0 || (turn != 0 && side != turn)) return 0;
    turn = side;
  }
  const bool between = sideSeen(corner[0], corner[1], corner[2]) == turn &&
                       sideOfPlane(corner[0].v, corner[1].v, corner[2].v, light) == -turn;
  return between ? turn * lightSide : 0;
}

}  // namespace

void visitAtEye(const shadow::CasterSet& casters, std::span<const std::int8_t> side, const Vec4& light,
                const PixelSpace& space, const Corners& corners,
                const std::function<void(std::uint32_t triangle, int sign)>& fn) {
  std::vector<std::uint8_t> near(casters.componentCount);
  for (std::uint32_t c = 0; c < casters.componentCount; ++c)
    near[c] = mayLieBetween(casters.componentBounds[c], space.eye, light);
  for (std::uint32_t t = 0; t < casters.triangles.size(); ++t) {
    if (side[t] == 0 || near[casters.componentOf[t]] == 0) continue;
    const mesh::Triangle& c = casters.triangles[t];
    Box3 box;
    for (int k = 0; k < 3; ++k) box.add(casters.corner(t, k));
    if (!mayLieBetween(box, space.eye, light)) continue;
    const int sign = shadowAtEye({corners.at(c[0]), corners.at(c[1]), corners.at(c[2])}, side[t], corners.light);
    if (sign != 0) fn(t, sign);
  }
}

int countAtEye(const shadow::CasterSet& casters, const shadow::Silhouette& silhouette, const PixelSpace& space,
               const Corners& corners) {
  int count = 0;
  visitAtEye(casters, silhouette.side, silhouette.light, space, corners,
             [&](std::uint32_t, int sign) { count += sign; });
  return count;
}

SideMaker::SideMaker(const PixelSpace& space, const Corners& corners, const shadow::CasterSet& casters,
                     const Vec4& light, Box3 room)
    : space_(space), corners_(corners), casters_(casters), light_(light), room_(room) {
  const Vec3 margin(0x1p-20 * room.radius());
  if (!room.empty()) room_.min -= margin, room_.max += margin;
}

bool SideMaker::side(const shadow::SilhouetteEdge& edge, Patch& out) const {
  double wayA = 0.0, wayB = 0.0;
  if (!waysOut(room_, casters_.position(edge.a), casters_.position(edge.b), light_, wayA, wayB)) return false;
  const Sighted& light = corners_.light;
  // A point carried away from the light stays on the line that the camera sees.
  const auto carried = [&](const Vec3& p, double way) {
    return way < kInfinity ? p + way * (p * light.w - light.v) : Vec3(0.0);
  };
  const Vec3 &a = corners_.mapped[edge.a], &b = corners_.mapped[edge.b];
  const std::array<Vec3, 4> hull{a, b, carried(a, wayA), carried(b, wayB)};
  if (isOutside(space_, hull)) return false;
  bound(space_, hull, out);
  if (out.x0 >= out.x1 || out.y0 >= out.y1) return false;
  if (!makePatch(space_, corners_, {edge.a, edge.b, corners_.lightIndex()}, true, out)) return false;
  out.weight = -out.side * edge.multiplicity;
  return true;
}

bool SideMaker::cap(std::uint32_t triangle, int lightSide, Patch& out) const {
  const mesh::Triangle& c = casters_.triangles[triangle];
  if (lightSide == 0 || !makePatch(space_, corners_, {c[0], c[1], c[2]}, false, out)) return false;
  const std::array<Vec3, 3> points{corners_.mapped[c[0]], corners_.mapped[c[1]], corners_.mapped[c[2]]};
  bound(space_, points, out);
  out.weight = -out.side * lightSide;
  return true;
}

}  // namespace umbrage::raster

#include "umbrage/shadow/volume.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "umbrage/base/check.hpp"
#include "umbrage/math/predicates.hpp"

namespace umbrage::shadow {
namespace {

constexpr std::uint32_t nearVertex(std::uint32_t i) { return 2 * i; }
constexpr std::uint32_t farVertex(std::uint32_t i) { return 2 * i + 1; }

void append(std::vector<std::uint32_t>& out, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  out.push_back(a);
  out.push_back(b);
  out.push_back(c);
}

// A cap that runs a -> b, counter-clockwise as the light sees it, is continued by a side that runs b -> a.
void appendSide(std::vector<std::uint32_t>& out, const SilhouetteEdge& edge, bool toOnePoint) {
  std::uint32_t a = edge.a, b = edge.b;
  if (edge.multiplicity < 0) std::swap(a, b);
  for (int i = 0; i < std::abs(edge.multiplicity); ++i) {
    append(out, nearVertex(b), nearVertex(a), farVertex(a));
    if (!toOnePoint) append(out, nearVertex(b), farVertex(a), farVertex(b));
  }
}

void appendEdge(std::vector<std::uint32_t>& out, const SilhouetteEdge& edge) {
  const bool turned = edge.multiplicity < 0;
  for (int i = 0; i < std::abs(edge.multiplicity); ++i) {
    out.push_back(nearVertex(turned ? edge.b : edge.a));
    out.push_back(nearVertex(turned ? edge.a : edge.b));
  }
}

void appendCaps(std::vector<std::uint32_t>& out, mesh::Triangle corners, int side, bool isSeen, bool toOnePoint) {
  if (side < 0) std::swap(corners[1], corners[2]);
  const auto [a, b, c] = corners;
  if (isSeen) append(out, nearVertex(a), nearVertex(b), nearVertex(c));
  if (!toOnePoint) append(out, farVertex(a), farVertex(c), farVertex(b));
}

// Whether the line from the light to a point passes left (+1) or right (-1) of the edge a -> b, a before b; 0: too close to call.
int passes(const Vec3& a, const Vec3& b, const Vec4& light, const Vec3& point) {
  const Vec3 edge = b - a, toLight = Vec3(light) - a * light.w, toPoint = point - a;
  const Vec3 normal = glm::cross(edge, toLight);
  const double value = glm::dot(normal, toPoint);
  // The sum of the absolute values of all six products, times a few rounding errors, bounds the error of `value`.
  const Vec3 e = glm::abs(edge), l = glm::abs(toLight), p = glm::abs(toPoint);
  const double size = (e.y * l.z + e.z * l.y) * p.x + (e.z * l.x + e.x * l.z) * p.y + (e.x * l.y + e.y * l.x) * p.z;
  if (std::abs(value) <= 16.0 * std::numeric_limits<double>::epsilon() * size) return 0;
  return value > 0.0 ? +1 : -1;
}

enum class Hit { no, yes, unclear };

// Whether the triangle, sorted and with `side` towards the light, lies between the point and the light.
Hit between(const std::array<Vec3, 3>& corner, int side, const Vec4& light, const Vec3& point) {
  if (lightSide(corner[0], corner[1], corner[2], Vec4(point, 1.0)) != -side) return Hit::no;
  const int ab = passes(corner[0], corner[1], light, point);
  const int bc = passes(corner[1], corner[2], light, point);
  const int ac = passes(corner[0], corner[2], light, point);
  if (ab == side || bc == side || ac == -side) return Hit::no;
  return ab == 0 || bc == 0 || ac == 0 ? Hit::unclear : Hit::yes;
}

bool isSeenEdgeOn(const CasterSet& casters, std::uint32_t t, const Vec3& point) {
  return liesInPlane(casters.corner(t, 0), casters.corner(t, 1), casters.corner(t, 2), point);
}

}  // namespace

bool isInAFacesPlane(const CasterSet& casters, const Vec3& point) {
  for (std::uint32_t t = 0; t < casters.triangles.size(); ++t)
    if (isSeenEdgeOn(casters, t, point)) return true;
  return false;
}

ShadowVolume extrude(const CasterSet& casters, const Silhouette& silhouette, const ExtrudeOptions& options) {
  UMBRAGE_CHECK(options.components.empty() || options.components.size() == casters.componentCount,
                "one entry a component");
  const bool directional = silhouette.light.w == 0.0;
  // A direction carries all vertices to one point at infinity: sides are single triangles, and there is no far cap.
  const auto toOnePoint = [&](std::uint32_t component) {
    return directional && !options.endsAnywhere && (options.reach == nullptr || options.reach->isEndless(component));
  };
  const auto chosen = [&](std::uint32_t component) {
    return options.components.empty() || options.components[component] != 0;
  };
  const auto isSeen = [&](std::uint32_t t) { return !options.eye || !isSeenEdgeOn(casters, t, *options.eye); };
  ShadowVolume volume;
  const auto append = [&](const SilhouetteEdge& edge) {
    options.sidesAsEdges ? appendEdge(volume.sides, edge) : appendSide(volume.sides, edge, toOnePoint(edge.component));
  };
  const std::size_t perEdge = directional && !options.endsAnywhere && options.reach == nullptr ? 3 : 6;
  if (!options.keepSide) volume.sides.reserve(silhouette.edges.size() * perEdge);
  for (const SilhouetteEdge& edge : silhouette.edges)
    if (chosen(edge.component) && (!options.keepSide || options.keepSide(edge))) append(edge);
  if (!options.caps) return volume;
  if (options.components.empty()) volume.caps.reserve(casters.triangles.size() * perEdge);
  for (std::uint32_t t = 0; t < casters.triangles.size(); ++t)
    if (silhouette.side[t] != 0 && chosen(casters.componentOf[t]))
      appendCaps(volume.caps, casters.triangles[t], silhouette.side[t], isSeen(t), toOnePoint(casters.componentOf[t]));
  return volume;
}

SurfaceCount countSurfaces(const CasterSet& casters, const Silhouette& silhouette, const Vec3& point,
                           std::span<const std::uint8_t> skip) {
  const CrossedSurfaces crossed = crossedSurfaces(casters, silhouette, point, skip);
  return {static_cast<int>(crossed.triangles.size()), crossed.unclear};
}

CrossedSurfaces crossedSurfaces(const CasterSet& casters, const Silhouette& silhouette, const Vec3& point,
                                std::span<const std::uint8_t> skip) {
  CrossedSurfaces result;
  for (std::uint32_t t = 0; t < casters.triangles.size(); ++t) {
    if (silhouette.side[t] == 0 || (!skip.empty() && skip[casters.componentOf[t]] != 0)) continue;
    const std::array<Vec3, 3> corner{casters.corner(t, 0), casters.corner(t, 1), casters.corner(t, 2)};
    const Hit hit = between(corner, silhouette.side[t], silhouette.light, point);
    if (hit == Hit::yes) result.triangles.push_back(t);
    result.unclear += hit == Hit::unclear;
  }
  return result;
}

}  // namespace umbrage::shadow

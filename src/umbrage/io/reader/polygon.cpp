#include "umbrage/io/reader/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "umbrage/io/reader/ear_clipping.hpp"
#include "umbrage/io/reader/geos_triangulation.hpp"

namespace umbrage::io::reader {
namespace {

using Ring = std::vector<std::uint32_t>;

Rings clean(std::span<const Vec3> points, const Rings& rings) {
  Rings cleaned;
  for (const Ring& ring : rings) {
    Ring kept;
    for (const std::uint32_t corner : ring)
      if (kept.empty() || points[kept.back()] != points[corner]) kept.push_back(corner);
    while (kept.size() > 1 && points[kept.front()] == points[kept.back()]) kept.pop_back();
    if (kept.size() >= 3)
      cleaned.push_back(std::move(kept));
    else if (cleaned.empty())
      return {};  // without an outer ring there is nothing to have holes in
  }
  return cleaned;
}

// Newell's normal, relative to the first corner so that far coordinates do not cancel.
Vec3 normalOf(std::span<const Vec3> points, const Ring& ring) {
  const Vec3 origin = points[ring.front()];
  Vec3 normal(0.0);
  for (std::size_t i = 0; i < ring.size(); ++i)
    normal += glm::cross(points[ring[i]] - origin, points[ring[(i + 1) % ring.size()]] - origin);
  return normal;
}

// Drops the axis along which the polygon is thinnest. Coordinates stay exact, unlike after a rotation into the plane; they are
// arranged so that the outer ring runs counter-clockwise.
PlanePolygon project(std::span<const Vec3> points, Rings rings) {
  const Vec3 normal = normalOf(points, rings.front());
  const Vec3 size = glm::abs(normal);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const bool turned = normal[axis] < 0.0;
  PlanePolygon polygon;
  for (Ring& ring : rings) {
    std::vector<PlaneCorner> corners;
    for (const std::uint32_t i : ring)
      corners.push_back({turned ? Vec2(points[i][v], points[i][u]) : Vec2(points[i][u], points[i][v]), i});
    polygon.push_back(std::move(corners));
  }
  for (std::size_t hole = 1; hole < polygon.size(); ++hole)
    if (doubleArea(polygon[hole]) > 0.0) std::reverse(polygon[hole].begin(), polygon[hole].end());
  return polygon;
}

using EdgeBalance = std::map<std::pair<std::uint32_t, std::uint32_t>, int>;

void addEdge(EdgeBalance& balance, std::uint32_t from, std::uint32_t to, int times) {
  if (from < to)
    balance[{from, to}] += times;
  else
    balance[{to, from}] -= times;
}

// Law 2 of triangulate.
bool isWatertight(const PlanePolygon& polygon, const std::vector<mesh::Triangle>& triangles) {
  std::size_t corners = 0;
  EdgeBalance balance;
  for (const auto& ring : polygon) {
    corners += ring.size();
    for (std::size_t i = 0; i < ring.size(); ++i)
      addEdge(balance, ring[i].index, ring[(i + 1) % ring.size()].index, -1);
  }
  for (const mesh::Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) addEdge(balance, t[k], t[(k + 1) % 3], 1);
  return triangles.size() == corners + 2 * (polygon.size() - 1) - 2 &&
         std::all_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second == 0; });
}

// The two ways to cut a quadrilateral; of two good ones the one with the shorter cut.
std::vector<mesh::Triangle> cutQuad(const std::vector<PlaneCorner>& q) {
  const auto good = [&](int a, int b, int c) { return turn(q[a].at, q[b].at, q[c].at) > 0.0; };
  const bool even = good(0, 1, 2) && good(0, 2, 3), odd = good(1, 2, 3) && good(1, 3, 0);
  const auto length = [&](int a, int b) { return glm::dot(q[a].at - q[b].at, q[a].at - q[b].at); };
  if (!even && !odd) return {};
  if (even && (!odd || length(0, 2) <= length(1, 3)))
    return {{q[0].index, q[1].index, q[2].index}, {q[0].index, q[2].index, q[3].index}};
  return {{q[1].index, q[2].index, q[3].index}, {q[1].index, q[3].index, q[0].index}};
}

}  // namespace

std::vector<mesh::Triangle> triangulate(std::span<const Vec3> points, const Rings& rings) {
  const Rings cleaned = clean(points, rings);
  if (cleaned.empty()) return {};
  const Ring& outer = cleaned.front();
  if (cleaned.size() == 1 && outer.size() == 3) return {{outer[0], outer[1], outer[2]}};
  const PlanePolygon polygon = project(points, cleaned);
  auto triangles = cleaned.size() == 1 && outer.size() == 4 ? cutQuad(polygon.front()) : triangulateWithGeos(polygon);
  if (!triangles.empty() && isWatertight(polygon, triangles)) return triangles;
  return clipEars(polygon);
}

}  // namespace umbrage::io::reader

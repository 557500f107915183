#include "umbrage/io/reader/ear_clipping.hpp"

#include <algorithm>
#include <limits>
#include <optional>

namespace umbrage::io::reader {
namespace {

using Loop = std::vector<PlaneCorner>;

bool crosses(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return turn(a, b, c) * turn(a, b, d) < 0.0 && turn(c, d, a) * turn(c, d, b) < 0.0;
}

bool crossesAny(const Vec2& a, const Vec2& b, const Loop& loop) {
  for (std::size_t i = 0; i < loop.size(); ++i)
    if (crosses(a, b, loop[i].at, loop[(i + 1) % loop.size()].at)) return true;
  return false;
}

// The corner of the loop that the hole's corner is joined to: the nearest one in sight, or the nearest at all.
std::size_t bridgeEnd(const Loop& loop, const Loop& hole, const Vec2& from) {
  std::vector<std::size_t> byDistance(loop.size());
  for (std::size_t i = 0; i < loop.size(); ++i) byDistance[i] = i;
  const auto distance = [&](std::size_t i) { return glm::dot(loop[i].at - from, loop[i].at - from); };
  std::sort(byDistance.begin(), byDistance.end(),
            [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
  for (const std::size_t i : byDistance)
    if (!crossesAny(from, loop[i].at, loop) && !crossesAny(from, loop[i].at, hole)) return i;
  return byDistance.front();
}

std::size_t rightmost(const Loop& hole) {
  const auto found = std::max_element(hole.begin(), hole.end(),
                                      [](const PlaneCorner& a, const PlaneCorner& b) { return a.at.x < b.at.x; });
  return static_cast<std::size_t>(found - hole.begin());
}

// Cuts the loop open and walks round the hole: the bridge is used once in each direction.
Loop joinHole(const Loop& loop, const Loop& hole) {
  const std::size_t start = rightmost(hole);
  const std::size_t end = bridgeEnd(loop, hole, hole[start].at);
  Loop joined(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(end) + 1);
  for (std::size_t i = 0; i <= hole.size(); ++i) joined.push_back(hole[(start + i) % hole.size()]);
  joined.insert(joined.end(), loop.begin() + static_cast<std::ptrdiff_t>(end), loop.end());
  return joined;
}

Loop joinHoles(const PlanePolygon& polygon) {
  std::vector<const Loop*> holes;
  for (std::size_t i = 1; i < polygon.size(); ++i) holes.push_back(&polygon[i]);
  const auto reach = [](const Loop* hole) { return (*hole)[rightmost(*hole)].at.x; };
  std::stable_sort(holes.begin(), holes.end(), [&](const Loop* a, const Loop* b) { return reach(a) > reach(b); });
  Loop loop = polygon.front();
  for (const Loop* hole : holes) loop = joinHole(loop, *hole);
  return loop;
}

bool covers(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& p) {
  if (p == a || p == b || p == c) return false;
  return turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
}

struct Ear {
  Vec2 a, b, c;
};

Ear earAt(const Loop& loop, std::size_t i) {
  const std::size_t n = loop.size();
  return {loop[(i + n - 1) % n].at, loop[i].at, loop[(i + 1) % n].at};
}

bool isEar(const Loop& loop, std::size_t i) {
  const Ear ear = earAt(loop, i);
  if (turn(ear.a, ear.b, ear.c) <= 0.0) return false;
  return std::none_of(loop.begin(), loop.end(),
                      [&](const PlaneCorner& p) { return covers(ear.a, ear.b, ear.c, p.at); });
}

// Going round from `from`: the first proper ear; else the flattest corner, which adds or takes the least area.
std::size_t nextCut(const Loop& loop, std::size_t from) {
  for (std::size_t k = 0; k < loop.size(); ++k)
    if (const std::size_t i = (from + k) % loop.size(); isEar(loop, i)) return i;
  std::size_t flattest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Ear ear = earAt(loop, i);
    const double area = std::abs(turn(ear.a, ear.b, ear.c));
    if (area < least) {
      least = area;
      flattest = i;
    }
  }
  return flattest;
}

}  // namespace

double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 ab = b - a, ac = c - a;
  return ab.x * ac.y - ab.y * ac.x;
}

double doubleArea(const std::vector<PlaneCorner>& ring) {
  double area = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) area += turn(ring[0].at, ring[i].at, ring[(i + 1) % ring.size()].at);
  return area;
}

std::vector<mesh::Triangle> clipEars(const PlanePolygon& polygon) {
  Loop loop = joinHoles(polygon);
  std::vector<mesh::Triangle> triangles;
  triangles.reserve(loop.size());
  std::size_t at = 0;
  while (loop.size() > 3) {
    at = nextCut(loop, at);
    const std::size_t n = loop.size();
    triangles.push_back({loop[(at + n - 1) % n].index, loop[at].index, loop[(at + 1) % n].index});
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(at));
    // Go on behind the new edge: cutting every ear at one corner would make slivers.
    at = (at + 1) % loop.size();
  }
  triangles.push_back({loop[0].index, loop[1].index, loop[2].index});
  return triangles;
}

}  // namespace umbrage::io::reader

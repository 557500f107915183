#include "umbrage/io/reader/ear_clipping.hpp"

#include <algorithm>
#include <limits>
#include <span>

namespace umbrage::io::reader {
namespace {

using Loop = std::vector<PlaneCorner>;

// In valid polygons one of the nearest corners is in sight; among holes that overlap the search would take for ever.
constexpr std::size_t kSightTries = 64;

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
  for (const std::size_t i : std::span(byDistance).first(std::min(kSightTries, byDistance.size())))
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

// What may still be spent on looking for proper ears, in corners looked at. Rings that cross themselves have few, and a search
// that fails looks at every corner for every corner.
using Budget = std::size_t;
constexpr Budget kBudget = 300'000'000;

bool isEar(const Loop& loop, std::size_t i, Budget& budget) {
  const Ear ear = earAt(loop, i);
  if (turn(ear.a, ear.b, ear.c) <= 0.0) return false;
  budget -= std::min(budget, loop.size());
  return std::none_of(loop.begin(), loop.end(),
                      [&](const PlaneCorner& p) { return covers(ear.a, ear.b, ear.c, p.at); });
}

// The corner that adds or takes the least area.
std::size_t flattest(const Loop& loop) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Ear ear = earAt(loop, i);
    const double area = std::abs(turn(ear.a, ear.b, ear.c));
    if (area < least) {
      least = area;
      best = i;
    }
  }
  return best;
}

// Going round from `from`: the first proper ear; else the flattest corner.
std::size_t nextCut(const Loop& loop, std::size_t from, Budget& budget) {
  for (std::size_t k = 0; k < loop.size() && budget > 0; ++k)
    if (const std::size_t i = (from + k) % loop.size(); isEar(loop, i, budget)) return i;
  return flattest(loop);
}

// Where a bridge or a spike is walked to and fro, its tip is no triangle; the edges left out with it cancel.
bool isProper(const mesh::Triangle& t) { return t[0] != t[1] && t[1] != t[2] && t[2] != t[0]; }

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
  Budget budget = kBudget;
  std::size_t at = 0;
  while (loop.size() > 3) {
    at = nextCut(loop, at, budget);
    const std::size_t n = loop.size();
    const mesh::Triangle ear = {loop[(at + n - 1) % n].index, loop[at].index, loop[(at + 1) % n].index};
    if (isProper(ear)) triangles.push_back(ear);
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(at));
    // Go on behind the new edge: cutting every ear at one corner would make slivers.
    at = (at + 1) % loop.size();
  }
  if (const mesh::Triangle last = {loop[0].index, loop[1].index, loop[2].index}; isProper(last))
    triangles.push_back(last);
  return triangles;
}

}  // namespace umbrage::io::reader

#include "umbrage/samples/detail/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "umbrage/base/check.hpp"

namespace umbrage::samples::detail {
namespace {

using Triple = std::array<std::size_t, 3>;

double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool isEar(const std::vector<Vec2>& p, const std::vector<std::size_t>& rest, std::size_t at) {
  const std::size_t n = rest.size();
  const std::size_t a = rest[(at + n - 1) % n], b = rest[at], c = rest[(at + 1) % n];
  if (turn(p[a], p[b], p[c]) <= 0.0) return false;
  return std::none_of(rest.begin(), rest.end(), [&](std::size_t q) {
    if (q == a || q == b || q == c) return false;
    return turn(p[a], p[b], p[q]) >= 0.0 && turn(p[b], p[c], p[q]) >= 0.0 && turn(p[c], p[a], p[q]) >= 0.0;
  });
}

}  // namespace

std::vector<Triple> triangulate(const std::vector<Vec2>& outline) {
  std::vector<std::size_t> rest(outline.size());
  std::iota(rest.begin(), rest.end(), std::size_t{0});
  std::vector<Triple> triangles;
  while (rest.size() >= 3) {
    std::size_t at = 0;
    while (at < rest.size() && !isEar(outline, rest, at)) ++at;
    UMBRAGE_CHECK(at < rest.size(), "the outline is not a simple counter-clockwise polygon");
    const std::size_t n = rest.size();
    triangles.push_back({rest[(at + n - 1) % n], rest[at], rest[(at + 1) % n]});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(at));
  }
  return triangles;
}

Sphere icosphere(int subdivisions) {
  const double g = std::numbers::phi;
  Sphere s{{{-1, g, 0},
            {1, g, 0},
            {-1, -g, 0},
            {1, -g, 0},
            {0, -1, g},
            {0, 1, g},
            {0, -1, -g},
            {0, 1, -g},
            {g, 0, -1},
            {g, 0, 1},
            {-g, 0, -1},
            {-g, 0, 1}},
           {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
            {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
            {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  for (Vec3& p : s.points) p = glm::normalize(p);
  for (int level = 0; level < subdivisions; ++level) {
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> middles;
    const auto middle = [&](std::size_t a, std::size_t b) {
      const auto [place, fresh] = middles.try_emplace(std::minmax(a, b), s.points.size());
      if (fresh) s.points.push_back(glm::normalize(s.points[a] + s.points[b]));
      return place->second;
    };
    std::vector<Triple> finer;
    for (const auto& [a, b, c] : s.triangles) {
      const std::size_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    s.triangles = std::move(finer);
  }
  return s;
}

}  // namespace umbrage::samples::detail

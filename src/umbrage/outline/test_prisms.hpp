#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "umbrage/outline/casters.hpp"
#include "umbrage/outline/region.hpp"

// Casters whose shadows have closed forms.
namespace umbrage::outline {

// A closed prism over a ring, from `base` to `top`; its caps are fans, which is right for convex rings.
inline CasterPart prism(const std::string& name, const Ring& ring, double base, double top) {
  CasterPart part{name, {}, {}, {}};
  const auto n = static_cast<std::uint32_t>(ring.size());
  for (const double z : {base, top})
    for (const Vec2& p : ring) part.points.emplace_back(p, z);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    part.triangles.push_back({i, j, j + n});
    part.triangles.push_back({i, j + n, i + n});
    if (i > 0 && i + 1 < n) {
      part.triangles.push_back({0, i + 1, i});
      part.triangles.push_back({n, n + i, n + i + 1});
    }
  }
  for (const Vec3& p : part.points) part.bounds.add(p);
  return part;
}
inline Ring rectangle(const Vec2& at, double width, double depth) {
  return {at, at + Vec2(width, 0), at + Vec2(width, depth), at + Vec2(0, depth)};
}
inline Ring polygon(int corners, double radius, const Vec2& centre = Vec2(0.0)) {
  Ring ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    ring.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return ring;
}
inline CasterPart joined(const std::vector<CasterPart>& parts) {
  CasterPart all{parts[0].name, {}, {}, {}};
  for (const CasterPart& part : parts) {
    const auto first = static_cast<std::uint32_t>(all.points.size());
    all.points.insert(all.points.end(), part.points.begin(), part.points.end());
    for (const mesh::Triangle& t : part.triangles) all.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return all;
}

/// By the rule of even and odd.
inline bool holds(const Ring& ring, const Vec2& p) {
  bool in = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) in = !in;
  }
  return in;
}
inline bool holds(const Region& region, const Vec2& p) {
  bool in = false;
  for (const Polygon& polygon : region.polygons) {
    in = in != holds(polygon.outer, p);
    for (const Ring& hole : polygon.holes) in = in != holds(hole, p);
  }
  return in;
}

}  // namespace umbrage::outline

#include "umbrage/samples/detail/shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "umbrage/base/check.hpp"
#include "umbrage/samples/detail/polygon.hpp"

namespace umbrage::samples::detail {
namespace {

using Corners = std::vector<std::uint32_t>;

Corners cornersOf(Part& part, const Ring& ring) {
  Corners corners;
  corners.reserve(ring.size());
  for (const Vec3& p : ring) corners.push_back(part.corner(p));
  return corners;
}

void skin(Part& part, const Corners& from, const Corners& to) {
  const std::size_t n = std::max(from.size(), to.size());
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    if (from.size() == 1)
      part.triangle(from[0], to[j], to[i]);
    else if (to.size() == 1)
      part.triangle(from[i], from[j], to[0]);
    else
      part.quad(from[i], from[j], to[j], to[i]);
  }
}

void cap(Part& part, const Corners& ring, bool reversed) {
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    reversed ? part.triangle(ring[0], ring[i + 1], ring[i]) : part.triangle(ring[0], ring[i], ring[i + 1]);
}

/// Along `ray` from `p` onto the plane through `through`.
Vec3 ontoPlane(const Vec3& p, const Vec3& ray, const Vec3& through, const Vec3& normal) {
  return p + ray * (glm::dot(through - p, normal) / glm::dot(ray, normal));
}

Ring sectionAt(const Vec3& at, const Vec3& axis, const Outline& section) {
  const bool upright = std::abs(axis.z) > 0.999;
  const Vec3 x = glm::normalize(glm::cross(upright ? Vec3(0, 1, 0) : Vec3(0, 0, 1), axis));
  const Vec3 y = glm::cross(axis, x);
  Ring ring;
  for (const Vec2& p : section) ring.push_back(at + p.x * x + p.y * y);
  return ring;
}

}  // namespace

Outline regular(int sides, double radius) {
  Outline outline;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + 0.5) / sides;
    outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return outline;
}

Outline rectangle(double width, double height) {
  const double x = 0.5 * width, y = 0.5 * height;
  return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

void addLoft(Part& part, std::span<const Ring> rings, Ends ends) {
  UMBRAGE_CHECK(rings.size() >= 2, "a loft needs two sections");
  const Corners first = cornersOf(part, rings[0]);
  Corners last = first;
  for (const Ring& ring : rings.subspan(1)) {
    const Corners next = cornersOf(part, ring);
    skin(part, last, next);
    last = next;
  }
  if (ends == Ends::joined) skin(part, last, first);
  if (ends != Ends::closed) return;
  cap(part, first, true);
  cap(part, last, false);
}

void addBox(Part& part, const Vec3& min, const Vec3& max) {
  const std::array<Ring, 2> rings{
      Ring{{min.x, min.y, min.z}, {max.x, min.y, min.z}, {max.x, max.y, min.z}, {min.x, max.y, min.z}},
      Ring{{min.x, min.y, max.z}, {max.x, min.y, max.z}, {max.x, max.y, max.z}, {min.x, max.y, max.z}}};
  addLoft(part, rings);
}

void addPrism(Part& part, const Outline& outline, const Vec3& origin, const Vec3& u, const Vec3& v, const Vec3& way) {
  Ring near, far;
  for (const Vec2& p : outline) {
    near.push_back(origin + p.x * u + p.y * v);
    far.push_back(near.back() + way);
  }
  const Corners from = cornersOf(part, near), to = cornersOf(part, far);
  skin(part, from, to);
  for (const auto& [a, b, c] : triangulate(outline)) {
    part.triangle(from[a], from[c], from[b]);
    part.triangle(to[a], to[b], to[c]);
  }
}

void addSweep(Part& part, std::span<const Vec3> path, const Outline& section, Ends ends) {
  UMBRAGE_CHECK(path.size() >= 2, "a sweep needs two points");
  const bool joined = ends == Ends::joined;
  const std::size_t n = path.size();
  const auto leg = [&](std::size_t i) { return glm::normalize(path[(i + 1) % n] - path[i % n]); };
  const auto mitre = [&](std::size_t i) {
    if (!joined && i == 0) return leg(0);
    if (!joined && i + 1 == n) return leg(n - 2);
    return glm::normalize(leg(i + n - 1) + leg(i));
  };
  std::vector<Ring> rings(1);
  for (const Vec3& p : sectionAt(path[0], leg(0), section)) rings[0].push_back(ontoPlane(p, leg(0), path[0], mitre(0)));
  for (std::size_t i = 1; i < n; ++i) {
    Ring ring = rings.back();
    for (Vec3& p : ring) p = ontoPlane(p, leg(i - 1), path[i], mitre(i));
    rings.push_back(std::move(ring));
  }
  addLoft(part, rings, ends);
}

void addBeam(Part& part, const Vec3& a, const Vec3& b, double width, double height) {
  addSweep(part, std::array{a, b}, rectangle(width, height));
}

void addRevolved(Part& part, const Vec3& centre, const Outline& profile, int sides, Ends ends,
                 std::span<const std::uint32_t> bands) {
  std::vector<Corners> rings;
  for (const Vec2& p : profile) {
    Ring ring;
    if (p.x == 0.0) ring.push_back(centre + Vec3(0, 0, p.y));
    for (int i = 0; p.x > 0.0 && i < sides; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / sides;
      ring.push_back(centre + Vec3(p.x * std::cos(angle), p.x * std::sin(angle), p.y));
    }
    rings.push_back(cornersOf(part, ring));
  }
  for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
    if (i < bands.size()) part.use(bands[i]);
    skin(part, rings[i], rings[i + 1]);
  }
  if (ends == Ends::joined) skin(part, rings.back(), rings.front());
  if (ends != Ends::closed) return;
  cap(part, rings.front(), true);
  cap(part, rings.back(), false);
}

void addBlob(Part& part, const Vec3& centre, const Vec3& radii, int subdivisions, double bumps) {
  const Sphere ball = icosphere(subdivisions);
  Corners corners;
  for (const Vec3& p : ball.points) {
    const double lump =
        1.0 + bumps * (std::sin(5.0 * p.x + 1.0) * std::sin(6.0 * p.y + 2.0) + std::sin(7.0 * p.z + 4.0 * p.x));
    corners.push_back(part.corner(centre + radii * p * lump));
  }
  for (const auto& [a, b, c] : ball.triangles) part.triangle(corners[a], corners[b], corners[c]);
}

void addSheet(Part& part, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const std::uint32_t first = part.corner(a), second = part.corner(b), third = part.corner(c), fourth = part.corner(d);
  part.quad(first, second, third, fourth);
}

void addCells(Part& part, const Cells& cells) {
  std::map<std::array<int, 3>, std::uint32_t> known;
  const auto corner = [&](int i, int j, int k) {
    if (cells.wrapX) i %= cells.nx;
    const auto [place, fresh] = known.try_emplace({i, j, k}, 0u);
    if (fresh) place->second = part.corner(cells.corner(i, j, k));
    return place->second;
  };
  const auto filled = [&](int i, int j, int k) -> bool {
    if (cells.wrapX) i = (i + cells.nx) % cells.nx;
    if (i < 0 || j < 0 || k < 0 || i >= cells.nx || j >= cells.ny || k >= cells.nz) return false;
    return cells.fill(i, j, k).has_value();
  };
  const auto face = [&](int i, int j, int k, int axis, int end) {
    // The two other axes in cyclic order, swapped on the near side so that the face looks out of the cell.
    const int a = (axis + 1 + (end == 0 ? 1 : 0)) % 3, b = 3 - axis - a;
    std::array<std::uint32_t, 4> ids{};
    for (int q = 0; q < 4; ++q) {
      std::array<int, 3> at{i, j, k};
      at[static_cast<std::size_t>(axis)] += end;
      at[static_cast<std::size_t>(a)] += (q == 1 || q == 2) ? 1 : 0;
      at[static_cast<std::size_t>(b)] += q >= 2 ? 1 : 0;
      ids[static_cast<std::size_t>(q)] = corner(at[0], at[1], at[2]);
    }
    part.quad(ids[0], ids[1], ids[2], ids[3]);
  };
  for (int k = 0; k < cells.nz; ++k)
    for (int j = 0; j < cells.ny; ++j)
      for (int i = 0; i < cells.nx; ++i) {
        const auto material = cells.fill(i, j, k);
        if (!material) continue;
        part.use(*material);
        for (int axis = 0; axis < 3; ++axis)
          for (int end = 0; end < 2; ++end) {
            const int step = end == 0 ? -1 : 1;
            if (!filled(i + (axis == 0) * step, j + (axis == 1) * step, k + (axis == 2) * step))
              face(i, j, k, axis, end);
          }
      }
}

double interpolate(std::span<const Vec2> table, double key) {
  const std::size_t n = table.size();
  UMBRAGE_CHECK(n >= 2, "a curve needs two points");
  const auto slope = [&](std::size_t i) { return (table[i + 1].y - table[i].y) / (table[i + 1].x - table[i].x); };
  const auto tangent = [&](std::size_t i) {
    if (i == 0) return slope(0);
    if (i + 1 == n) return slope(n - 2);
    const double l = slope(i - 1), r = slope(i);
    return l * r <= 0.0 ? 0.0 : 2.0 * l * r / (l + r);
  };
  std::size_t i = 0;
  while (i + 2 < n && key > table[i + 1].x) ++i;
  const double width = table[i + 1].x - table[i].x, t = std::clamp((key - table[i].x) / width, 0.0, 1.0);
  const double t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * table[i].y + (t3 - 2 * t2 + t) * width * tangent(i) +
         (3 * t2 - 2 * t3) * table[i + 1].y + (t3 - t2) * width * tangent(i + 1);
}

std::vector<double> sortedLines(std::vector<double> lines) {
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end(), [](double a, double b) { return b - a < 1e-6; }), lines.end());
  return lines;
}

}  // namespace umbrage::samples::detail

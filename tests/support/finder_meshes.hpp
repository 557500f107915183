#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "umbrage/shadow/caster_set.hpp"

// Meshes for tests and benchmarks of finders, of any size: smooth, boxy, and soup.
namespace umbrage::shadow::test_meshes {

struct Mesh {
  std::vector<Vec3f> positions;
  std::vector<mesh::Triangle> triangles;
  [[nodiscard]] CasterSet casters() const { return buildCasters(positions, triangles); }
};

inline Vec3 knotCentreLine(double u) {
  const double a = 2.0 * std::numbers::pi * u, r = (2.0 + std::cos(3.0 * a)) / 2.0;
  return {r * std::cos(2.0 * a), r * std::sin(2.0 * a), 2.0 + 0.75 * std::sin(3.0 * a)};
}

/// A torus knot of about so many triangles, nearly equilateral ones.
inline Mesh smooth(std::uint32_t triangles) {
  constexpr double kLengthToGirth = 8.6;
  const auto rows = static_cast<std::uint32_t>(std::lround(std::sqrt(triangles / 2.0 / kLengthToGirth)));
  const std::uint32_t columns = triangles / 2 / rows;
  Mesh m;
  for (std::uint32_t i = 0; i < columns; ++i) {
    const double u = double(i) / columns;
    const Vec3 along = glm::normalize(knotCentreLine(u + 1e-4) - knotCentreLine(u - 1e-4));
    const Vec3 x = glm::normalize(glm::cross(along, Vec3(0.1, 0.2, 1.0))), y = glm::cross(along, x);
    for (std::uint32_t j = 0; j < rows; ++j) {
      const double b = 2.0 * std::numbers::pi * j / rows;
      m.positions.emplace_back(knotCentreLine(u) + 0.3 * (std::cos(b) * x + std::sin(b) * y));
      const std::uint32_t right = (i + 1) % columns * rows, here = i * rows, above = (j + 1) % rows;
      m.triangles.push_back({here + j, right + j, right + above});
      m.triangles.push_back({here + j, right + above, here + above});
    }
  }
  return m;
}

inline void addBox(Mesh& m, const Vec3f& foot, const Vec3f& size, float turn) {
  constexpr mesh::Triangle kFaces[] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                       {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  const auto first = static_cast<std::uint32_t>(m.positions.size());
  for (int k = 0; k < 8; ++k) {
    const float x = (k % 4 == 1 || k % 4 == 2 ? 0.5f : -0.5f) * size.x, y = (k % 4 >= 2 ? 0.5f : -0.5f) * size.y;
    m.positions.push_back(foot + Vec3f(x * std::cos(turn) - y * std::sin(turn), x * std::sin(turn) + y * std::cos(turn),
                                       k >= 4 ? size.z : 0.0f));
  }
  for (const mesh::Triangle& t : kFaces) m.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

/// A city of boxes, each turned its own way when `turned`.
inline Mesh boxy(std::uint32_t triangles, bool turned = true) {
  std::mt19937 random(1);
  const auto unit = [&] { return float(random() >> 8) * 0x1p-24f; };
  const std::uint32_t boxes = triangles / 12;
  const auto side = static_cast<std::uint32_t>(std::ceil(std::sqrt(double(boxes))));
  Mesh m;
  for (std::uint32_t b = 0; b < boxes; ++b) {
    const float x = 8 + 8 * unit(), y = 8 + 8 * unit(), z = 5 + 40 * unit(), turn = turned ? 6.28f * unit() : 0.0f;
    addBox(m, {20.0f * float(b % side), 20.0f * float(b / side), 0.0f}, {x, y, z}, turn);
  }
  return m;
}

/// Single triangles anywhere, all different.
inline Mesh soup(std::uint32_t triangles) {
  std::mt19937 random(1);
  const auto unit = [&] { return float(random() >> 8) * 0x1p-23f - 1.0f; };
  const auto anywhere = [&] {
    const float x = unit(), y = unit(), z = unit();
    return Vec3f(x, y, z);
  };
  const float size = 2.0f / std::sqrt(float(triangles));
  Mesh m;
  for (std::uint32_t t = 0; t < triangles; ++t) {
    const Vec3f centre = anywhere();
    for (int k = 0; k < 3; ++k) m.positions.push_back(centre + size * anywhere());
    m.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return m;
}

// --- lattices, where degeneracies are common ---

using Random = std::mt19937;

inline int between(Random& random, int low, int high) {
  return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
}

inline Vec3f latticePoint(Random& random, int reach) {
  const int x = between(random, -reach, reach), y = between(random, -reach, reach), z = between(random, -reach, reach);
  return {float(x), float(y), float(z)};
}

// Few points, so that edges are shared by many triangles, triangles are doubled, flat, slivers or in one plane.
inline Mesh latticeSoup(Random& random) {
  Mesh m;
  m.positions.resize(static_cast<std::size_t>(between(random, 3, 14)));
  const int reach = between(random, 1, 5);
  for (Vec3f& p : m.positions) p = latticePoint(random, reach);
  const auto last = static_cast<int>(m.positions.size()) - 1;
  m.triangles.resize(static_cast<std::size_t>(between(random, 0, 40)));
  for (mesh::Triangle& t : m.triangles)
    for (std::uint32_t& corner : t) corner = static_cast<std::uint32_t>(between(random, 0, last));
  if (between(random, 0, 1) == 1) {
    const Vec3f foot = latticePoint(random, 3), size = glm::abs(latticePoint(random, 2)) + Vec3f(1.0f);
    addBox(m, foot, size, 0.0f);
  }
  return m;
}

// Points and directions; often a corner, or in the plane of faces.
inline Vec4 latticeLight(Random& random, const Mesh& m) {
  const int kind = between(random, 0, 3);
  if (kind == 0) return {Vec3(m.positions[random() % m.positions.size()]), 1.0};
  const Vec3 p = Vec3(latticePoint(random, 6)) * (kind == 1 ? 1.0 : 0.25);
  if (kind == 3 && p != Vec3(0.0)) return {p, 0.0};
  return {p, 1.0};
}

}  // namespace umbrage::shadow::test_meshes

#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "umbrage/scene/scene.hpp"

/// Meshes and scenes written in code, for tests. Z is up.
namespace umbrage::shapes {

using mesh::Mesh;

inline Mesh quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return {"quad", {a, b, c, d}, {{0, 1, 2}, {0, 2, 3}}, {}};
}

inline Mesh triangle(const Vec3& a, const Vec3& b, const Vec3& c) { return {"triangle", {a, b, c}, {{0, 1, 2}}, {}}; }

/// Faces counter-clockwise seen from outside.
inline Mesh box(const Vec3& min, const Vec3& max) {
  Mesh m{"box", {}, {}, {}};
  for (int i = 0; i < 8; ++i)
    m.positions.push_back({i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z});
  m.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return m;
}

/// A surface over the unit square, (columns x rows) cells of two triangles; columns and rows may close into a ring.
inline Mesh grid(int columns, int rows, bool ringX, bool ringY, const std::function<Vec3(double, double)>& at) {
  Mesh m{"grid", {}, {}, {}};
  const int w = ringX ? columns : columns + 1, h = ringY ? rows : rows + 1;
  for (int j = 0; j < h; ++j)
    for (int i = 0; i < w; ++i) m.positions.push_back(at(double(i) / columns, double(j) / rows));
  const auto index = [&](int i, int j) { return static_cast<std::uint32_t>(j % h * w + i % w); };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      m.triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      m.triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  }
  return m;
}

/// Closed after welding: the poles are one position each.
inline Mesh sphere(const Vec3& centre, double radius, int columns, int rows) {
  Mesh m = grid(columns, rows, true, false, [&](double u, double v) {
    const double a = 2.0 * std::numbers::pi * u, b = std::numbers::pi * v;
    const double ring = v == 0.0 || v == 1.0 ? 0.0 : std::sin(b);
    return centre + radius * Vec3(ring * std::cos(a), ring * std::sin(a), -std::cos(b));
  });
  m.name = "sphere";
  return m;
}

/// A torus knot's tube: closed, strongly self-shadowing.
inline Mesh knot(const Vec3& centre, double radius, double tube, int columns, int rows) {
  const auto centreLine = [&](double u) {
    const double a = 2.0 * std::numbers::pi * u;
    const double r = radius * (2.0 + std::cos(3.0 * a)) / 3.0;
    return centre + Vec3(r * std::cos(2.0 * a), r * std::sin(2.0 * a), radius * std::sin(3.0 * a) / 2.0);
  };
  Mesh m = grid(columns, rows, true, true, [&](double u, double v) {
    const Vec3 along = glm::normalize(centreLine(u + 1e-4) - centreLine(u - 1e-4));
    const Vec3 x = glm::normalize(glm::cross(along, Vec3(0.1, 0.2, 1.0))), y = glm::cross(along, x);
    const double b = 2.0 * std::numbers::pi * v;
    return centreLine(u) + tube * (std::cos(b) * x + std::sin(b) * y);
  });
  m.name = "knot";
  return m;
}

/// One-sided: no winding is consistent.
inline Mesh moebius(const Vec3& centre, double radius, double width, int columns, int rows) {
  Mesh m = grid(columns, rows, false, false, [&](double u, double v) {
    const double a = 2.0 * std::numbers::pi * u, s = (v - 0.5) * width;
    // The last column is the first one upside down: the same numbers, so that it welds.
    const double half = u == 1.0 ? std::numbers::pi : 0.5 * a, full = u == 1.0 ? 0.0 : a;
    const double c = u == 1.0 ? -1.0 : std::cos(half), z = u == 1.0 ? 0.0 : std::sin(half);
    const double r = radius + s * c;
    return centre + Vec3(r * std::cos(full), r * std::sin(full), s * z);
  });
  m.name = "moebius";
  return m;
}

/// Random numbers that are the same everywhere (the standard's distributions are not).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 2654435769u + 88172645463325252ull) {}
  /// In [0, 1).
  double unit() {
    state_ ^= state_ << 13, state_ ^= state_ >> 7, state_ ^= state_ << 17;
    return double(state_ >> 11) * 0x1p-53;
  }
  double in(double low, double high) { return low + (high - low) * unit(); }
  int whole(int low, int high) { return low + static_cast<int>(unit() * (high - low + 1)); }
  Vec3 point(const Box3& box) {
    const double x = in(box.min.x, box.max.x), y = in(box.min.y, box.max.y);
    return {x, y, in(box.min.z, box.max.z)};
  }
  Vec3 latticePoint(int low, int high) {
    const int x = whole(low, high), y = whole(low, high);
    return {double(x), double(y), double(whole(low, high))};
  }

 private:
  std::uint64_t state_;
};

inline Mesh soup(std::uint64_t seed, int triangles, const std::function<Vec3(Random&)>& corner) {
  Random random(seed);
  Mesh m{"soup", {}, {}, {}};
  for (int i = 0; i < triangles; ++i) {
    const auto base = static_cast<std::uint32_t>(m.positions.size());
    for (int k = 0; k < 3; ++k) m.positions.push_back(corner(random));
    m.triangles.push_back({base, base + 1, base + 2});
  }
  return m;
}

/// A scene of one material in which every mesh is an instance of its own.
inline scene::Scene scene(std::vector<Mesh> meshes, const Mat4& toWorld = Mat4(1.0)) {
  scene::Scene s;
  s.materials.push_back({"grey", Vec3(0.8), 1.0});
  for (Mesh& m : meshes) {
    s.instances.push_back({m.name, static_cast<std::uint32_t>(s.meshes.size()), toWorld, true});
    s.meshes.push_back(std::make_shared<Mesh>(std::move(m)));
  }
  return s;
}

}  // namespace umbrage::shapes

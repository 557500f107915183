#pragma once

// Scenes for tests of sun hours, and sunlight asked moment by moment in double precision.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "umbrage/scene/surfaces.hpp"
#include "umbrage/study/exact_hours.hpp"

namespace umbrage::hours_tests {

using Random = std::mt19937;
inline double uniform(Random& random, double low, double high) {
  return low + (high - low) * double(random() >> 5) / double(1u << 27);
}

inline scene::Scene sceneOf(mesh::Mesh m) {
  scene::Scene s;
  s.materials.push_back({});
  s.meshes.push_back(std::make_shared<const mesh::Mesh>(std::move(m)));
  s.instances.push_back({"all", 0});
  return s;
}

/// A turned box, from `bottom` to `top`.
inline void addBox(mesh::Mesh& m, const Vec2& centre, const Vec2& half, double turn, double bottom, double top) {
  const auto base = static_cast<std::uint32_t>(m.positions.size());
  for (int i = 0; i < 8; ++i) {
    const double x = (i & 1) != 0 ? half.x : -half.x, y = (i & 2) != 0 ? half.y : -half.y;
    m.positions.push_back({centre.x + std::cos(turn) * x - std::sin(turn) * y,
                           centre.y + std::sin(turn) * x + std::cos(turn) * y, (i & 4) != 0 ? top : bottom});
  }
  constexpr std::uint32_t kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                          {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& f : kFaces) {
    m.triangles.push_back({base + f[0], base + f[1], base + f[2]});
    m.triangles.push_back({base + f[0], base + f[2], base + f[3]});
  }
}

inline mesh::Mesh boxes(int across, double cell, Random& random) {
  mesh::Mesh m;
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < across; ++j)
      addBox(m, {(i - across / 2) * cell, (j - across / 2) * cell}, {uniform(random, 2, 7), uniform(random, 2, 7)},
             uniform(random, -0.4, 0.4), -0.5, 6 + 60 * std::pow(uniform(random, 0, 1), 3));
  return m;
}

/// Walls without thickness, some of them leaning.
inline mesh::Mesh sheets(int count, Random& random) {
  mesh::Mesh m;
  for (int i = 0; i < count; ++i) {
    const Vec3 foot(uniform(random, -60, 60), uniform(random, -60, 60), 0),
        along(uniform(random, -15, 15), uniform(random, -15, 15), 0);
    const Vec3 up(uniform(random, -3, 3), uniform(random, -3, 3), uniform(random, 4, 25));
    const auto base = static_cast<std::uint32_t>(m.positions.size());
    for (const Vec3& p : {foot, foot + along, foot + along + up, foot + up}) m.positions.push_back(p);
    m.triangles.push_back({base, base + 1, base + 2});
    m.triangles.push_back({base, base + 2, base + 3});
  }
  return m;
}

inline mesh::Mesh soup(int count, Random& random) {
  mesh::Mesh m;
  for (int i = 0; i < count; ++i) {
    const Vec3 centre(uniform(random, -60, 60), uniform(random, -60, 60), uniform(random, 0, 30));
    for (int k = 0; k < 3; ++k)
      m.positions.push_back(centre + Vec3(uniform(random, -6, 6), uniform(random, -6, 6), uniform(random, -6, 6)));
    const auto base = static_cast<std::uint32_t>(3 * i);
    m.triangles.push_back({base, base + 1, base + 2});
  }
  return m;
}

inline mesh::Mesh terrain(int across, double cell) {
  mesh::Mesh m;
  for (int i = 0; i <= across; ++i)
    for (int j = 0; j <= across; ++j) {
      const double x = (i - across / 2) * cell, y = (j - across / 2) * cell;
      m.positions.push_back({x, y, 20 * std::sin(x / 37) * std::cos(y / 29) + 5 * std::sin(x / 7 + y / 11)});
    }
  const auto row = static_cast<std::uint32_t>(across + 1);
  for (std::uint32_t i = 0; i + 1 < row; ++i)
    for (std::uint32_t j = 0; j + 1 < row; ++j) {
      const std::uint32_t a = i * row + j;
      m.triangles.push_back({a, a + row, a + row + 1});
      m.triangles.push_back({a, a + row + 1, a + 1});
    }
  return m;
}

/// A closed ring, smooth: a tube of radius `tube` bent to one of radius `ring`, standing at a slant `high` above the ground.
inline mesh::Mesh ring(double ring, double tube, double high, std::uint32_t columns, std::uint32_t rows) {
  mesh::Mesh m;
  const Vec3 x(1, 0, 0), y(0, 0.6, 0.8), up(0, -0.8, 0.6);
  for (std::uint32_t i = 0; i < columns; ++i)
    for (std::uint32_t k = 0; k < rows; ++k) {
      const double a = 2 * 3.14159265358979 * i / columns, b = 2 * 3.14159265358979 * k / rows;
      const Vec3 out = std::cos(a) * x + std::sin(a) * y;
      m.positions.push_back(Vec3(0, 0, high) + (ring + tube * std::cos(b)) * out + tube * std::sin(b) * up);
      const std::uint32_t here = i * rows, beside = (i + 1) % columns * rows, above = (k + 1) % rows;
      m.triangles.push_back({here + k, beside + k, beside + above});
      m.triangles.push_back({here + k, beside + above, here + above});
    }
  return m;
}

struct NamedScene {
  std::string name;
  scene::Scene scene;
};

/// Closed, open, soup, terrain, city and a smooth solid.
inline std::vector<NamedScene> sceneKinds(int cityAcross) {
  Random random(7);
  std::vector<NamedScene> all;
  all.push_back({"closed", sceneOf(boxes(5, 22, random))});
  all.push_back({"open", sceneOf(sheets(40, random))});
  all.push_back({"soup", sceneOf(soup(400, random))});
  all.push_back({"terrain", sceneOf(terrain(40, 5))});
  all.push_back({"city", sceneOf(boxes(cityAcross, 20, random))});
  all.push_back({"smooth", sceneOf(ring(20, 6, 25, 120, 40))});
  return all;
}

/// A tree over triangles, for rays in double precision.
class Rays {
 public:
  explicit Rays(const scene::Scene& scene) : surfaces_(scene::flatten(scene)), order_(surfaces_.triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    if (!order_.empty()) build(0, order_.size());
  }
  [[nodiscard]] const scene::Surfaces& surfaces() const { return surfaces_; }

  /// Whether anything but `ignored` lies on the ray.
  [[nodiscard]] bool meets(const Vec3& from, const Vec3& direction, std::uint32_t ignored) const {
    return !nodes_.empty() && meets(0, from - surfaces_.origin, direction, ignored);
  }

 private:
  struct Node {
    Box3 box;
    std::size_t begin, end, left = 0, right = 0;
  };
  [[nodiscard]] Vec3 centre(std::uint32_t t) const {
    return (surfaces_.corner(t, 0) + surfaces_.corner(t, 1) + surfaces_.corner(t, 2)) / 3.0;
  }
  std::size_t build(std::size_t begin, std::size_t end) {
    const std::size_t here = nodes_.size();
    nodes_.push_back({{}, begin, end});
    Box3 box;
    for (std::size_t i = begin; i < end; ++i)
      for (int k = 0; k < 3; ++k) box.add(surfaces_.corner(order_[i], k));
    nodes_[here].box = box;
    if (end - begin <= 4) return here;
    const Vec3 size = box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::size_t middle = (begin + end) / 2;
    const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [&](auto a, auto b) { return centre(a)[axis] < centre(b)[axis]; });
    const std::size_t left = build(begin, middle), right = build(middle, end);
    nodes_[here].left = left, nodes_[here].right = right;
    return here;
  }
  [[nodiscard]] bool meets(std::size_t index, const Vec3& p, const Vec3& d, std::uint32_t ignored) const {
    const Node& n = nodes_[index];
    double near = 0.0, far = 1e300;
    for (int k = 0; k < 3; ++k) {
      if (d[k] == 0.0) {
        if (p[k] < n.box.min[k] || p[k] > n.box.max[k]) return false;
        continue;
      }
      const double a = (n.box.min[k] - p[k]) / d[k], b = (n.box.max[k] - p[k]) / d[k];
      near = std::max(near, std::min(a, b)), far = std::min(far, std::max(a, b));
    }
    if (near > far * (1 + 1e-12) + 1e-9) return false;
    if (n.right != 0) return meets(n.left, p, d, ignored) || meets(n.right, p, d, ignored);
    for (std::size_t i = n.begin; i < n.end; ++i)
      if (order_[i] != ignored && hit(order_[i], p, d)) return true;
    return false;
  }
  [[nodiscard]] bool hit(std::uint32_t t, const Vec3& p, const Vec3& d) const {
    const Vec3 a = surfaces_.corner(t, 0) - p, b = surfaces_.corner(t, 1) - p, c = surfaces_.corner(t, 2) - p;
    const double u = glm::dot(glm::cross(a, b), d), v = glm::dot(glm::cross(b, c), d),
                 w = glm::dot(glm::cross(c, a), d);
    if (!((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0)) || u + v + w == 0.0) return false;
    return glm::dot(a * v + b * w + c * u, d) * (u + v + w) > 0.0 ||
           glm::dot((a * v + b * w + c * u) / (u + v + w), d) > 0.0;
  }
  scene::Surfaces surfaces_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

/// A receiver, and the triangle it lies on (or none: 0xffffffff).
struct Placed {
  study::Receiver receiver;
  std::uint32_t on = 0xffffffffu;
};

/// Half of them free in the lower part of the scene's space, half on surfaces.
inline std::vector<Placed> placed(const Rays& rays, int count, Random& random) {
  const scene::Surfaces& s = rays.surfaces();
  std::vector<Placed> all;
  for (int i = 0; i < count; ++i) {
    Placed p;
    if (i % 2 == 0) {
      for (int k = 0; k < 3; ++k) p.receiver.position[k] = uniform(random, s.bounds.min[k], s.bounds.max[k]);
      p.receiver.position.z =
          s.bounds.min.z + 0.51 + std::abs(uniform(random, 0, 0.4)) * (p.receiver.position.z - s.bounds.min.z);
      if (i % 4 == 0) p.receiver.normal = {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -0.3, 1)};
    } else {
      p.on = static_cast<std::uint32_t>(random() % s.triangles.size());
      double u = uniform(random, 0.01, 0.98), v = uniform(random, 0.01, 0.98);
      if (u + v > 0.99) u = 0.99 - 0.99 * u, v = 0.99 - 0.99 * v;
      const Vec3 a = s.corner(p.on, 0);
      p.receiver.position = a + u * (s.corner(p.on, 1) - a) + v * (s.corner(p.on, 2) - a);
      p.receiver.normal = glm::normalize(s.normal(p.on));
      if (p.receiver.normal.z < 0) p.receiver.normal = -p.receiver.normal;
    }
    p.receiver.position += s.origin;
    all.push_back(p);
  }
  return all;
}

/// Seconds of the course at which the exact times and a ray say different things, more than a second from any exact moment.
inline int disagreements(const Rays& rays, const Placed& placed, std::span<const study::TimeSpan> lit,
                         const study::SunCourse& course, std::chrono::milliseconds step = std::chrono::seconds(1)) {
  using namespace std::chrono_literals;
  int wrong = 0;
  std::size_t next = 0;
  const bool facing = placed.receiver.normal != Vec3(0.0);
  for (sun::Instant t = course.span().from; t < course.span().to; t += step) {
    while (next < lit.size() && lit[next].to <= t) ++next;
    const bool exact = next < lit.size() && lit[next].from <= t;
    const auto nearTo = [&](sun::Instant moment) { return moment - t <= 1s && t - moment <= 1s; };
    if ((next < lit.size() && (nearTo(lit[next].from) || nearTo(lit[next].to))) ||
        (next > 0 && nearTo(lit[next - 1].to)))
      continue;
    const Vec3 d = course.towards(t);
    if (std::abs(d.z) < 1e-4) continue;  // rise and set are the course's own, to the second
    const bool ray = d.z > 0 && (!facing || glm::dot(placed.receiver.normal, d) > 0) &&
                     !rays.meets(placed.receiver.position, d, placed.on);
    if (ray != exact) ++wrong;
  }
  return wrong;
}

}  // namespace umbrage::hours_tests

#include <cmath>
#include <cstdint>

#include "ground.hpp"
#include "staged_scene.hpp"

namespace umbrage::benchmarks {
namespace {

constexpr double kCell = 20.0;

// Marsaglia's xorshift, so that the city is the same on every machine. In [0, 1).
class Random {
 public:
  double next() {
    state_ ^= state_ << 13, state_ ^= state_ >> 17, state_ ^= state_ << 5;
    return double(state_ % 1000) / 1000.0;
  }

 private:
  std::uint32_t state_ = 12345;
};

// Corners in the order of the bits x, y, z. The foot is half a metre below the ground, so that no face lies in its plane.
mesh::Mesh house(const Vec2& corner, Random& random) {
  const double width = 5 + 9 * random.next(), depth = 5 + 9 * random.next();
  const double height = 6 + 70 * std::pow(random.next(), 3), turn = 0.6 * (random.next() - 0.5);
  const Vec2 half(width / 2, depth / 2), centre(corner.x + half.x, corner.y - half.y);
  mesh::Mesh m;
  for (int i = 0; i < 8; ++i) {
    const double x = (i & 1) != 0 ? half.x : -half.x, y = (i & 2) != 0 ? half.y : -half.y;
    m.positions.push_back(snapped({centre.x + std::cos(turn) * x - std::sin(turn) * y,
                                   centre.y + std::sin(turn) * x + std::cos(turn) * y, (i & 4) != 0 ? height : -0.5}));
  }
  constexpr std::uint32_t kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                          {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& f : kFaces) {
    m.triangles.push_back({f[0], f[1], f[2]});
    m.triangles.push_back({f[0], f[2], f[3]});
  }
  return m;
}

scene::Camera camera(const Vec3& eye, const Vec3& target) {
  scene::Camera c;
  c.eye = eye, c.target = target, c.fovY = Angle::radians(0.9);
  return c;
}

}  // namespace

StagedScene city(int boxes) {
  scene::Scene s;
  s.source = "city";
  s.materials.push_back({"house", Vec3(0.8), 1.0});
  s.materials.push_back({"ground", Vec3(0.6), 1.0});
  const double radius = boxes * kCell / 2;
  Random random;
  for (int i = 0; i < boxes; ++i)
    for (int j = 0; j < boxes; ++j) {
      const std::string name = "house" + std::to_string(i * boxes + j);
      mesh::Mesh m = house({(i - boxes / 2) * kCell, (boxes / 2 - j) * kCell}, random);
      m.name = name;
      s.instances.push_back({name, static_cast<std::uint32_t>(s.meshes.size())});
      s.meshes.push_back(std::make_shared<const mesh::Mesh>(std::move(m)));
    }
  addGround(s, 1.3 * radius, 1);
  const scene::Camera air = camera(radius * Vec3(-0.55, 0.75, 0.28), {0, 0.05 * radius, 0});
  const Vec3 street(-203.5, 243, 2.5);
  const scene::Light high{scene::PointLight{radius * Vec3(0.25, -0.15, 0.35)}, Vec3(1.0), 1.0, "high"};
  const scene::Light lamp{scene::PointLight{{-3, 3, 14}}, Vec3(1.0), 1.0, "lamp"};
  return {"city",
          std::move(s),
          {{"city_air", air, high},
           {"city_street", camera(street, street + Vec3(60, -35, 6)), high},
           {"city_lamp", air, lamp}}};
}

}  // namespace umbrage::benchmarks

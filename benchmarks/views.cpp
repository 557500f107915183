#include "views.hpp"

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "scenes/staged_scene.hpp"
#include "umbrage/samples/samples.hpp"

namespace umbrage::benchmarks {
namespace {

scene::Light afternoonSun() { return {scene::DirectionalLight{{0.6, 0.5, -0.55}}, Vec3(1.0), 1.0, "sun"}; }

scene::Camera camera(const Vec3& eye, const Vec3& target) {
  scene::Camera c;
  c.eye = eye;
  c.target = target;
  return c;
}

struct Building {
  std::shared_ptr<const shadow::Geometry> geometry;
  Box3 box;
};

const Building& building() {
  static const Building built = [] {
    auto s = samples::make("building");
    if (!s) std::abort();
    const Box3 box = scene::bounds(*s);
    return Building{shadow::makeGeometry(scene::withGround(std::move(*s))), box};
  }();
  return built;
}

Vec3 knotCentreLine(double u) {
  const double a = 2.0 * std::numbers::pi * u, r = (2.0 + std::cos(3.0 * a)) / 2.0;
  return {r * std::cos(2.0 * a), r * std::sin(2.0 * a), 2.0 + 0.75 * std::sin(3.0 * a)};
}

mesh::Mesh knotMesh(std::uint32_t columns, std::uint32_t rows) {
  mesh::Mesh m;
  for (std::uint32_t i = 0; i < columns; ++i) {
    const double u = double(i) / columns;
    const Vec3 along = glm::normalize(knotCentreLine(u + 1e-4) - knotCentreLine(u - 1e-4));
    const Vec3 x = glm::normalize(glm::cross(along, Vec3(0.1, 0.2, 1.0))), y = glm::cross(along, x);
    for (std::uint32_t j = 0; j < rows; ++j) {
      const double b = 2.0 * std::numbers::pi * j / rows;
      m.positions.push_back(knotCentreLine(u) + 0.3 * (std::cos(b) * x + std::sin(b) * y));
      const std::uint32_t right = (i + 1) % columns * rows, here = i * rows, above = (j + 1) % rows;
      m.triangles.push_back({here + j, right + j, right + above});
      m.triangles.push_back({here + j, right + above, here + above});
    }
  }
  return m;
}

View viewOf(const StagedScene& stage, const std::shared_ptr<const shadow::Geometry>& geometry, std::size_t shot) {
  const Shot& s = stage.shots[shot];
  return {s.name, geometry, s.camera, s.light};
}

View cityView(std::size_t shot) {
  static const StagedScene stage = city();
  static const auto geometry = shadow::makeGeometry(stage.scene);
  return viewOf(stage, geometry, shot);
}

}  // namespace

View fromTheAir() {
  const Building& b = building();
  const double r = b.box.radius();
  return {"building_air", b.geometry, camera(b.box.centre() + r * Vec3(-0.9, -1.2, 0.8), b.box.centre()),
          afternoonSun()};
}

View fromTheStreet() {
  const Building& b = building();
  const double r = b.box.radius();
  const Vec3 foot(b.box.centre().x, b.box.centre().y, b.box.min.z);
  return {"building_street", b.geometry, camera(foot + Vec3(-0.8 * r, -0.9 * r, 1.7), foot + Vec3(0, 0, 0.3 * r)),
          afternoonSun()};
}

View knot() {
  scene::Scene s;
  s.materials.push_back({"grey", Vec3(0.8), 1.0});
  s.meshes.push_back(std::make_shared<mesh::Mesh>(knotMesh(1000, 35)));
  s.instances.push_back({"knot", 0});
  return {"knot",
          shadow::makeGeometry(scene::withGround(std::move(s))),
          camera({2.6, -3.4, 4.2}, {0, 0, 1.8}),
          {scene::PointLight{{2, -4, 7}}, Vec3(1.0), 1.0, "lamp"}};
}

View cityAir() { return cityView(0); }
View cityStreet() { return cityView(1); }
View cityLamp() { return cityView(2); }

View groovedKnotView() {
  const StagedScene stage = groovedKnot();
  return viewOf(stage, shadow::makeGeometry(stage.scene), 0);
}

}  // namespace umbrage::benchmarks

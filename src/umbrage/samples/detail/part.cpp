#include "umbrage/samples/detail/part.hpp"

#include <cmath>
#include <utility>

#include "umbrage/base/check.hpp"

namespace umbrage::samples::detail {
namespace {

constexpr double kPerMetre = 1024.0;

// Adding zero turns -0 into 0.
double snap(double metres) { return std::round(metres * kPerMetre) / kPerMetre + 0.0; }

double linear(std::uint32_t code) {
  const double c = static_cast<double>(code & 0xffu) / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

}  // namespace

std::uint32_t Part::corner(const Vec3& p) {
  mesh_.positions.emplace_back(snap(p.x), snap(p.y), snap(p.z));
  return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
}

void Part::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  mesh_.triangles.push_back({a, b, c});
  mesh_.materials.push_back(material_);
}

void Part::quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  triangle(a, b, c);
  triangle(a, c, d);
}

SceneBuilder::SceneBuilder(std::string name) { scene_.source = "sample:" + std::move(name); }

std::uint32_t SceneBuilder::material(std::string name, std::uint32_t srgb, double opacity) {
  scene_.materials.push_back({std::move(name), Vec3(linear(srgb >> 16), linear(srgb >> 8), linear(srgb)), opacity});
  return static_cast<std::uint32_t>(scene_.materials.size() - 1);
}

void SceneBuilder::fill(std::uint32_t material, const Vec3& filter, double ior) {
  scene_.materials[material].filter = filter;
  scene_.materials[material].ior = ior;
}

std::uint32_t SceneBuilder::share(Part part) {
  scene_.meshes.push_back(std::make_shared<const mesh::Mesh>(std::move(part).take()));
  return static_cast<std::uint32_t>(scene_.meshes.size() - 1);
}

void SceneBuilder::place(std::string path, std::uint32_t mesh, const Mat4& toWorld) {
  UMBRAGE_CHECK(mesh < scene_.meshes.size(), "the mesh is not shared yet");
  scene_.instances.push_back({std::move(path), mesh, toWorld, true});
}

void SceneBuilder::place(const std::string& parent, Part part) {
  const std::uint32_t mesh = share(std::move(part));
  place(parent + "/" + scene_.meshes[mesh]->name, mesh, Mat4(1.0));
}

Mat4 placed(const Vec3& at, int quarterTurns, double scale) {
  constexpr double kCos[] = {1.0, 0.0, -1.0, 0.0};
  const double c = scale * kCos[quarterTurns & 3], s = scale * kCos[(quarterTurns + 3) & 3];
  return {{c, s, 0.0, 0.0}, {-s, c, 0.0, 0.0}, {0.0, 0.0, scale, 0.0}, {at, 1.0}};
}

}  // namespace umbrage::samples::detail

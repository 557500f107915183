#include "umbrage/shadow/smooth_normals.hpp"

#include <algorithm>
#include <cmath>

namespace umbrage::shadow {
namespace {

/// The triangles around each point: those of point i are triangles[first[i]] to triangles[first[i + 1] - 1].
struct Around {
  std::vector<std::uint32_t> first, triangles;
};

Around trianglesAround(const scene::Surfaces& surfaces) {
  Around around{std::vector<std::uint32_t>(surfaces.positions.size() + 1, 0), {}};
  for (const mesh::Triangle& t : surfaces.triangles)
    for (const std::uint32_t corner : t) ++around.first[corner + 1];
  for (std::size_t i = 1; i < around.first.size(); ++i) around.first[i] += around.first[i - 1];
  std::vector<std::uint32_t> next(around.first.begin(), around.first.end() - 1);
  around.triangles.resize(around.first.back());
  for (std::uint32_t t = 0; t < surfaces.triangles.size(); ++t)
    for (const std::uint32_t corner : surfaces.triangles[t]) around.triangles[next[corner]++] = t;
  return around;
}

// The angle of a triangle at one of its points.
double angleAt(const scene::Surfaces& surfaces, std::uint32_t triangle, std::uint32_t point) {
  const mesh::Triangle& t = surfaces.triangles[triangle];
  const int k = t[0] == point ? 0 : t[1] == point ? 1 : 2;
  const Vec3 at = surfaces.corner(triangle, k);
  const Vec3 a = surfaces.corner(triangle, (k + 1) % 3) - at, b = surfaces.corner(triangle, (k + 2) % 3) - at;
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace

SmoothNormals smoothNormals(const scene::Surfaces& surfaces, Angle crease) {
  const Around around = trianglesAround(surfaces);
  const double least = cos(crease);
  std::vector<Vec3> unit;
  for (std::uint32_t t = 0; t < surfaces.triangles.size(); ++t) {
    const Vec3 normal = surfaces.normal(t);
    const double length = glm::length(normal);
    unit.push_back(length > 0.0 ? normal / length : Vec3(0.0));
  }
  const auto cornerOf = [&](std::uint32_t triangle, std::uint32_t point) {
    Vec3 sum(0.0);
    double lowest = 1.0;  // cosine to the own normal
    for (std::uint32_t i = around.first[point]; i < around.first[point + 1]; ++i) {
      const std::uint32_t other = around.triangles[i];
      const double cosine = glm::dot(unit[triangle], unit[other]);
      if (std::abs(cosine) < least) continue;
      sum += (cosine < 0.0 ? -1.0 : 1.0) * angleAt(surfaces, other, point) * unit[other];
      lowest = std::min(lowest, std::abs(cosine));
    }
    const double length = glm::length(sum);
    if (!(length > 0.0)) return SmoothNormals::Corner{Vec3f(unit[triangle]), 0.0f};
    return SmoothNormals::Corner{Vec3f(sum / length),
                                 static_cast<float>(std::sqrt(std::max(0.0, 1.0 - lowest * lowest)))};
  };
  SmoothNormals out;
  out.corners.resize(surfaces.triangles.size());
  for (std::uint32_t t = 0; t < surfaces.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) out.corners[t][k] = cornerOf(t, surfaces.triangles[t][k]);
  return out;
}

}  // namespace umbrage::shadow

#include "umbrage/coin/detail/clipping.hpp"

#include <Inventor/SbPlane.h>
#include <Inventor/elements/SoClipPlaneElement.h>
#include <Inventor/misc/SoState.h>

#include <algorithm>

#include "umbrage/coin/detail/matrices.hpp"

namespace umbrage::coin::detail {
namespace {

/// A plane as the points of a shape see it, in the shape's own space.
struct LocalPlane {
  Vec3 normal;
  double distance;
  [[nodiscard]] double above(const Vec3& p) const { return glm::dot(normal, p) - distance; }
};

std::vector<LocalPlane> localPlanes(const Mat4& toWorld, std::span<const ClipPlane> planes) {
  std::vector<LocalPlane> out;
  for (const ClipPlane& plane : planes)
    out.push_back(
        {glm::transpose(Mat3(toWorld)) * plane.normal, plane.distance - glm::dot(plane.normal, Vec3(toWorld[3]))});
  return out;
}

// The same whichever end comes first.
Vec3 cutPoint(Vec3 a, Vec3 b, const LocalPlane& plane) {
  if (lexicographicallyLess(Vec3f(b), Vec3f(a))) std::swap(a, b);
  const double from = plane.above(a), to = plane.above(b);
  return a + from / (from - to) * (b - a);
}

std::vector<Vec3> cut(const std::vector<Vec3>& polygon, const LocalPlane& plane) {
  std::vector<Vec3> left;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &here = polygon[i], &next = polygon[(i + 1) % polygon.size()];
    const bool isIn = plane.above(here) >= 0.0, goesIn = plane.above(next) >= 0.0;
    if (isIn) left.push_back(here);
    if (isIn != goesIn) left.push_back(cutPoint(here, next, plane));
  }
  return left;
}

std::shared_ptr<const mesh::Mesh> clipped(const std::shared_ptr<const mesh::Mesh>& mesh,
                                          std::span<const LocalPlane> planes) {
  if (mesh == nullptr) return nullptr;
  const auto outside = [&](const LocalPlane& plane) {
    return std::ranges::any_of(mesh->positions, [&](const Vec3& p) { return plane.above(p) < 0.0; });
  };
  if (std::ranges::none_of(planes, outside)) return mesh;
  std::vector<Vec3> corners;
  for (const mesh::Triangle& t : mesh->triangles) {
    std::vector<Vec3> polygon = {mesh->positions[t[0]], mesh->positions[t[1]], mesh->positions[t[2]]};
    for (const LocalPlane& plane : planes) polygon = cut(polygon, plane);
    for (std::size_t k = 2; k < polygon.size(); ++k)
      corners.insert(corners.end(), {polygon[0], polygon[k - 1], polygon[k]});
  }
  return meshOf(corners);
}

}  // namespace

std::vector<ClipPlane> clipPlanesAt(SoState* state) {
  std::vector<ClipPlane> planes;
  if (!state->isElementEnabled(SoClipPlaneElement::getClassStackIndex())) return planes;
  const SoClipPlaneElement* known = SoClipPlaneElement::getInstance(state);
  for (int i = 0; i < known->getNum(); ++i) {
    const SbPlane& plane = known->get(i, TRUE);
    planes.push_back({vectorOf(plane.getNormal()), double(plane.getDistanceFromOrigin())});
  }
  return planes;
}

std::shared_ptr<const ShapeTriangles> clipped(const std::shared_ptr<const ShapeTriangles>& shape, const Mat4& toWorld,
                                              std::span<const ClipPlane> planes) {
  const auto local = localPlanes(toWorld, planes);
  ShapeTriangles left{clipped(shape->opaque, local), clipped(shape->veiled, local), shape->reach};
  if (left.opaque == shape->opaque && left.veiled == shape->veiled) return shape;
  return std::make_shared<const ShapeTriangles>(std::move(left));
}

}  // namespace umbrage::coin::detail

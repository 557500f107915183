#include "umbrage/render/posed_casters.hpp"

#include "umbrage/base/check.hpp"

namespace umbrage::render {
namespace {

Mat3 inverseOf(const PosedCasters& posed) {
  const Mat3 linear(posed.toWorld);
  UMBRAGE_CHECK(glm::determinant(linear) != 0.0, "a pose that can be undone");
  return glm::inverse(linear);
}

Vec3 cornerOf(const Box3& box, int i) {
  return {(i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
          (i & 4) != 0 ? box.max.z : box.min.z};
}

}  // namespace

Vec4 lightFrom(const PosedCasters& posed, const scene::Light& light) {
  const Vec4 world = scene::homogeneous(light, Vec3(0.0));
  // The translation must not enter here even as a product with zero: the memo compares bits.
  if (world.w == 0.0) return {inverseOf(posed) * Vec3(world), 0.0};
  return {pointFrom(posed, Vec3(world)), 1.0};
}

Vec3 pointFrom(const PosedCasters& posed, const Vec3& world) {
  return inverseOf(posed) * (world - Vec3(posed.toWorld[3])) - posed.casters->origin;
}

Box3 boxFrom(const PosedCasters& posed, const Box3& world) {
  Box3 box;
  if (world.empty()) return box;
  for (int i = 0; i < 8; ++i) box.add(pointFrom(posed, cornerOf(world, i)));
  return box;
}

bool mirrors(const PosedCasters& posed) { return glm::determinant(Mat3(posed.toWorld)) < 0.0; }

Box3 worldBounds(const PosedCasters& posed) {
  const Box3& own = posed.casters->bounds;
  Box3 box;
  if (own.empty()) return box;
  for (int i = 0; i < 8; ++i) box.add(Vec3(posed.toWorld * Vec4(cornerOf(own, i) + posed.casters->origin, 1.0)));
  return box;
}

}  // namespace umbrage::render

#include "umbrage/render/posed_casters.hpp"

#include "umbrage/base/check.hpp"

namespace umbrage::render {
namespace {

Mat3 inverseOf(const PosedCasters& posed) {
  const Mat3 linear(posed.toWorld);
  UMBRAGE_CHECK(glm::determinant(linear) != 0.0, "a pose that can be undone");
  return glm::inverse(linear);
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

bool mirrors(const PosedCasters& posed) { return glm::determinant(Mat3(posed.toWorld)) < 0.0; }

Box3 worldBounds(const PosedCasters& posed) {
  const Box3& own = posed.casters->bounds;
  Box3 box;
  if (own.empty()) return box;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner((i & 1) != 0 ? own.max.x : own.min.x, (i & 2) != 0 ? own.max.y : own.min.y,
                      (i & 4) != 0 ? own.max.z : own.min.z);
    box.add(Vec3(posed.toWorld * Vec4(corner + posed.casters->origin, 1.0)));
  }
  return box;
}

}  // namespace umbrage::render

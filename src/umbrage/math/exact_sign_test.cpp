#include "umbrage/math/exact_sign.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace umbrage {
namespace {

__extension__ typedef __int128 Wide;
struct Whole {
  std::int64_t x, y, z;
  [[nodiscard]] Vec3 real() const { return {double(x), double(y), double(z)}; }
};

int signOf(Wide value) { return value > 0 ? +1 : value < 0 ? -1 : 0; }
Wide determinant(const Whole& a, const Whole& b, const Whole& c) {
  return Wide(a.x) * (Wide(b.y) * c.z - Wide(b.z) * c.y) + Wide(a.y) * (Wide(b.z) * c.x - Wide(b.x) * c.z) +
         Wide(a.z) * (Wide(b.x) * c.y - Wide(b.y) * c.x);
}

Whole anyWhole(std::int64_t size) {
  const auto one = [&] { return *rc::gen::inRange<std::int64_t>(-size, size + 1); };
  return {one(), one(), one()};
}
// Nearly, or exactly, in the plane of two others and the origin.
Whole nearPlane(const Whole& a, const Whole& b) {
  const std::int64_t i = *rc::gen::inRange(-9, 10), j = *rc::gen::inRange(-9, 10);
  const Whole off = anyWhole(1);
  return {i * a.x + j * b.x + off.x, i * a.y + j * b.y + off.y, i * a.z + j * b.z + off.z};
}

RC_GTEST_PROP(ExactSign, IsThatOfIntegers, ()) {
  const Whole a = anyWhole(std::int64_t{1} << 36), b = anyWhole(std::int64_t{1} << 36);
  const Whole c = *rc::gen::inRange(0, 2) == 0 ? anyWhole(std::int64_t{1} << 36) : nearPlane(a, b);
  RC_ASSERT(signOfDeterminant(a.real(), b.real(), c.real()) == signOf(determinant(a, b, c)));
}

RC_GTEST_PROP(ExactSign, SideOfPlaneIsThatOfIntegers, ()) {
  const Whole a = anyWhole(1 << 20), b = anyWhole(1 << 20), c = nearPlane(a, b), d = anyWhole(1 << 20);
  const auto minus = [](const Whole& p, const Whole& q) { return Whole{p.x - q.x, p.y - q.y, p.z - q.z}; };
  const Whole none{0, 0, 0};
  RC_ASSERT(sideOfPlane(a.real(), b.real(), c.real(), {d.real(), 1.0}) ==
            signOf(determinant(minus(a, d), minus(b, d), minus(c, d))));
  RC_ASSERT(sideOfPlane(a.real(), b.real(), c.real(), {d.real(), 0.0}) ==
            signOf(determinant(minus(b, a), minus(c, a), minus(none, d))));
}

// On a tiny lattice nearly everything is in line with the eye.
RC_GTEST_PROP(SideSeen, IsDecidedUnlessPointsAreInLineAndFlipsWhenTwoChangePlaces, ()) {
  const Whole a = anyWhole(2), b = anyWhole(2), c = anyWhole(2);
  const Sighted p{a.real(), 1.0}, q{b.real(), 1.0}, r{c.real(), 1.0};
  const int side = sideSeen(p, q, r);
  const Vec3 normal = glm::cross(b.real() - a.real(), c.real() - a.real());
  RC_ASSERT((side == 0) == (normal == Vec3(0.0)));
  RC_ASSERT(sideSeen(q, p, r) == -side);
  RC_ASSERT(sideSeen(q, r, p) == side);
}

}  // namespace
}  // namespace umbrage

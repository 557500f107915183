#include "umbrage/math/exact_sign.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace umbrage {
namespace {

// A sum of doubles that do not overlap, the smallest first: what no single double can hold.
class Expansion {
 public:
  void add(double value) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const double sum = value + parts_[i], back = sum - value;
      const double rest = (value - (sum - back)) + (parts_[i] - back);
      value = sum;
      if (rest != 0.0) parts_[kept++] = rest;
    }
    if (value != 0.0) parts_[kept++] = value;
    count_ = kept;
  }

  void addProduct(double a, double b, double c) {
    const double ab = a * b, abRest = std::fma(a, b, -ab);
    for (const double factor : {ab, abRest}) {
      const double product = factor * c;
      add(std::fma(factor, c, -product));
      add(product);
    }
  }

  void addDeterminant(const Vec3& a, const Vec3& b, const Vec3& c) {
    addProduct(a.x, b.y, c.z), addProduct(-a.x, b.z, c.y);
    addProduct(a.y, b.z, c.x), addProduct(-a.y, b.x, c.z);
    addProduct(a.z, b.x, c.y), addProduct(-a.z, b.y, c.x);
  }

  [[nodiscard]] int sign() const { return count_ == 0 ? 0 : parts_[count_ - 1] > 0.0 ? +1 : -1; }

 private:
  std::array<double, 128> parts_{};
  std::size_t count_ = 0;
};

// Crooked: with no small ratio between its coordinates.
constexpr std::array<double, 3> kStep{0.5413793103448276, -0.8397031539888683, 0.3068528194400547};

int signAfterTheStep(const Sighted& a, const Sighted& b, const Sighted& c) {
  const Vec3 step(kStep[0], kStep[1], kStep[2]);
  Expansion change;  // of the determinant, to first order; with a step in two columns it would vanish
  if (a.w != 0.0) change.addDeterminant(-step, b.v, c.v);
  if (b.w != 0.0) change.addDeterminant(a.v, -step, c.v);
  if (c.w != 0.0) change.addDeterminant(a.v, b.v, -step);
  return change.sign();
}

}  // namespace

int signOfDeterminant(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double p0 = b.y * c.z, m0 = b.z * c.y, p1 = b.z * c.x, m1 = b.x * c.z, p2 = b.x * c.y, m2 = b.y * c.x;
  const double value = a.x * (p0 - m0) + a.y * (p1 - m1) + a.z * (p2 - m2);
  const double size = std::abs(a.x) * (std::abs(p0) + std::abs(m0)) + std::abs(a.y) * (std::abs(p1) + std::abs(m1)) +
                      std::abs(a.z) * (std::abs(p2) + std::abs(m2));
  if (std::abs(value) > kDeterminantError * size) return value > 0.0 ? +1 : -1;
  Expansion exact;
  exact.addDeterminant(a, b, c);
  return exact.sign();
}

int sideSeen(const Sighted& a, const Sighted& b, const Sighted& c) {
  const int sign = signOfDeterminant(a.v, b.v, c.v);
  return sign != 0 ? sign : signAfterTheStep(a, b, c);
}

int sideOfPlane(const Vec3& a, const Vec3& b, const Vec3& c, const Sighted& d) {
  Expansion sum;
  if (d.w != 0.0) sum.addDeterminant(a, b, c);
  sum.addDeterminant(-d.v, b, c);
  sum.addDeterminant(a, -d.v, c);
  sum.addDeterminant(a, b, -d.v);
  return sum.sign();
}

}  // namespace umbrage

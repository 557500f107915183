#pragma once

// Eight lanes in plain C++: the same operations as lanes_wide.hpp, on every processor.
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace umbrage::study::detail::plain {

struct Mask {
  std::uint32_t v;
};
inline Mask operator&(Mask a, Mask b) { return {a.v & b.v}; }
inline Mask operator|(Mask a, Mask b) { return {a.v | b.v}; }
inline Mask without(Mask a, Mask b) { return {b.v & ~a.v}; }
inline std::uint32_t bits(Mask a) { return a.v; }

struct Lanes {
  float v[8];
  Lanes() = default;
  explicit Lanes(float value) { std::fill(v, v + 8, value); }
};
template <class Fn>
Lanes each(Fn&& fn) {
  Lanes out;
  for (int i = 0; i < 8; ++i) out.v[i] = fn(i);
  return out;
}
template <class Fn>
Mask where(Fn&& fn) {
  std::uint32_t m = 0;
  for (int i = 0; i < 8; ++i) m |= (fn(i) ? 1u : 0u) << i;
  return {m};
}
inline Lanes load(const float* p) {
  return each([=](int i) { return p[i]; });
}
inline Lanes load(const float* p, const float* q) {
  return each([=](int i) { return i < 4 ? p[i] : q[i - 4]; });
}
inline Lanes halves(float low, float high) {
  return each([=](int i) { return i < 4 ? low : high; });
}
inline void store(float* p, const Lanes& a) { std::copy(a.v, a.v + 8, p); }
inline Lanes operator+(const Lanes& a, const Lanes& b) {
  return each([&](int i) { return a.v[i] + b.v[i]; });
}
inline Lanes operator-(const Lanes& a, const Lanes& b) {
  return each([&](int i) { return a.v[i] - b.v[i]; });
}
inline Lanes operator*(const Lanes& a, const Lanes& b) {
  return each([&](int i) { return a.v[i] * b.v[i]; });
}
inline Lanes operator/(const Lanes& a, const Lanes& b) {
  return each([&](int i) { return a.v[i] / b.v[i]; });
}
inline Lanes operator-(const Lanes& a) {
  return each([&](int i) { return -a.v[i]; });
}
inline Lanes fma(const Lanes& a, const Lanes& b, const Lanes& c) { return a * b + c; }
inline Lanes fms(const Lanes& a, const Lanes& b, const Lanes& c) { return a * b - c; }
inline Lanes fnma(const Lanes& a, const Lanes& b, const Lanes& c) { return c - a * b; }
/// a b - c d, in double precision, where products of floats are exact.
inline Lanes difference(const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& d) {
  return each([&](int i) { return float(double(a.v[i]) * double(b.v[i]) - double(c.v[i]) * double(d.v[i])); });
}
inline Lanes smaller(const Lanes& a, const Lanes& b) {
  return each([&](int i) { return std::min(a.v[i], b.v[i]); });
}
inline Lanes larger(const Lanes& a, const Lanes& b) {
  return each([&](int i) { return std::max(a.v[i], b.v[i]); });
}
inline Lanes magnitude(const Lanes& a) {
  return each([&](int i) { return std::abs(a.v[i]); });
}
inline Lanes flipped(const Lanes& a, const Lanes& b) {
  return each([&](int i) { return std::signbit(b.v[i]) ? -a.v[i] : a.v[i]; });
}
inline Lanes root(const Lanes& a) {
  return each([&](int i) { return std::sqrt(a.v[i]); });
}
inline Lanes inverse(const Lanes& a) {
  return each([&](int i) { return 1.0f / a.v[i]; });
}
inline Lanes roughInverse(const Lanes& a) { return inverse(a); }
inline Lanes inverseRoot(const Lanes& a) {
  return each([&](int i) { return 1.0f / std::sqrt(a.v[i]); });
}
inline Mask operator<(const Lanes& a, const Lanes& b) {
  return where([&](int i) { return a.v[i] < b.v[i]; });
}
inline Mask operator<=(const Lanes& a, const Lanes& b) {
  return where([&](int i) { return a.v[i] <= b.v[i]; });
}
inline Mask operator>(const Lanes& a, const Lanes& b) { return b < a; }
inline Mask operator>=(const Lanes& a, const Lanes& b) { return b <= a; }
inline Lanes select(Mask m, const Lanes& yes, const Lanes& no) {
  return each([&](int i) { return (m.v >> i & 1u) != 0 ? yes.v[i] : no.v[i]; });
}
inline Lanes selectNegative(const Lanes& a, const Lanes& yes, const Lanes& no) {
  return each([&](int i) { return std::signbit(a.v[i]) ? yes.v[i] : no.v[i]; });
}
inline Lanes following(const Lanes& a) {
  return each([&](int i) { return a.v[(i & 4) | ((i + 1) & 3)]; });
}
inline Lanes largestOfFour(const Lanes& a) {
  const float l = *std::max_element(a.v, a.v + 4), h = *std::max_element(a.v + 4, a.v + 8);
  return each([=](int i) { return i < 4 ? l : h; });
}
inline Lanes smallestOfFour(const Lanes& a) {
  const float l = *std::min_element(a.v, a.v + 4), h = *std::min_element(a.v + 4, a.v + 8);
  return each([=](int i) { return i < 4 ? l : h; });
}
inline float lowHalf(const Lanes& a) { return a.v[0]; }
inline float highHalf(const Lanes& a) { return a.v[4]; }
inline std::uint32_t allIn(const Lanes& low, const Lanes& high, std::uint64_t full) {
  return where([&](int i) {
           const int last = std::clamp(static_cast<int>(high.v[i]), 0, 63);
           const int first = std::clamp(static_cast<int>(low.v[i]), 0, last);
           return ((~std::uint64_t{0} >> (63 - (last - first)) << first) & ~full) == 0;
         })
      .v;
}
inline Lanes replaced(const Lanes& a, int i, int by, float x, float fill) {
  return each([&](int k) {
    if (k == i) return x;
    const int from = k > i ? k - by : k;
    return from > 7 ? fill : a.v[from];
  });
}

}  // namespace umbrage::study::detail::plain

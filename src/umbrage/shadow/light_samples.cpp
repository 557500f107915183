#include "umbrage/shadow/light_samples.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <variant>

#include "umbrage/shadow/ball_points.hpp"

namespace umbrage::shadow {
namespace {

constexpr double kPi = std::numbers::pi;

double vanDerCorput(std::uint32_t i) {
  std::uint32_t bits = 0;
  for (std::uint32_t place = 1u << 31; i != 0; i >>= 1, place >>= 1)
    if ((i & 1u) != 0) bits |= place;
  return double(bits) * 0x1p-32;
}

double sobol(std::uint32_t i) {
  std::uint32_t bits = 0;
  for (std::uint32_t direction = 1u << 31; i != 0; i >>= 1, direction ^= direction >> 1)
    if ((i & 1u) != 0) bits ^= direction;
  return double(bits) * 0x1p-32;
}

// Sobol's third coordinate, of the polynomial x^2 + x + 1: each direction number comes of the two before it.
double sobolThird(std::uint32_t i) {
  std::uint32_t bits = 0, before = 1u << 31, direction = 3u << 30;
  for (std::uint32_t now = before; i != 0; i >>= 1) {
    if ((i & 1u) != 0) bits ^= now;
    now = direction;
    direction = direction ^ before ^ before >> 2;
    before = now;
  }
  return double(bits) * 0x1p-32;
}

// In the middle of their cells of 2^-16, so that none lies on the border.
Vec2 squareSample(std::size_t i) {
  const auto k = static_cast<std::uint32_t>(i);
  return Vec2(vanDerCorput(k), sobol(k)) + 0x1p-17;
}

// Area to area: the square's rings become the disc's.
Vec2 discSample(std::size_t i) {
  const Vec2 p = 2.0 * squareSample(i) - 1.0;
  if (p == Vec2(0.0)) return p;
  const bool wide = std::abs(p.x) > std::abs(p.y);
  const double radius = wide ? p.x : p.y;
  const double angle = wide ? kPi / 4 * (p.y / p.x) : kPi / 2 - kPi / 4 * (p.x / p.y);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// Two unit vectors across a third.
struct Across {
  Vec3 u, v;
  explicit Across(const Vec3& axis) {
    const Vec3 size = glm::abs(axis);
    const Vec3 other = size.x <= size.y && size.x <= size.z ? Vec3(1, 0, 0)
                       : size.y <= size.z                   ? Vec3(0, 1, 0)
                                                            : Vec3(0, 0, 1);
    u = glm::normalize(glm::cross(axis, other));
    v = glm::cross(axis, u);
  }
};

bool liesBefore(const Box3& room, const Vec3& position, const Vec3& direction) {
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 at((corner & 1) != 0 ? room.max.x : room.min.x, (corner & 2) != 0 ? room.max.y : room.min.y,
                  (corner & 4) != 0 ? room.max.z : room.min.z);
    if (!(glm::dot(at - position, direction) > 0.0)) return false;
  }
  return !room.empty();
}

decltype(scene::Light::shape) oneSided(const Vec3& position, const Vec3& direction, const Box3& room) {
  if (liesBefore(room, position, direction)) return scene::PointLight{position};
  return scene::SpotLight{position, direction, Angle::degrees(90)};
}

/// Makes the i-th sample of a light's shape.
struct Maker {
  std::size_t i;
  const Box3& room;
  LightSample& out;

  void operator()(const scene::PointLight&) const {}
  void operator()(const scene::DirectionalLight&) const {}
  void operator()(const scene::SpotLight&) const {}
  void operator()(const scene::DiscLight& l) const {
    const Across across(glm::normalize(l.direction));
    const Vec2 p = l.radius * discSample(i);
    out.light.shape = oneSided(l.centre + p.x * across.u + p.y * across.v, l.direction, room);
  }
  void operator()(const scene::RectangleLight& l) const {
    const Vec2 p = 2.0 * squareSample(i) - 1.0;
    out.light.shape = oneSided(l.centre + p.x * l.u + p.y * l.v, glm::cross(l.u, l.v), room);
  }
  void operator()(const scene::SphereLight& l) const {
    out.ball = l;
    if (i < kBallPoints) {
      out.light.shape = scene::PointLight{l.centre + l.radius * ballPoint(i)};
      return;
    }
    // Along each way through the ball the points lie as those of a pendulum.
    const Vec3 view = room.empty() ? Vec3(0.0) : room.centre() - l.centre;
    const Vec3 axis = glm::dot(view, view) > 0.0 ? glm::normalize(view) : Vec3(0, 0, 1);
    const Across across(axis);
    const Vec2 p = discSample(i);
    const double half = std::sqrt(std::max(0.0, 1.0 - glm::dot(p, p)));
    const double along = half * std::cos(kPi * (sobolThird(static_cast<std::uint32_t>(i)) + 0x1p-17));
    out.light.shape = scene::PointLight{l.centre + l.radius * (p.x * across.u + p.y * across.v + along * axis)};
  }
  void operator()(const scene::SunLight& l) const {
    const Vec3 axis = glm::normalize(l.direction);
    const Across across(axis);
    // A cap of the sphere, area to area: heights are even.
    const Vec2 p = discSample(i);
    const double part = glm::dot(p, p), height = 1.0 - part * (1.0 - cos(l.radius));
    const double turn = part > 0.0 ? std::sqrt(std::max(0.0, 1.0 - height * height) / part) : 0.0;
    out.light.shape = scene::DirectionalLight{height * axis + turn * (p.x * across.u + p.y * across.v)};
  }
};

}  // namespace

double LightSample::weight(const Vec3& point) const {
  if (!ball) return 1.0;
  const Vec3 toCentre = ball->centre - point, toSample = std::get<scene::PointLight>(light.shape).position - point;
  const double square = glm::dot(toCentre, toCentre), along = glm::dot(toCentre, toSample);
  const double passing = square - along * along / glm::dot(toSample, toSample);
  // Upon the ball single points would outweigh all others, and inside there is no disc.
  constexpr double kMost = 4.0;
  const double radius = ball->radius;
  if (square <= radius * radius) return 1.0;
  return std::min(kMost,
                  square / (square + radius * radius / 2 - 1.5 * std::min(std::max(0.0, passing), radius * radius)));
}

std::vector<LightSample> lightSamples(const scene::Light& light, std::size_t first, std::size_t count,
                                      const Box3& room) {
  std::vector<LightSample> samples;
  if (!scene::isArea(light)) count = first == 0 && count > 0 ? 1 : 0;
  for (std::size_t i = first; i < first + count; ++i) {
    samples.push_back({light});
    std::visit(Maker{i, room, samples.back()}, light.shape);
  }
  return samples;
}

}  // namespace umbrage::shadow

// Tanks, spheres, silos, chimneys and the cooling tower: bodies of revolution and what hangs on them.
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "umbrage/samples/detail/industrial.hpp"
#include "umbrage/samples/detail/shapes.hpp"

namespace umbrage::samples::detail::plant {
namespace {

constexpr double kTankRadius = 7.0, kTankHeight = 12.0;

Vec3 around(double radius, double turn, double z) {
  const double angle = 2.0 * std::numbers::pi * turn;
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

std::vector<Vec3> circle(double radius, double z, int sides, const Vec3& centre = Vec3(0.0)) {
  std::vector<Vec3> points;
  for (int i = 0; i < sides; ++i) points.push_back(centre + around(radius, static_cast<double>(i) / sides, z));
  return points;
}

Outline halfCircle(double radius, double height, int steps) {
  Outline profile{{0.0, height - radius}};
  for (int i = 1; i < steps; ++i) {
    const double angle = std::numbers::pi * (static_cast<double>(i) / steps - 0.5);
    profile.emplace_back(radius * std::cos(angle), height + radius * std::sin(angle));
  }
  profile.emplace_back(0.0, height + radius);
  return profile;
}

}  // namespace

Part tank(const Colours& colour) {
  Part part("Tank", colour.white);
  const std::array<std::uint32_t, 7> bands{colour.concrete, colour.concrete, colour.concrete, colour.white,
                                           colour.blue,     colour.white,    colour.white};
  addRevolved(part, {0, 0, 0},
              {{0, 0},
               {7.5, 0},
               {7.5, 0.375},
               {kTankRadius, 0.375},
               {kTankRadius, 9.0},
               {kTankRadius, 10.5},
               {kTankRadius, kTankHeight},
               {0, 13.75}},
              40, Ends::closed, bands);
  part.use(colour.steel);
  addSweep(part, circle(kTankRadius + 0.0625, kTankHeight - 0.125, 40), rectangle(0.25, 0.25), Ends::joined);
  addSweep(part, circle(kTankRadius - 0.25, kTankHeight + 1.125, 20), rectangle(0.0625, 0.0625), Ends::joined);
  for (const Vec3& foot : circle(kTankRadius - 0.25, kTankHeight - 0.125, 20))
    addBeam(part, foot, foot + Vec3(0, 0, 1.3125), 0.0938);
  addRevolved(part, {2.5, 0, kTankHeight + 0.75}, {{0, 0}, {0.375, 0}, {0.375, 1.0}, {0.5, 1.125}, {0, 1.375}}, 12);
  return part;
}

Part tankStair(const Colours& colour) {
  Part part("Stair", colour.steel);
  const int steps = 44;
  std::vector<Vec3> stringer, rail;
  for (int i = 0; i <= steps; ++i) {
    const double turn = 0.55 * i / steps, z = 0.375 + (kTankHeight - 0.375) * i / steps;
    stringer.push_back(around(8.0, turn, z));
    rail.push_back(around(8.0, turn, z + 1.0));
    if (i == 0) continue;
    addBeam(part, around(6.875, turn, z), around(8.0, turn, z), 0.3125, 0.0625);
    if (i % 4 == 0) addBeam(part, around(8.0, turn, z), around(8.0, turn, z + 1.0), 0.0625);
  }
  addSweep(part, stringer, rectangle(0.0938, 0.25));
  addSweep(part, rail, rectangle(0.0781, 0.0781));
  return part;
}

Part bund(const Colours& colour, const Vec2& min, const Vec2& max) {
  Part part("Bund", colour.concrete);
  const std::array<Vec3, 4> path{Vec3(min, 0.625), {max.x, min.y, 0.625}, Vec3(max, 0.625), {min.x, max.y, 0.625}};
  addSweep(part, path, rectangle(0.375, 1.25), Ends::joined);
  return part;
}

Part gasSphere(const Colours& colour) {
  Part part("Sphere", colour.white);
  const double radius = 7.5, middle = 10.5;
  addRevolved(part, {0, 0, 0}, halfCircle(radius, middle, 16), 28);
  part.use(colour.steel);
  const auto feet = circle(radius - 0.125, 0.0, 8);
  for (std::size_t i = 0; i < feet.size(); ++i) {
    const Vec3 &a = feet[i], &b = feet[(i + 1) % feet.size()];
    addRevolved(part, a, {{0, 0}, {0.375, 0}, {0.375, 10.5}, {0, 10.5}}, 12);
    const Vec3 out = 0.125 * glm::normalize(a + b);
    addBeam(part, a + Vec3(0, 0, 1.0) + out, b + Vec3(0, 0, 8.0) + out, 0.1563);
    addBeam(part, b + Vec3(0, 0, 1.0) - out, a + Vec3(0, 0, 8.0) - out, 0.1563);
  }
  addSweep(part, circle(1.75, middle + radius + 0.875, 12), rectangle(0.0625, 0.0625), Ends::joined);
  for (const Vec3& foot : circle(1.75, middle + radius - 0.375, 12))
    addBeam(part, foot, foot + Vec3(0, 0, 1.25), 0.0625);
  addRevolved(part, {0, 0, 0}, {{0, 0}, {0.25, 0}, {0.25, middle - 7.0}, {0, middle - 7.0}}, 10);
  return part;
}

Part silo(const Colours& colour) {
  Part part("Silo", colour.silo);
  addRevolved(part, {0, 0, 0}, {{0, 3.0}, {0.5, 3.0}, {3.5, 7.0}, {3.5, 22.0}, {1.0, 23.5}, {1.0, 24.0}, {0, 24.0}},
              32);
  part.use(colour.steel);
  for (const double z : {8.0, 12.5, 17.0, 21.5})
    addSweep(part, circle(3.5625, z, 32), rectangle(0.1875, 0.25), Ends::joined);
  for (const Vec3& foot : circle(3.25, 0.0, 8)) addBeam(part, foot, foot + Vec3(0, 0, 7.25), 0.375);
  part.use(colour.concrete);
  addBox(part, {-3.875, -3.875, 0}, {3.875, 3.875, 0.25});
  return part;
}

Part chimney(const Colours& colour, const std::string& name, const Vec3& at, double height, double radius) {
  Part part(name, colour.brick);
  Outline profile{{0.0, 0.0}, {radius + 1.0, 0.0}, {radius + 1.0, 3.0}};
  std::vector<std::uint32_t> bands{colour.concrete, colour.concrete, colour.concrete};
  for (int i = 0; i <= 8; ++i) {
    profile.emplace_back(radius * (1.0 - 0.04 * i), 3.0 + (height - 3.0) * i / 8);
    bands.push_back(i < 5 ? colour.brick : (i % 2 == 1 ? colour.white : colour.red));
  }
  bands.resize(profile.size() - 1);
  const double mouth = 0.68 * radius - 0.375;
  profile.emplace_back(mouth, height);
  profile.emplace_back(mouth, height - 6.0);
  profile.emplace_back(0.0, height - 6.0);
  bands.insert(bands.end(), {colour.concrete, colour.concrete, colour.concrete});
  addRevolved(part, at, profile, 24, Ends::closed, bands);
  part.use(colour.steel);
  for (const double level : {0.6, 0.92}) {
    const double z = level * height, r = radius * (1.0 - 0.32 * level) + 0.5;
    addSweep(part, circle(r, z, 24, at), rectangle(1.25, 0.125), Ends::joined);
    addSweep(part, circle(r + 0.5, z + 1.125, 24, at), rectangle(0.0625, 0.0625), Ends::joined);
    for (const Vec3& foot : circle(r + 0.5, z, 24, at)) addBeam(part, foot, foot + Vec3(0, 0, 1.125), 0.0781);
  }
  return part;
}

/// A shell of zero thickness: an open caster.
Part coolingShell(const Colours& colour, const Vec3& at) {
  Part part("Shell", colour.concrete);
  Outline profile;
  for (int i = 0; i <= 14; ++i) {
    const double z = 4.0 + 34.0 * i / 14, fromWaist = (z - 29.0) / 22.0;
    profile.emplace_back(9.5 * std::sqrt(1.0 + fromWaist * fromWaist), z);
  }
  addRevolved(part, at, profile, 48, Ends::open);
  return part;
}

Part coolingBase(const Colours& colour, const Vec3& at) {
  Part part("Base", colour.concrete);
  const double low = 15.0, high = 9.5 * std::sqrt(1.0 + 25.0 * 25.0 / (22.0 * 22.0));
  const auto feet = circle(low, 0.25, 24, at), heads = circle(high, 4.25, 24, at);
  for (std::size_t i = 0; i < feet.size(); ++i) {
    addBeam(part, feet[i], heads[(i + 1) % heads.size()], 0.4375);
    addBeam(part, feet[(i + 1) % feet.size()], heads[i], 0.375);
  }
  addSweep(part, circle(high, 4.125, 48, at), rectangle(0.625, 0.75), Ends::joined);
  addRevolved(part, at, {{0, 0}, {16.0, 0}, {16.0, 0.5}, {0, 0.5}}, 48);
  return part;
}

/// Stacked without gaps, so that neighbours share edges: a caster that is not a manifold.
Part containers(const Colours& colour) {
  Part part("Containers", colour.blue);
  const std::array<std::uint32_t, 4> paints{colour.blue, colour.red, colour.green, colour.yellow};
  const std::array<int, 5> stacked{2, 3, 1, 3, 2};
  for (std::size_t row = 0; row < stacked.size(); ++row)
    for (int level = 0; level < stacked[row]; ++level) {
      const Vec3 min{-10.0, -52.0 + 2.5 * static_cast<double>(row), 2.625 * level};
      part.use(paints[(3 * row + static_cast<std::size_t>(level)) % paints.size()]);
      addBox(part, min - Vec3(12.0, 0, 0), min + Vec3(0.0, 2.5, 2.625));
    }
  return part;
}

}  // namespace umbrage::samples::detail::plant

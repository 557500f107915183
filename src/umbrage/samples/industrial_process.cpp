// The pipe rack along the site's main road, and the process structure: a steel frame full of vessels.
#include <array>
#include <numbers>
#include <vector>

#include "umbrage/samples/detail/industrial.hpp"
#include "umbrage/samples/detail/shapes.hpp"

namespace umbrage::samples::detail::plant {
namespace {

constexpr double kRackWest = -84.0, kRackEast = -6.0, kRackHalf = 3.0;
constexpr std::array<double, 3> kRackLevels{5.0, 6.75, 8.5};

// The process frame: three bays by two, four storeys.
constexpr std::array<double, 4> kFrameX{-18.0, -12.0, -6.0, 0.0};
constexpr std::array<double, 3> kFrameY{-20.0, -13.0, -6.0};
constexpr std::array<double, 4> kFrameZ{5.0, 9.0, 13.0, 17.0};

}  // namespace

Part rackFrames(const Colours& colour) {
  Part part("Frames", colour.steel);
  for (const double y : {26.5 - kRackHalf, 26.5 + kRackHalf})
    addBeam(part, {kRackWest, y, 7.625}, {kRackEast, y, 7.625}, 0.25);
  int number = 0;
  for (double x = kRackWest; x <= kRackEast; x += 6.0, ++number) {
    for (const double y : {26.5 - kRackHalf, 26.5 + kRackHalf}) {
      addBox(part, {x - 0.1875, y - 0.1875, 0.0}, {x + 0.1875, y + 0.1875, 9.0});
      if (number % 4 == 0 && x + 6.0 <= kRackEast) {
        addBeam(part, {x, y - 0.0938, 0.5}, {x + 6.0, y - 0.0938, 7.5}, 0.1563);
        addBeam(part, {x + 6.0, y + 0.0938, 0.5}, {x, y + 0.0938, 7.5}, 0.1563);
      }
    }
    for (const double z : kRackLevels)
      addBeam(part, {x, 26.5 - kRackHalf - 0.5, z}, {x, 26.5 + kRackHalf + 0.5, z}, 0.25, 0.3125);
  }
  part.use(colour.concrete);
  for (double x = kRackWest; x <= kRackEast; x += 6.0)
    for (const double y : {26.5 - kRackHalf, 26.5 + kRackHalf})
      addBox(part, {x - 0.4375, y - 0.4375, 0.0}, {x + 0.4375, y + 0.4375, 0.375});
  return part;
}

Part rackPipes(const Colours& colour) {
  Part part("Pipes", colour.silver);
  const std::array<std::uint32_t, 4> paints{colour.silver, colour.yellow, colour.silver, colour.green};
  std::size_t number = 0;
  for (const double level : kRackLevels)
    for (double y = -2.5; y < 2.75; y += 1.0, ++number) {
      const double radius = 0.125 + 0.0625 * static_cast<double>((5 * number) % 4), z = level + 0.1563 + radius,
                   line = 26.5 + y;
      part.use(paints[number % 4]);
      std::vector<Vec3> path{{kRackWest - 2.0 - 0.5 * static_cast<double>(number % 3), line, z}};
      if (level == kRackLevels.back() && number % 2 == 0) {
        // An expansion loop takes up the pipe's lengthening in the heat.
        const double x = -40.0 + 9.0 * y;
        for (const Vec3& p :
             {Vec3(x, line, z), Vec3(x, line, z + 2.5), Vec3(x + 4.0, line, z + 2.5), Vec3(x + 4.0, line, z)})
          path.push_back(p);
      }
      path.emplace_back(kRackEast + 1.0 + 0.5 * static_cast<double>(number % 3), line, z);
      if (level == kRackLevels.front()) {
        const Vec3 end = path.back();
        path.emplace_back(end.x, end.y, 0.25 + radius);
      }
      addSweep(part, path, regular(12, radius));
      for (double x = kRackWest + 9.0; x < kRackEast; x += 24.0)
        addSweep(part, std::array{Vec3(x + y, line, z), Vec3(x + y + 0.125, line, z)}, regular(12, radius + 0.0938));
    }
  // Risers that leave the rack for the process frame, the spheres and the tanks.
  for (int i = 0; i < 6; ++i) {
    part.use(paints[static_cast<std::size_t>(i) % 4]);
    const double x = -22.0 + 2.5 * i, z = 10.25 + 0.5 * (i % 2);
    addSweep(part,
             std::array{Vec3(x, 25.0, 6.0), Vec3(x, 25.0, z), Vec3(x, -7.5 - 2.0 * i, z), Vec3(x, -7.5 - 2.0 * i, 3.0)},
             regular(12, 0.1563));
  }
  for (const double x : {-76.0, -54.0}) {
    addSweep(part, std::array{Vec3(x, 28.0, 7.0), Vec3(x, 28.0, 1.0), Vec3(x, 42.0, 1.0)}, regular(12, 0.25));
  }
  for (const double x : {-78.0, -58.0, -38.0})
    addSweep(part, std::array{Vec3(x, 24.5, 7.0), Vec3(x, 24.5, 1.75), Vec3(x, 14.0, 1.75)}, regular(12, 0.25));
  return part;
}

Part processFrame(const Colours& colour) {
  Part part("Frame", colour.steel);
  for (const double x : kFrameX)
    for (const double y : kFrameY) {
      part.use(colour.steel);
      addBox(part, {x - 0.25, y - 0.25, 0.0}, {x + 0.25, y + 0.25, kFrameZ.back() + 1.0});
      part.use(colour.concrete);
      addBox(part, {x - 0.625, y - 0.625, 0.0}, {x + 0.625, y + 0.625, 0.5});
    }
  for (const double z : kFrameZ) {
    part.use(colour.steel);
    for (const double y : kFrameY) addBeam(part, {kFrameX.front(), y, z}, {kFrameX.back(), y, z}, 0.3125, 0.375);
    for (const double x : kFrameX)
      addBeam(part, {x, kFrameY.front(), z - 0.0625}, {x, kFrameY.back(), z - 0.0625}, 0.25, 0.3125);
    part.use(colour.concrete);
    addBox(part, {-18.5, -13.5, z + 0.125}, {-6.5, -5.5, z + 0.25});
    part.use(colour.yellow);
    for (const double y : {-13.4375, -5.5625}) {
      addBeam(part, {-18.4375, y, z + 1.25}, {-6.5625, y, z + 1.25}, 0.0781);
      for (double x = -18.375; x < -6.5; x += 2.0) addBeam(part, {x, y, z + 0.1875}, {x, y, z + 1.25}, 0.0625);
    }
  }
  part.use(colour.steel);
  for (const double y : {kFrameY.front(), kFrameY.back()})
    for (std::size_t level = 0; level < kFrameZ.size(); ++level) {
      const double low = level == 0 ? 0.5 : kFrameZ[level - 1];
      addBeam(part, {kFrameX[1], y + 0.125, low}, {kFrameX[2], y + 0.125, kFrameZ[level]}, 0.1875);
      addBeam(part, {kFrameX[2], y - 0.125, low}, {kFrameX[1], y - 0.125, kFrameZ[level]}, 0.1875);
    }
  return part;
}

Part processVessels(const Colours& colour) {
  Part part("Vessels", colour.silver);
  const auto column = [&](const Vec3& at, double radius, double height, std::uint32_t paint) {
    part.use(paint);
    addRevolved(part, at,
                {{0, 0},
                 {0.75 * radius, 0},
                 {0.75 * radius, 1.5},
                 {radius, 2.25},
                 {radius, height - radius},
                 {0.8 * radius, height - 0.4 * radius},
                 {0.45 * radius, height - 0.1 * radius},
                 {0, height}},
                24);
    part.use(colour.steel);
    for (double z = 6.0; z < height - 2.0; z += 6.0)
      addRevolved(part, at,
                  {{radius - 0.25, z}, {radius + 0.75, z}, {radius + 0.75, z + 0.125}, {radius - 0.25, z + 0.125}}, 24,
                  Ends::joined);
  };
  column({-3.0, -16.5, 0.0}, 1.5, 27.0, colour.silver);
  column({-9.0, -16.5, 0.0}, 1.25, 22.0, colour.white);
  column({-15.0, -16.5, 0.0}, 1.0, 24.0, colour.silver);
  column({8.0, -12.0, 0.0}, 2.0, 34.0, colour.white);
  // Lying drums on the decks: a section swept along with tapering ends.
  for (const double z : {5.25, 9.25, 13.25})
    for (const double y : {-11.0, -8.0}) {
      part.use(y < -10.0 ? colour.green : colour.white);
      std::vector<Ring> rings;
      for (const Vec2& p : {Vec2(-17.5, 0.0), Vec2(-17.25, 0.5), Vec2(-16.75, 0.8125), Vec2(-16.0, 0.9375),
                            Vec2(-9.0, 0.9375), Vec2(-8.25, 0.8125), Vec2(-7.75, 0.5), Vec2(-7.5, 0.0)}) {
        Ring ring;
        if (p.y == 0.0)
          ring.emplace_back(p.x, y, z + 1.25);
        else
          for (const Vec2& q : regular(20, p.y)) ring.emplace_back(p.x, y + q.x, z + 1.25 + q.y);
        rings.push_back(ring);
      }
      addLoft(part, rings);
      part.use(colour.concrete);
      for (const double x : {-15.0, -10.0})
        addBox(part, {x - 0.25, y - 0.75, z - 0.0625}, {x + 0.25, y + 0.75, z + 0.75});
    }
  return part;
}

Part processStairs(const Colours& colour) {
  Part part("Stairs", colour.yellow);
  double low = 0.0;
  for (std::size_t level = 0; level < kFrameZ.size(); ++level) {
    const double high = kFrameZ[level] + 0.1875, sense = level % 2 == 0 ? 1.0 : -1.0, start = -9.5 - sense * 2.75;
    const double lane = level % 2 == 0 ? -19.75 : -21.0;
    const int steps = 20;
    for (int i = 1; i < steps; ++i) {
      const double y = start + sense * 5.5 * i / steps, z = low + (high - low) * i / steps;
      addBox(part, {lane - 0.5, y - 0.125, z - 0.03125}, {lane + 0.5, y + 0.125, z + 0.03125});
    }
    for (const double x : {lane - 0.5, lane + 0.5}) {
      addBeam(part, {x, start, low + 0.1875}, {x, start + sense * 5.5, high}, 0.0781, 0.25);
      addBeam(part, {x, start, low + 1.0}, {x, start + sense * 5.5, high + 1.0}, 0.0625);
      addBeam(part, {x, start + sense * 0.1, low + 0.0625}, {x, start + sense * 0.1, low + 1.0}, 0.0938);
    }
    addBox(part, {-21.625, start + sense * 6.125 - 0.75, high - 0.0469},
           {-18.375, start + sense * 6.125 + 0.75, high + 0.0469});
    low = high;
  }
  for (const double y : {-13.25, -5.75}) addBox(part, {-21.6875, y - 0.1094, 0.0}, {-21.4688, y + 0.1094, 17.25});
  return part;
}

}  // namespace umbrage::samples::detail::plant

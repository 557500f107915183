// A lattice tower after the great iron towers of the 1880s: four curved legs that lean together, three platforms, a shaft and a mast.
// Thousands of thin struts, each a closed body of its own; where they meet they run into each other, as bolted bars do.
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "umbrage/samples/detail/scenes.hpp"
#include "umbrage/samples/detail/shapes.hpp"

namespace umbrage::samples::detail {
namespace {

constexpr double kFirst = 57.0, kSecond = 115.0, kThird = 276.0;
/// Half the width over the height, outside and inside of the legs.
constexpr std::array<Vec2, 7> kOuter{
    {{0, 62.0}, {28, 46.5}, {57, 34.5}, {86, 25.75}, {115, 19.0}, {190, 9.0}, {276, 4.5}}};
constexpr std::array<Vec2, 5> kInner{{{0, 37.0}, {28, 26.0}, {57, 18.0}, {86, 12.0}, {115, 8.0}}};

double outer(double z) { return interpolate(kOuter, z); }
double inner(double z) { return interpolate(kInner, z); }

struct Palette {
  std::uint32_t iron, light, deck, stone, glass;
};

/// Heights of the panels between two heights: as high as the lattice is wide there, times `shape`.
std::vector<double> panels(double from, double to, int count, double shrink) {
  std::vector<double> heights{from};
  double total = 0.0, height = 1.0;
  for (int i = 0; i < count; ++i, height *= shrink) total += height;
  double z = from;
  height = (to - from) / total;
  for (int i = 0; i < count; ++i, height *= shrink) heights.push_back(z += height);
  heights.back() = to;
  return heights;
}

using Edge = std::vector<Vec3>;  // a chord, one point per panel height

/// Per panel between two chords two crossing diagonals, which pass each other by their thickness.
void cross(Part& part, const Edge& a, const Edge& b, const Vec3& outwards, double size) {
  const Vec3 shift = outwards * (0.55 * size);
  for (std::size_t i = 0; i + 1 < a.size(); ++i) {
    addBeam(part, a[i] + shift, b[i + 1] + shift, size);
    addBeam(part, b[i] - shift, a[i + 1] - shift, size);
  }
}

/// The middle line between two chords, where wide faces carry twice the lattice.
Edge between(const Edge& a, const Edge& b) {
  Edge middle;
  for (std::size_t i = 0; i < a.size(); ++i) middle.push_back(0.5 * (a[i] + b[i]));
  return middle;
}

/// One face of the lattice: a middle chord, horizontals from chord to chord, crosses in both halves. `lift` keeps the horizontals of
/// neighbouring faces out of each other's planes.
void brace(Part& part, const Edge& a, const Edge& b, const Vec3& outwards, double size, double lift) {
  const Edge middle = between(a, b);
  addSweep(part, middle, rectangle(1.4 * size, 1.4 * size));
  cross(part, a, middle, outwards, size);
  cross(part, middle, b, -outwards, size);
  const Vec3 up{0, 0, lift};
  for (std::size_t i = 0; i + 1 < a.size(); ++i) addBeam(part, a[i] + up, b[i] + up, 1.25 * size, 1.5 * size);
}

/// One leg of square plan in the quadrant (sx, sy).
Part leg(const Palette& colour, const std::string& name, double sx, double sy) {
  Part part(name, colour.iron);
  std::vector<double> heights = panels(2.0, kFirst, 9, 0.96);
  const auto upper = panels(kFirst, kSecond, 11, 0.96);
  heights.insert(heights.end(), upper.begin() + 1, upper.end());
  std::array<Edge, 4> chords;
  for (const double z : heights) {
    const double o = outer(z), i = inner(z);
    chords[0].emplace_back(sx * o, sy * o, z);
    chords[1].emplace_back(sx * i, sy * o, z);
    chords[2].emplace_back(sx * i, sy * i, z);
    chords[3].emplace_back(sx * o, sy * i, z);
  }
  const std::array<Vec3, 4> normals{Vec3(0, sy, 0), Vec3(-sx, 0, 0), Vec3(0, -sy, 0), Vec3(sx, 0, 0)};
  for (const Edge& chord : chords) addSweep(part, chord, rectangle(0.9375, 0.9375));
  part.use(colour.light);
  for (std::size_t f = 0; f < 4; ++f)
    brace(part, chords[f], chords[(f + 1) % 4], normals[f], 0.3125, f % 2 == 0 ? 0.0 : 0.0469);
  return part;
}

/// Above the second platform the legs are one shaft.
Part shaft(const Palette& colour) {
  Part part("Shaft", colour.iron);
  const auto heights = panels(kSecond, kThird, 30, 0.955);
  std::array<Edge, 4> chords;
  for (const double z : heights) {
    const double o = outer(z);
    for (std::size_t c = 0; c < 4; ++c) chords[c].emplace_back(c == 0 || c == 3 ? o : -o, c < 2 ? o : -o, z);
  }
  const std::array<Vec3, 4> normals{Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0), Vec3(1, 0, 0)};
  for (const Edge& chord : chords) addSweep(part, chord, rectangle(0.8125, 0.8125));
  part.use(colour.light);
  for (std::size_t f = 0; f < 4; ++f)
    brace(part, chords[f], chords[(f + 1) % 4], normals[f], 0.25, f % 2 == 0 ? 0.0 : 0.0469);
  return part;
}

/// The lifts' guides inside the shaft.
Part guides(const Palette& colour) {
  Part part("Guides", colour.light);
  for (const double x : {-1.5, 1.5})
    for (const double y : {-1.5, 1.5}) addBeam(part, {x, y, kSecond - 4.0}, {x, y, kThird - 1.0}, 0.1875);
  for (double z = kSecond; z < kThird - 4.0; z += 5.0)
    for (const double s : {-1.5, 1.5}) {
      addBeam(part, {-1.5, s, z}, {1.5, s, z}, 0.125);
      addBeam(part, {s, -1.5, z + 0.25}, {s, 1.5, z + 0.25}, 0.125);
    }
  return part;
}

/// The ornamental arch between two legs on one side, in the inclined plane of the legs' outside.
void arch(Part& part, int turn) {
  const Mat4 frame = placed(Vec3(0.0), turn);
  const int steps = 28;
  Edge low, high, rail;
  for (int i = 0; i <= steps; ++i) {
    const double t = std::numbers::pi * i / steps;
    const auto at = [&](double radius, double rise) {
      const double z = 5.0 + rise * std::sin(t);
      return transformPoint(frame, Vec3(-radius * std::cos(t), -(outer(z) + 0.5), z));
    };
    low.push_back(at(37.0, 39.0));
    high.push_back(at(41.0, 43.5));
    rail.push_back(at(39.0, 41.25));
  }
  addSweep(part, low, rectangle(0.8125, 0.5625));
  addSweep(part, high, rectangle(0.8125, 0.5625));
  for (std::size_t i = 0; i + 1 < low.size(); ++i) {
    addBeam(part, low[i], high[i], 0.25);
    const Vec3 shift = transformVector(frame, Vec3(0, 0.1875, 0));
    addBeam(part, low[i] + shift, high[i + 1] + shift, 0.1875);
    addBeam(part, high[i] - shift, low[i + 1] - shift, 0.1875);
  }
}

Part arches(const Palette& colour) {
  Part part("Arches", colour.iron);
  for (int turn = 0; turn < 4; ++turn) arch(part, turn);
  return part;
}

std::array<Vec3, 4> square(double half, double z) {
  return {Vec3{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}};
}

/// A ring-shaped deck with a truss girder below its rim and a railing.
void platform(Part& part, const Palette& colour, double z, double half, double hole, double girder) {
  part.use(colour.deck);
  addSweep(part, square(0.5 * (half + hole), z), rectangle(half - hole, 0.5), Ends::joined);
  part.use(colour.iron);
  addSweep(part, square(half - 1.0, z - girder), rectangle(0.5, 0.5), Ends::joined);
  addSweep(part, square(half - 0.25, z + 1.25), rectangle(0.125, 0.125), Ends::joined);
  addSweep(part, square(half - 0.25, z + 0.75), rectangle(0.0625, 0.0625), Ends::joined);
  const int posts = static_cast<int>(std::lround(2.0 * half / 2.5));
  for (int turn = 0; turn < 4; ++turn) {
    const Mat4 frame = placed(Vec3(0.0), turn);
    const auto at = [&](double along, double out, double height) {
      return transformPoint(frame, Vec3(along, -out, height));
    };
    for (int i = 0; i < posts; ++i) {
      const double a = -half + 0.25 + (2.0 * half - 0.5) * i / posts,
                   b = -half + 0.25 + (2.0 * half - 0.5) * (i + 1) / posts;
      const double f = (half - 1.0) / (half - 0.25);
      part.use(colour.iron);
      addBeam(part, at(a, half - 0.25, z + 0.125), at(a, half - 0.25, z + 1.25), 0.0938);
      part.use(colour.light);
      const double low = z - girder, high = z - 0.125;
      addBeam(part, at(a * f, half - 0.875, low), at(b * f, half - 0.875, high), 0.1875);
      addBeam(part, at(b * f, half - 1.125, low), at(a * f, half - 1.125, high), 0.1875);
      if (i > 0) addBeam(part, at(a * f, half - 1.0, low), at(a * f, half - 1.0, high), 0.25);
    }
  }
}

Part platforms(const Palette& colour) {
  Part part("Decks", colour.deck);
  platform(part, colour, kFirst, outer(kFirst) + 2.0, 14.0, 4.0);
  platform(part, colour, kSecond, outer(kSecond) + 1.75, 6.0, 3.0);
  platform(part, colour, kThird, 8.0, 2.5, 2.5);
  return part;
}

/// Pavilions on the first platform; their glass is a single sheet.
Part pavilions(const Palette& colour) {
  Part part("Pavilions", colour.light);
  for (int turn = 0; turn < 4; ++turn) {
    const Mat4 frame = placed(Vec3(0.0), turn);
    const auto at = [&](double x, double y, double z) { return transformPoint(frame, Vec3(x, y, z)); };
    const Outline gable{{-3.0, 0.0}, {3.0, 0.0}, {3.5, 0.375}, {0.0, 2.0}, {-3.5, 0.375}};
    addPrism(part, gable, at(-13.0, -24.0, kFirst + 4.0), at(0, 1, 0), at(0, 0, 1), at(26.0, 0, 0));
    for (double x = -12.5; x < 13.0; x += 5.0)
      for (const double y : {-26.5, -21.5}) addBeam(part, at(x, y, kFirst), at(x, y, kFirst + 4.25), 0.375);
  }
  return part;
}

Part glass(const Palette& colour) {
  Part part("Glass", colour.glass);
  for (int turn = 0; turn < 4; ++turn) {
    const Mat4 frame = placed(Vec3(0.0), turn);
    const auto at = [&](double x, double y, double z) { return transformPoint(frame, Vec3(x, y, z)); };
    for (double x = -12.25; x < 12.0; x += 5.0)
      addSheet(part, at(x, -26.5, kFirst + 0.5), at(x + 4.5, -26.5, kFirst + 0.5), at(x + 4.5, -26.5, kFirst + 3.875),
               at(x, -26.5, kFirst + 3.875));
  }
  return part;
}

/// The lantern on the third platform and the mast.
Part top(const Palette& colour) {
  Part part("Lantern", colour.light);
  for (const Vec2& p : regular(8, 4.5)) addBeam(part, {p, kThird}, {0.85 * p, kThird + 6.25}, 0.3125);
  addRevolved(
      part, {0, 0, kThird + 6.0},
      {{0, 0}, {5.0, 0}, {5.0, 0.5}, {3.5, 2.75}, {1.75, 4.25}, {1.25, 4.5}, {1.25, 7.5}, {0.625, 8.5}, {0, 8.5}}, 16);
  part.use(colour.iron);
  addRevolved(part, {0, 0, kThird + 14.0}, {{0, 0}, {0.5, 0}, {0.3125, 4.0}, {0.1875, 10.0}, {0, 10.0}}, 8);
  for (const double z : {280.0, 284.0})
    for (const double s : {-1.0, 1.0})
      addBeam(part, {-1.5 * s, 0.0, z + 12.0 + s}, {1.5 * s, 0.25, z + 12.0 + s}, 0.125);
  return part;
}

Part bases(const Palette& colour) {
  Part part("Bases", colour.stone);
  const Outline foot{{0, 0.0}, {3.75, 0.0}, {3.0, 1.5}, {2.0, 1.75}, {2.0, 3.0}, {0, 3.0}};
  for (const double sx : {-1.0, 1.0})
    for (const double sy : {-1.0, 1.0})
      for (const double x : {inner(2.0), outer(2.0)})
        for (const double y : {inner(2.0), outer(2.0)}) addRevolved(part, {sx * x, sy * y, 0.0}, foot, 4);
  return part;
}

}  // namespace

scene::Scene tower() {
  SceneBuilder scene("tower");
  const Palette colour{scene.material("iron", 0x7d6248), scene.material("iron, light", 0x937655),
                       scene.material("deck", 0x8d8578), scene.material("stone", 0xc4b8a2),
                       scene.material("glass", 0xa9cbd9, 0.4)};
  scene.place("Tower/Legs", leg(colour, "North-east", 1, 1));
  scene.place("Tower/Legs", leg(colour, "North-west", -1, 1));
  scene.place("Tower/Legs", leg(colour, "South-west", -1, -1));
  scene.place("Tower/Legs", leg(colour, "South-east", 1, -1));
  scene.place("Tower", arches(colour));
  scene.place("Tower/Platforms", platforms(colour));
  scene.place("Tower/Platforms", pavilions(colour));
  scene.place("Tower/Platforms", glass(colour));
  scene.place("Tower", shaft(colour));
  scene.place("Tower", guides(colour));
  scene.place("Tower/Top", top(colour));
  scene.place("Tower", bases(colour));
  return std::move(scene).take();
}

}  // namespace umbrage::samples::detail

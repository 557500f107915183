// A perimeter block. The court is the point of it: 30 m square, walls of 20 m, nothing of the block hides more of the sky from the
// court's floor than those walls do, so its hours of sun have closed forms.
#include <array>
#include <cmath>
#include <string>

#include "umbrage/samples/detail/scenes.hpp"
#include "umbrage/samples/detail/shapes.hpp"

namespace umbrage::samples::detail {
namespace {

constexpr double kStreet = 30.0;  // half side of the block
constexpr double kCourt = 15.0;   // half side of the court
constexpr double kTop = 20.0;     // parapet
constexpr double kAttic = 19.25;  // roof terrace behind the parapet
constexpr double kNiche = 0.375;  // depth of windows, and thickness of the parapet
constexpr double kPitch = 3.75;   // window axes
constexpr double kHalfWindow = 0.625;
constexpr double kDoor = 3.5;  // height of the portals

struct Storey {
  double sill, lintel;
};
constexpr std::array<Storey, 5> kStoreys{{{1.25, 3.5}, {5.25, 7.25}, {9.0, 11.0}, {12.75, 14.75}, {16.25, 18.0}}};

struct Palette {
  std::uint32_t plaster, stone, tiles, wood, glass, iron, lawn, leaves, bark, awning, brick;
};

Palette palette(SceneBuilder& scene) {
  return {scene.material("plaster", 0xe9d9b8),     scene.material("stone", 0xb9b2a3),
          scene.material("tiles", 0xb5573a),       scene.material("wood", 0x7a5638),
          scene.material("glass", 0x9fc3d8, 0.35), scene.material("iron", 0x4c5a5e),
          scene.material("lawn", 0x8fae5d),        scene.material("leaves", 0x6d9648),
          scene.material("bark", 0x6b523c),        scene.material("awning", 0xd8604f, 0.8),
          scene.material("brick", 0xa3654c)};
}

bool between(double v, double low, double high) { return v > low && v < high; }

/// Along a facade: the distance of `s` from the nearest window axis.
bool inWindow(double s) {
  const double cell = s / kPitch - std::floor(s / kPitch);
  return std::abs(cell - 0.5) * kPitch < kHalfWindow;
}

bool inStorey(double z) {
  for (const Storey& storey : kStoreys)
    if (between(z, storey.sill, storey.lintel)) return true;
  return false;
}

/// Portals stand in the middle of the south side, to the street and to the court: deep niches with doors, no way through for light.
bool inPortal(double x, double y, double z) {
  const bool street = between(y, -kStreet, -kStreet + 2.0), court = between(y, -kCourt - 2.0, -kCourt);
  return z < kDoor && std::abs(x) < kPitch / 2 - kHalfWindow && (street || court);
}

/// Windows left and right of the portals would run into them.
bool besidePortal(double x, double y, double z) { return z < kDoor && std::abs(x) < kPitch && y < 0.0; }

bool inNiche(double along, double across, double z) {
  const double depth = std::abs(across);
  if (!inStorey(z) || !inWindow(along)) return false;
  const bool street = between(depth, kStreet - kNiche, kStreet) && std::abs(along) < kStreet - 1.0;
  const bool court = between(depth, kCourt, kCourt + kNiche) && std::abs(along) < kCourt - 1.0;
  return street || court;
}

bool isWall(double x, double y, double z) {
  const double reach = std::max(std::abs(x), std::abs(y));
  if (reach < kCourt) return false;
  if (z > kAttic) return reach < kCourt + kNiche || reach > kStreet - kNiche;
  if (inPortal(x, y, z)) return false;
  return !((inNiche(x, y, z) && !besidePortal(x, y, z)) || inNiche(y, x, z));
}

std::vector<double> planLines() {
  std::vector<double> lines;
  for (const double side : {-1.0, 1.0})
    for (const double at : {kStreet, kStreet - kNiche, kStreet - 2.0, kCourt, kCourt + kNiche, kCourt + 2.0})
      lines.push_back(side * at);
  for (double axis = -kStreet + kPitch / 2; axis < kStreet; axis += kPitch) {
    lines.push_back(axis - kHalfWindow);
    lines.push_back(axis + kHalfWindow);
  }
  return sortedLines(lines);
}

std::vector<double> heightLines() {
  std::vector<double> lines{0.0, 0.875, kDoor, kAttic, kTop};
  for (const Storey& storey : kStoreys) {
    lines.push_back(storey.sill);
    lines.push_back(storey.lintel);
  }
  return sortedLines(lines);
}

Part walls(const Palette& colour) {
  Part part("Walls", colour.plaster);
  const auto plan = planLines(), heights = heightLines();
  const auto at = [](const std::vector<double>& lines, int i) { return lines[static_cast<std::size_t>(i)]; };
  const auto middle = [&](const std::vector<double>& lines, int i) { return 0.5 * (at(lines, i) + at(lines, i + 1)); };
  const int n = static_cast<int>(plan.size()) - 1, levels = static_cast<int>(heights.size()) - 1;
  addCells(part, {n, n, levels,
                  [&](int i, int j, int k) -> std::optional<std::uint32_t> {
                    const double z = middle(heights, k);
                    if (!isWall(middle(plan, i), middle(plan, j), z)) return std::nullopt;
                    return z < 0.875 || z > kAttic ? colour.stone : colour.plaster;
                  },
                  [&](int i, int j, int k) { return Vec3(at(plan, i), at(plan, j), at(heights, k)); }});
  return part;
}

/// Calls `make(frame)` for the four sides; the frame turns (along, outwards, up) into world coordinates.
template <class Make>
void onFourSides(const Make& make) {
  for (int turn = 0; turn < 4; ++turn) {
    const Mat4 frame = placed(Vec3(0.0), turn);
    make([frame](double along, double out, double z) { return transformPoint(frame, Vec3(along, -out, z)); }, turn);
  }
}

Part panes(const Palette& colour) {
  Part part("Panes", colour.glass);
  const auto row = [&](const auto& at, int turn, double half, double depth, double sense) {
    for (double axis = -half + kPitch / 2; axis < half; axis += kPitch)
      for (const Storey& storey : kStoreys) {
        if (turn == 0 && storey.lintel <= kDoor && std::abs(axis) < kPitch) continue;
        const double l = axis - sense * kHalfWindow, r = axis + sense * kHalfWindow;
        addSheet(part, at(l, depth, storey.sill), at(r, depth, storey.sill), at(r, depth, storey.lintel),
                 at(l, depth, storey.lintel));
      }
  };
  onFourSides([&](const auto& at, int turn) {
    row(at, turn, kStreet, kStreet - 0.25, 1.0);
    row(at, turn, kCourt, kCourt + 0.25, -1.0);
  });
  return part;
}

/// Sills on the street side only: in the court nothing stands out of the walls.
Part sills(const Palette& colour) {
  Part part("Sills", colour.stone);
  onFourSides([&](const auto& at, int turn) {
    for (double axis = -kStreet + kPitch / 2; axis < kStreet; axis += kPitch)
      for (const Storey& storey : kStoreys) {
        if (turn == 0 && storey.lintel <= kDoor && std::abs(axis) < kPitch) continue;
        const double z = storey.sill - 0.0625;
        addBeam(part, at(axis - 0.75, kStreet, z), at(axis + 0.75, kStreet, z), 0.375, 0.1875);
      }
  });
  return part;
}

/// Clockwise, so that sections swept along it have their x outwards.
std::array<Vec3, 4> square(double half, double z) {
  return {Vec3{-half, -half, z}, {-half, half, z}, {half, half, z}, {half, -half, z}};
}

/// A band that runs around the street side.
Part cornice(const Palette& colour) {
  Part part("Cornice", colour.stone);
  const Outline moulding{{-0.25, -0.25}, {0.375, -0.25}, {0.625, 0.0}, {0.625, 0.25}, {-0.25, 0.25}};
  addSweep(part, square(kStreet, 18.875), moulding, Ends::joined);
  addSweep(part, square(kStreet, 4.375), rectangle(0.375, 0.25), Ends::joined);
  return part;
}

/// A tiled roof behind the parapets, hipped at the corners. Its inner slope stays below the line from the court's farthest corner over
/// the parapet (20 m / 42.43 m), as do dormers and chimneys.
Part tiles(const Palette& colour) {
  Part part("Tiles", colour.tiles);
  const Outline section{{-6.25, 0.0}, {6.25, 0.0}, {0.0, 3.5}};
  addSweep(part, square(22.5, 19.0), section, Ends::joined);
  return part;
}

Part dormers(const Palette& colour) {
  Part part("Dormers", colour.plaster);
  const Outline gable{{-0.875, 0.0}, {0.875, 0.0}, {0.875, 1.375}, {0.0, 2.125}, {-0.875, 1.375}};
  onFourSides([&](const auto& at, int) {
    for (double axis = -18.75; axis < 19.0; axis += 7.5) {
      const Vec3 origin = at(axis, 27.75, 19.5);
      addPrism(part, gable, origin + at(0.0, -5.0, 0.0), at(1.0, 0.0, 0.0), at(0.0, 0.0, 1.0), at(0.0, 5.0, 0.0));
    }
  });
  return part;
}

Part chimneys(const Palette& colour) {
  Part part("Chimneys", colour.brick);
  onFourSides([&](const auto& at, int) {
    for (const double axis : {-15.0, -7.5, 7.5, 15.0}) {
      part.use(colour.brick);
      addBeam(part, at(axis, 23.5, 20.5), at(axis, 23.5, 23.25), 1.5, 0.75);
      part.use(colour.stone);
      addBeam(part, at(axis, 23.5, 23.125), at(axis, 23.5, 23.375), 1.75, 1.0);
    }
  });
  return part;
}

Part doors(const Palette& colour) {
  Part part("Doors", colour.wood);
  for (const double y : {-kStreet + 1.5, -kCourt - 1.5})
    for (const double x : {-1.0, 0.0625}) addBox(part, {x, y - 0.0625, 0.0}, {x + 0.9375, y + 0.0625, kDoor - 0.25});
  return part;
}

Part tree(const Palette& colour) {
  Part part("Tree", colour.bark);
  addRevolved(part, {0, 0, 0}, {{0, 0}, {0.3125, 0}, {0.1875, 1.5}, {0.125, 3.25}, {0, 3.25}}, 8);
  part.use(colour.leaves);
  addBlob(part, {0, 0, 4.5}, {1.75, 1.75, 2.0}, 2, 0.09);
  addBlob(part, {0.75, 0.5, 3.625}, {1.125, 1.125, 1.0}, 2, 0.09);
  return part;
}

Part kioskFrame(const Palette& colour) {
  Part part("Columns", colour.iron);
  for (const Vec2& p : regular(8, 2.75))
    addRevolved(part, {p, 0.375}, {{0, 0}, {0.0938, 0}, {0.0938, 2.625}, {0, 2.625}}, 8);
  std::vector<Vec3> ring;
  for (const Vec2& p : regular(8, 2.75)) ring.emplace_back(p, 3.0);
  addSweep(part, ring, rectangle(0.25, 0.25), Ends::joined);
  part.use(colour.stone);
  addRevolved(part, {0, 0, 0}, {{0, 0.0}, {3.5, 0.0}, {3.5, 0.25}, {3.25, 0.25}, {3.25, 0.4375}, {0, 0.4375}}, 24);
  part.use(colour.wood);
  addRevolved(part, {0, 0, 0.375}, {{0, 0}, {1.25, 0}, {1.25, 1.0}, {1.5, 1.0}, {1.5, 1.125}, {0, 1.125}}, 12);
  return part;
}

/// The roof is a shell of zero thickness with a scalloped valance: an open caster.
Part kioskRoof(const Palette& colour) {
  Part part("Roof", colour.awning);
  addRevolved(part, {0, 0, 3.125}, {{3.5, -0.25}, {3.5, 0.0}, {1.5, 0.875}, {0.0, 1.75}}, 16, Ends::open);
  return part;
}

Part benches(const Palette& colour) {
  Part part("Benches", colour.wood);
  onFourSides([&](const auto& at, int) {
    for (const double along : {-4.5, 4.5}) {
      for (const double out : {9.0, 9.1875, 9.375})
        addBeam(part, at(along - 1.0, out, 0.4375), at(along + 1.0, out, 0.4375), 0.125, 0.0625);
      for (const double foot : {-0.75, 0.75})
        addBeam(part, at(along + foot, 8.9375, 0.2031), at(along + foot, 9.4375, 0.2031), 0.125, 0.40625);
    }
  });
  return part;
}

Part lawn(const Palette& colour) {
  Part part("Lawn", colour.stone);
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0}) {
      const Vec3 centre{x * 4.75, y * 4.75, 0.0};
      part.use(colour.stone);
      addBox(part, centre - Vec3(3.375, 3.375, 0), centre + Vec3(3.375, 3.375, 0.125));
      part.use(colour.lawn);
      addBox(part, centre + Vec3(-3.25, -3.25, 0.0625), centre + Vec3(3.25, 3.25, 0.1875));
    }
  return part;
}

}  // namespace

scene::Scene courtyard() {
  SceneBuilder scene("courtyard");
  const Palette colour = palette(scene);
  scene.place("Block", walls(colour));
  scene.place("Block/Windows", panes(colour));
  scene.place("Block/Windows", sills(colour));
  scene.place("Block", doors(colour));
  scene.place("Block", cornice(colour));
  scene.place("Block/Roofs", tiles(colour));
  scene.place("Block/Roofs", dormers(colour));
  scene.place("Block/Roofs", chimneys(colour));
  scene.place("Court", lawn(colour));
  scene.place("Court", benches(colour));
  scene.place("Court/Kiosk", kioskFrame(colour));
  scene.place("Court/Kiosk", kioskRoof(colour));
  const std::uint32_t trees = scene.share(tree(colour));
  int number = 0;
  for (const double x : {-6.5, 6.5})
    for (const double y : {-6.5, 6.5}) {
      const std::string name = "Court/Trees/Tree " + std::to_string(++number);
      scene.place(name, trees, placed({x, y, 0.125}, number, number % 2 == 0 ? 1.25 : 1.0));
    }
  return std::move(scene).take();
}

}  // namespace umbrage::samples::detail

// An office tower of 24 storeys on a podium: a curved plan, a concrete core with doors, slabs and columns, and in front of them a facade
// of mullions, transoms, fins and panes, each a part of its own, so that '*Facade*' and '*Concrete*' choose between them.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "umbrage/samples/detail/scenes.hpp"
#include "umbrage/samples/detail/shapes.hpp"

namespace umbrage::samples::detail {
namespace {

constexpr int kPanels = 132;  // facade axes around the plan
constexpr int kStoreys = 24;
constexpr double kStorey = 3.5, kGround = 6.0;
constexpr double kRoof = kGround + kStoreys * kStorey;
constexpr int kCoreCells = kPanels / 3;

struct Palette {
  std::uint32_t concrete, light, aluminium, bronze, glass, stone, dark, leaves, bark;
};

/// The plan is a drop, blunt to the west; it swells a little towards the middle of the tower.
Vec2 drop(double t) {
  const double x = std::cos(t), y = std::sin(t);
  return {21.0 * x + 2.5 * x * x - 1.25, y * (13.0 + 2.75 * x)};
}
double swell(double z) {
  const double rise = std::max(0.0, (z - kGround) / (kRoof - kGround));
  return 0.9 + 0.1 * std::sin(std::numbers::pi * (0.12 + 0.62 * rise));
}

/// Points of the plan at equal distances along its border, as unit swell; made once per call of building().
std::vector<Vec2> plan(int count) {
  constexpr int kFine = 4096;
  std::vector<double> length{0.0};
  for (int i = 1; i <= kFine; ++i) {
    const double a = 2.0 * std::numbers::pi * (i - 1) / kFine, b = 2.0 * std::numbers::pi * i / kFine;
    length.push_back(length.back() + glm::length(drop(b) - drop(a)));
  }
  std::vector<Vec2> points;
  std::size_t at = 0;
  for (int i = 0; i < count; ++i) {
    const double wanted = length.back() * i / count;
    while (length[at + 1] <= wanted) ++at;
    const double fraction = (wanted - length[at]) / (length[at + 1] - length[at]);
    points.push_back(drop(2.0 * std::numbers::pi * (static_cast<double>(at) + fraction) / kFine));
  }
  return points;
}

/// The facade's surface: axes around the plan, with their outward directions.
class Skin {
 public:
  explicit Skin(int count) : points_(plan(count)) {
    const std::size_t n = points_.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 along = points_[(i + 1) % n] - points_[(i + n - 1) % n];
      outwards_.push_back(glm::normalize(Vec2(along.y, -along.x)));
    }
  }
  /// `out` metres in front of the surface on axis i (which may run past the last one), at height z.
  [[nodiscard]] Vec3 at(int i, double out, double z) const {
    const std::size_t k = static_cast<std::size_t>(i) % points_.size();
    return {swell(z) * points_[k] + out * outwards_[k], z};
  }
  /// Between axis i and the next.
  [[nodiscard]] Vec3 between(int i, double fraction, double out, double z) const {
    return glm::mix(at(i, out, z), at(i + 1, out, z), fraction);
  }
  [[nodiscard]] std::vector<Vec3> ring(double out, double z) const {
    std::vector<Vec3> points;
    for (int i = 0; i < static_cast<int>(points_.size()); ++i) points.push_back(at(i, out, z));
    return points;
  }

 private:
  std::vector<Vec2> points_, outwards_;
};

double floorHeight(int storey) { return kGround + storey * kStorey; }

Part mullions(const Palette& colour, const Skin& skin) {
  Part part("Mullions", colour.aluminium);
  for (int i = 0; i < kPanels; ++i) {
    std::vector<Ring> rings;
    for (int s = 0; s <= kStoreys; ++s) {
      const double z = s == 0 ? kGround - 0.5 : floorHeight(s) + (s == kStoreys ? 1.25 : 0.0);
      const Vec3 back = skin.at(i, 0.0625, z), front = skin.at(i, 0.3125, z);
      const Vec3 half = 0.0469 * glm::normalize(glm::cross(Vec3(0, 0, 1), front - back));
      rings.push_back({back - half, front - half, front + half, back + half});
    }
    addLoft(part, rings);
  }
  return part;
}

/// Two bands a storey: at the slab and at the sill.
Part transoms(const Palette& colour, const Skin& skin) {
  Part part("Transoms", colour.aluminium);
  for (int s = 0; s < kStoreys; ++s) {
    addSweep(part, skin.ring(0.1875, floorHeight(s) - 0.125), rectangle(0.1875, 0.4375), Ends::joined);
    if (s > 0) addSweep(part, skin.ring(0.1563, floorHeight(s) + 0.9375), rectangle(0.125, 0.0938), Ends::joined);
  }
  addSweep(part, skin.ring(0.1875, kRoof + 1.1875), rectangle(0.4375, 0.25), Ends::joined);
  return part;
}

/// A sun-shading blade before every pane, deeper to the south and west.
Part fins(const Palette& colour, const Skin& skin) {
  Part part("Fins", colour.bronze);
  for (int s = 0; s < kStoreys; ++s)
    for (int i = 0; i < kPanels; ++i) {
      const double z = floorHeight(s) + 2.625;
      const Vec3 out = skin.at(i, 1.0, z) - skin.at(i, 0.0, z);
      const double depth = 0.5 + 0.25 * std::max(0.0, -0.4 * out.x - 0.9 * out.y);
      const Vec3 left = skin.between(i, 0.06, 0.25, z), right = skin.between(i, 0.94, 0.25, z);
      const Vec3 leftTip = skin.between(i, 0.06, 0.25 + depth, z - 0.125),
                 rightTip = skin.between(i, 0.94, 0.25 + depth, z - 0.125);
      const Vec3 thick{0, 0, 0.0469};
      const std::array<Ring, 2> rings{Ring{left + thick, leftTip + thick, leftTip, left},
                                      Ring{right + thick, rightTip + thick, rightTip, right}};
      addLoft(part, rings);
    }
  return part;
}

/// Single sheets, one per pane: from the sill band to the next slab, and the breast panel below.
Part panes(const Palette& colour, const Skin& skin) {
  Part part("Panes", colour.glass);
  for (int s = 0; s < kStoreys; ++s)
    for (int i = 0; i < kPanels; ++i) {
      const double z = floorHeight(s);
      addSheet(part, skin.at(i, 0.125, z), skin.at(i + 1, 0.125, z), skin.at(i + 1, 0.125, z + kStorey),
               skin.at(i, 0.125, z + kStorey));
    }
  return part;
}

/// The core: an oval ring wall with doors on every storey, and cross walls.
Part core(const Palette& colour, const Skin& skin) {
  Part part("Core", colour.concrete);
  const auto wall = [&](int i, double scale, double z) {
    const Vec3 p = skin.at(3 * i, 0.0, kGround);
    return Vec3(scale * p.x, scale * p.y, z);
  };
  const std::array<double, 2> scales{0.36, 0.33};
  std::vector<double> heights{0.0, 2.5};
  for (int s = 0; s <= kStoreys; ++s) {
    heights.push_back(floorHeight(s) + 0.0313);  // a threshold, above the slab
    heights.push_back(floorHeight(s) + 2.25);
  }
  heights.push_back(kRoof + 4.0);
  const auto isDoor = [](int i, int k) { return k % 2 == 0 && (i % 11 == 3 || i % 11 == 7); };
  addCells(part, {kCoreCells, 1, static_cast<int>(heights.size()) - 1,
                  [&](int i, int, int k) -> std::optional<std::uint32_t> {
                    if (isDoor(i, k)) return std::nullopt;
                    return colour.concrete;
                  },
                  [&](int i, int j, int k) {
                    return wall(i, scales[static_cast<std::size_t>(j)], heights[static_cast<std::size_t>(k)]);
                  },
                  true});
  addBox(part, {-6.0, -0.1563, 0.125}, {6.0, 0.1563, kRoof + 3.5});
  for (const double x : {-3.0, 3.0}) addBox(part, {x - 0.1406, -4.25, 0.0625}, {x + 0.1406, 4.25, kRoof + 3.25});
  return part;
}

/// Ring-shaped slabs between the core and the facade.
Part slabs(const Palette& colour, const Skin& skin) {
  Part part("Slabs", colour.light);
  for (int s = 0; s <= kStoreys; ++s) {
    const double top = floorHeight(s), bottom = top - 0.3125;
    std::vector<Ring> rings;
    for (int i = 0; i < kPanels; i += 2) {
      const Vec3 rim = skin.at(i, -0.25, top), p = skin.at(i, 0.0, kGround);
      const Vec3 hole{0.345 * p.x, 0.345 * p.y, top};
      const Vec3 drop{0, 0, bottom - top};
      rings.push_back({hole, rim, rim + drop, hole + drop});
    }
    addLoft(part, rings, Ends::joined);
  }
  return part;
}

Part columns(const Palette& colour, const Skin& skin) {
  Part part("Columns", colour.light);
  for (int i = 0; i < kPanels; i += 6) {
    std::vector<Vec3> path;
    for (int s = -1; s <= kStoreys; ++s)
      path.push_back(skin.at(i, -1.5, s < 0 ? 0.0 : floorHeight(s) - (s == kStoreys ? 0.125 : 0.0)));
    addSweep(part, path, regular(8, 0.3438));
  }
  return part;
}

/// Two flights a storey, one on each side of the cross wall.
Part stairs(const Palette& colour) {
  Part part("Stairs", colour.light);
  const int steps = 10;
  for (int s = 0; s < kStoreys; ++s)
    for (const double side : {-1.0, 1.0}) {
      const double low = floorHeight(s), half = 0.5 * kStorey;
      for (int flight = 0; flight < 2; ++flight)
        for (int i = 0; i < steps; ++i) {
          const double run = 0.28125 * (flight == 0 ? i : steps - 1 - i), x = -1.4375 + run,
                       z = low + half * flight + half * (i + 1) / steps;
          const double y = side * (flight == 0 ? 0.875 : 2.125);
          addBox(part, {x, y - 0.5, z - 0.1875}, {x + 0.25, y + 0.5, z});
        }
    }
  return part;
}

/// A pergola of ribs over the roof terrace and the plant room behind it.
Part crown(const Palette& colour, const Skin& skin) {
  Part part("Crown", colour.aluminium);
  for (int i = 0; i < kPanels; i += 2) {
    const Vec3 foot = skin.at(i, -0.5, kRoof + 0.0), knee = skin.at(i, -0.5, kRoof + 4.0),
               tip = skin.at(i, -4.5, kRoof + 5.0);
    addSweep(part, std::array{foot, knee, tip}, rectangle(0.125, 0.3125));
  }
  for (const double inset : {0.5, 1.5, 2.5, 3.5, 4.25})
    addSweep(part, skin.ring(-inset, kRoof + 4.25 + 0.25 * (inset - 0.5)), rectangle(0.125, 0.125), Ends::joined);
  return part;
}

Part plant(const Palette& colour, const Skin& skin) {
  Part part("Plant", colour.dark);
  Outline lid;
  for (int i = 0; i < kPanels; i += 3) lid.emplace_back(0.345 * Vec2(skin.at(i, 0.0, kGround)));
  addPrism(part, lid, {0, 0, kRoof + 3.3125}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0.375});
  addBox(part, {-8.0, -3.5, kRoof - 0.125}, {-6.75, 3.5, kRoof + 3.0});
  for (const double x : {9.0, 11.5})
    for (const double y : {-2.5, 2.5}) {
      addBox(part, {x - 1.0, y - 1.5, kRoof - 0.125}, {x + 1.0, y + 1.5, kRoof + 1.75});
      addRevolved(part, {x, y, kRoof + 1.625}, {{0, 0}, {0.75, 0}, {0.75, 0.5}, {0, 0.5}}, 20);
    }
  addRevolved(part, {0, 0, kRoof + 3.0}, {{0, 0}, {0.3125, 0}, {0.25, 6.0}, {0.125, 16.0}, {0, 16.0}}, 10);
  return part;
}

/// The podium: a low ring of stone frames under a planted deck.
constexpr double kPodiumHalfX = 34.0, kPodiumHalfY = 24.0, kPodiumHeight = 5.0;

Part podiumDeck(const Palette& colour) {
  Part part("Deck", colour.light);
  addBox(part, {-kPodiumHalfX, -kPodiumHalfY, kPodiumHeight - 0.5}, {kPodiumHalfX, kPodiumHalfY, kPodiumHeight});
  for (const double y : {-19.0, 17.5})
    for (double x = -24.0; x < 24.0; x += 12.0)
      addBox(part, {x - 1.0, y - 1.0, kPodiumHeight - 0.125}, {x + 1.0, y + 2.5, kPodiumHeight + 0.5});
  addBox(part, {-kPodiumHalfX - 3.0, -kPodiumHalfY - 3.0, 0.0}, {kPodiumHalfX + 3.0, kPodiumHalfY + 3.0, 0.1875});
  addBox(part, {-kPodiumHalfX - 2.25, -kPodiumHalfY - 2.25, 0.09375},
         {kPodiumHalfX + 2.25, kPodiumHalfY + 2.25, 0.375});
  return part;
}

Part tree(const Palette& colour) {
  Part part("Tree", colour.bark);
  addRevolved(part, {0, 0, 0}, {{0, 0}, {0.1875, 0}, {0.125, 2.25}, {0, 2.25}}, 6);
  part.use(colour.leaves);
  addBlob(part, {0, 0, 3.0}, {1.25, 1.25, 1.5}, 1, 0.09);
  return part;
}

template <class Make>
void alongPodium(double spacing, const Make& make) {
  for (int turn = 0; turn < 4; ++turn) {
    const double half = turn % 2 == 0 ? kPodiumHalfX : kPodiumHalfY, out = turn % 2 == 0 ? kPodiumHalfY : kPodiumHalfX;
    const Mat4 frame = placed(Vec3(0.0), turn);
    const auto at = [&](double along, double depth, double z) {
      return transformPoint(frame, Vec3(along, depth - out, z));
    };
    const int count = static_cast<int>(std::lround(2.0 * half / spacing));
    for (int i = 0; i < count; ++i)
      make(at, -half + 2.0 * half * i / count, -half + 2.0 * half * (i + 1) / count, i == 0);
  }
}

Part podiumFrame(const Palette& colour) {
  Part part("Frame", colour.stone);
  alongPodium(1.0, [&](const auto& at, double a, double b, bool first) {
    if (first) return;  // the corner belongs to the other side
    const double x = 0.5 * (a + b);
    const Vec3 p = at(x - 0.0938, 0.25, 0.25), q = at(x + 0.0938, 0.75, kPodiumHeight - 0.25);
    addBox(part, glm::min(p, q), glm::max(p, q));
  });
  for (const double x : {-kPodiumHalfX + 0.5, kPodiumHalfX - 0.5})
    for (const double y : {-kPodiumHalfY + 0.5, kPodiumHalfY - 0.5})
      addBeam(part, {x, y, 0.3125}, {x, y, kPodiumHeight - 0.3125}, 0.75);
  for (const double z : {kPodiumHeight + 0.125, kPodiumHeight - 0.625}) {
    const double x = kPodiumHalfX - 0.25, y = kPodiumHalfY - 0.25;
    addSweep(part, std::array{Vec3(-x, -y, z), Vec3(x, -y, z), Vec3(x, y, z), Vec3(-x, y, z)}, rectangle(0.75, 0.375),
             Ends::joined);
  }
  return part;
}

Part podiumPanes(const Palette& colour) {
  Part part("Panes", colour.glass);
  alongPodium(2.0, [&](const auto& at, double a, double b, bool) {
    addSheet(part, at(a, 0.8125, 0.375), at(b, 0.8125, 0.375), at(b, 0.8125, kPodiumHeight - 0.5),
             at(a, 0.8125, kPodiumHeight - 0.5));
  });
  return part;
}

Part railing(const Palette& colour) {
  Part part("Railing", colour.dark);
  alongPodium(0.5, [&](const auto& at, double a, double b, bool) {
    const double x = 0.5 * (a + b);
    addBeam(part, at(x, 0.3125, kPodiumHeight + 0.25), at(x, 0.3125, kPodiumHeight + 1.3125), 0.0313);
  });
  const double x = kPodiumHalfX - 0.3125, y = kPodiumHalfY - 0.3125;
  for (const double z : {0.5, 0.75, 1.0, 1.3125})
    addSweep(part,
             std::array{Vec3(-x, -y, kPodiumHeight + z), Vec3(x, -y, kPodiumHeight + z), Vec3(x, y, kPodiumHeight + z),
                        Vec3(-x, y, kPodiumHeight + z)},
             rectangle(z > 1.0 ? 0.125 : 0.0625, 0.0625), Ends::joined);
  return part;
}

}  // namespace

scene::Scene building() {
  SceneBuilder scene("building");
  const Palette colour{scene.material("concrete", 0xaba69c),   scene.material("concrete, light", 0xcfcac0),
                       scene.material("aluminium", 0xc3ccd1),  scene.material("bronze", 0x9c7f5c),
                       scene.material("glass", 0x8fb8cc, 0.4), scene.material("stone", 0xd8cbb2),
                       scene.material("dark steel", 0x565e64), scene.material("leaves", 0x769a55),
                       scene.material("bark", 0x6b523c)};
  const Skin skin(kPanels);
  scene.place("Tower/Concrete", core(colour, skin));
  scene.place("Tower/Concrete", slabs(colour, skin));
  scene.place("Tower/Concrete", columns(colour, skin));
  scene.place("Tower/Concrete", stairs(colour));
  scene.place("Tower/Facade", mullions(colour, skin));
  scene.place("Tower/Facade", transoms(colour, skin));
  scene.place("Tower/Facade", fins(colour, skin));
  scene.place("Tower/Facade", panes(colour, skin));
  scene.place("Tower/Roof", crown(colour, skin));
  scene.place("Tower/Roof", plant(colour, skin));
  scene.place("Podium/Concrete", podiumDeck(colour));
  scene.place("Podium/Facade", podiumFrame(colour));
  scene.place("Podium/Facade", podiumPanes(colour));
  scene.place("Podium", railing(colour));
  const std::uint32_t trees = scene.share(tree(colour));
  for (int i = 0; i < 8; ++i)
    scene.place("Podium/Trees/Tree " + std::to_string(i + 1), trees,
                placed({-24.0 + 12.0 * (i % 4), i < 4 ? -18.0 : 18.5, kPodiumHeight + 0.375}, i));
  return std::move(scene).take();
}

}  // namespace umbrage::samples::detail

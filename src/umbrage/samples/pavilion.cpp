#include <array>
#include <string>

#include "umbrage/samples/detail/scenes.hpp"
#include "umbrage/samples/detail/shapes.hpp"

namespace umbrage::samples::detail {
namespace {

constexpr double kHeight = 4.0;               // of the panes
constexpr double kColumn = 1.0;               // width of a pane
constexpr double kPost = 0.12, kRail = 0.08;  // thickness of the uprights and of what lies between
// The case stands on feet too low to be seen: its floor of glass and the stone do not share a plane.
constexpr double kFoot = 0.02;

struct Glasses {
  std::array<std::uint32_t, 6> pane;
  std::uint32_t clear, smoke;
};

Glasses glasses(SceneBuilder& scene) {
  return {{scene.material("ruby", 0xE0202A, 0.3), scene.material("amber", 0xF0A020, 0.25),
           scene.material("emerald", 0x28B060, 0.3), scene.material("cobalt", 0x2848D8, 0.35),
           scene.material("violet", 0x9038C0, 0.3), scene.material("honey", 0xF4D860, 0.2)},
          scene.material("clear glass", 0xE8F4F0, 0.15),
          scene.material("smoked glass", 0x8090A0, 0.45)};
}

/// A wall of panes, `columns` wide, from a foot along `u`; its thickness runs along `v`.
void addWindow(SceneBuilder& scene, const std::string& name, const Vec3& foot, const Vec3& u, const Vec3& v,
               int columns, const Glasses& glass, std::uint32_t lead) {
  const Vec3 up(0, 0, 1);
  const double width = columns * kColumn;
  Part frame("Frame", lead);
  for (int c = 0; c <= columns; ++c) {
    const Vec3 at = foot + u * (c * kColumn);
    addBeam(frame, at, at + up * kHeight, kPost);
  }
  constexpr int kRows = 4;
  for (int r = 0; r <= kRows; ++r) {
    const Vec3 at = foot + up * (r * kHeight / kRows);
    addBeam(frame, at, at + u * width, kRail);
  }
  scene.place(name, std::move(frame));
  Part panes("Panes", glass.pane[0]);
  for (int c = 0; c < columns; ++c) {
    for (int r = 0; r < kRows; ++r) {
      panes.use(glass.pane[static_cast<std::size_t>((c + 2 * r) % 6)]);
      const Vec3 at = foot + u * (c * kColumn) + up * (r * kHeight / kRows);
      const Vec3 a = at + v * 0.0, b = at + u * kColumn, d = at + up * (kHeight / kRows);
      addSheet(panes, a, b, b + (d - a), d);
    }
  }
  scene.place(name, std::move(panes));
}

}  // namespace

// Coloured light on a pale floor: a stained-glass corner, a ball of glass, and a smoked case with something inside.
scene::Scene pavilion() {
  SceneBuilder scene("pavilion");
  const std::uint32_t stone = scene.material("stone", 0xE8E4DC), lead = scene.material("lead", 0x404448),
                      brass = scene.material("brass", 0xC8A050);
  const Glasses glass = glasses(scene);
  Part floor("Floor", stone);
  addBox(floor, {-6, -5, -0.25}, {6, 5, 0});
  scene.place("Pavilion", std::move(floor));
  addWindow(scene, "Pavilion/South", {-1, -2.5, 0}, {1, 0, 0}, {0, 1, 0}, 4, glass, lead);
  addWindow(scene, "Pavilion/East", {3.2, -2.3, 0}, {0, 1, 0}, {1, 0, 0}, 4, glass, lead);

  Part plinth("Plinth", stone);
  addBox(plinth, {-3.6, -2.2, 0}, {-2.4, -1.0, 0.6});
  scene.place("Pavilion", std::move(plinth));
  Part ball("Ball", glass.clear);
  addBlob(ball, {-3.0, -1.6, 1.35}, {0.75, 0.75, 0.75}, 3, 0.0);
  scene.place("Pavilion", std::move(ball));

  Part shell("Case", glass.smoke);
  addBox(shell, {-4.9, 0.9, kFoot}, {-3.1, 2.7, 1.8});
  scene.place("Pavilion", std::move(shell));
  Part inside("Inside", brass);
  addBox(inside, {-4.4, 1.4, 0.2}, {-3.6, 2.2, 0.6});
  addBlob(inside, {-4.0, 1.8, 1.05}, {0.4, 0.4, 0.4}, 2, 0.0);
  scene.place("Pavilion", std::move(inside));
  return std::move(scene).take();
}

}  // namespace umbrage::samples::detail

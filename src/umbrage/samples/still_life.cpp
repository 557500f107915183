#include "umbrage/samples/detail/scenes.hpp"
#include "umbrage/samples/detail/shapes.hpp"

namespace umbrage::samples::detail {
namespace {

constexpr int kSquares = 12;

void addChequers(Part& part, std::uint32_t dark, std::uint32_t pale) {
  for (int i = -kSquares / 2; i < kSquares / 2; ++i) {
    for (int j = -kSquares / 2; j < kSquares / 2; ++j) {
      part.use((i + j) % 2 == 0 ? dark : pale);
      addSheet(part, Vec3(i, j, 0), Vec3(i + 1, j, 0), Vec3(i + 1, j + 1, 0), Vec3(i, j + 1, 0));
    }
  }
}

/// A ball in a mesh of eight times its size: what is seen in it shows the last thousandth of a metre.
void placeBall(SceneBuilder& scene, const std::string& name, std::uint32_t material, const Vec3& centre,
               double radius) {
  Part ball(name, material);
  addBlob(ball, {0, 0, 0}, Vec3(8.0 * radius), 5, 0.0);
  scene.place("Still life/" + name, scene.share(std::move(ball)), placed(centre, 0, 0.125));
}

}  // namespace

// What reflects and what refracts, after the picture with which ray tracing began. Source: T. Whitted, An improved illumination model for shaded
// display, 1980.
scene::Scene stillLife() {
  SceneBuilder scene("still_life");
  const std::uint32_t dark = scene.material("dark", 0xA83C28), pale = scene.material("pale", 0xF0D890),
                      silver = scene.material("silver", 0xF4F4F0), glass = scene.material("glass", 0xF8FCFC, 0.0),
                      frame = scene.material("frame", 0x503820), clay = scene.material("clay", 0x4880C0),
                      blue = scene.material("blue", 0x5E7E98), ochre = scene.material("ochre", 0xB08850);
  scene.mirror(silver, 0.9);
  scene.fill(glass, {0.98, 0.995, 0.99}, 1.5);
  Part floor("Floor", dark);
  addChequers(floor, dark, pale);
  scene.place("Still life", std::move(floor));
  placeBall(scene, "Glass ball", glass, {-0.75, -2.25, 1.0}, 0.96875);
  placeBall(scene, "Silver ball", silver, {1.25, 0.0, 1.265625}, 1.25);
  placeBall(scene, "Clay ball", clay, {-2.25, 0.5, 0.765625}, 0.75);
  Part mirror("Mirror", silver);
  addSheet(mirror, {-3.5, 4, 0.25}, {3.5, 4, 0.25}, {3.5, 4, 4.25}, {-3.5, 4, 4.25});
  scene.place("Still life", std::move(mirror));
  Part board("Frame", frame);
  addBox(board, {-3.75, 4.0625, 0}, {3.75, 4.25, 4.5});
  scene.place("Still life", std::move(board));
  Part back("Back", blue), side("Side", ochre);
  addBox(back, {-6, 4.375, 0}, {6, 4.5, 6});
  addBox(side, {-6.125, -6, 0}, {-6, 4.375, 6});
  scene.place("Room", std::move(back));
  scene.place("Room", std::move(side));
  scene.light({scene::PointLight{{-3.5, -5.5, 7.0}}, Vec3(1.0), 0.9, "lamp"});
  return std::move(scene).take();
}

}  // namespace umbrage::samples::detail

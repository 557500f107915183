#include "umbrage/samples/detail/scenes.hpp"
#include "umbrage/samples/detail/shapes.hpp"

namespace umbrage::samples::detail {
namespace {

constexpr double kRoom = 5.5;    // inner width, depth and height
constexpr double kWall = 0.125;  // thickness

/// A block turned about its upright axis: a corner of its foot, one edge of it, and its height.
void addBlock(Part& part, const Vec2& corner, const Vec2& edge, double height) {
  const Outline foot{corner, corner + edge, corner + edge + Vec2(-edge.y, edge.x), corner + Vec2(-edge.y, edge.x)};
  addPrism(part, foot, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, height});
}

}  // namespace

// The room by which pictures of light between surfaces are compared, open to the south. Source: C. M. Goral, K. E. Torrance, D. P. Greenberg and
// B. Battaile, Modeling the interaction of light between diffuse surfaces, 1984.
scene::Scene cornell() {
  SceneBuilder scene("cornell");
  const std::uint32_t white = scene.material("white", 0xDEDCD6), red = scene.material("red", 0xC8201C),
                      green = scene.material("green", 0x2C9838), lamp = scene.material("lamp", 0xC8C8C8);
  scene.shine(lamp, {26.0, 21.0, 14.0});
  Part floor("Floor", white), ceiling("Ceiling", white), back("Back", white), left("Left", red), right("Right", green);
  addBox(floor, {-kWall, 0, 0}, {kRoom + kWall, kRoom + kWall, kWall});
  addBox(ceiling, {-kWall, 0, kRoom + kWall}, {kRoom + kWall, kRoom + kWall, kRoom + 2 * kWall});
  addBox(back, {0, kRoom, kWall}, {kRoom, kRoom + kWall, kRoom + kWall});
  addBox(left, {-kWall, 0, kWall}, {0, kRoom + kWall, kRoom + kWall});
  addBox(right, {kRoom, 0, kWall}, {kRoom + kWall, kRoom + kWall, kRoom + kWall});
  for (Part* part : {&floor, &ceiling, &back, &left, &right}) scene.place("Room", std::move(*part));
  Part panel("Panel", lamp);
  addBox(panel, {2.125, 2.25, kRoom + kWall - 0.0625}, {3.375, 3.25, kRoom + kWall - 0.03125});
  scene.place("Lamp", std::move(panel));
  Part tall("Tall", white), low("Low", white);
  addBlock(tall, {1.125, 2.875}, {1.5625, 0.5}, 3.25 + kWall);
  addBlock(low, {3.125, 0.75}, {1.5625, -0.4375}, 1.625 + kWall);
  scene.place("Blocks", std::move(tall));
  scene.place("Blocks", std::move(low));
  return std::move(scene).take();
}

}  // namespace umbrage::samples::detail

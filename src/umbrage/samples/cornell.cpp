#include "umbrage/samples/detail/scenes.hpp"
#include "umbrage/samples/detail/shapes.hpp"

namespace umbrage::samples::detail {
namespace {

constexpr double kRoom = 5.5;    // inner width, depth and height
constexpr double kWall = 0.125;  // thickness

/// A block turned about its upright axis: a corner of its foot, one edge of it, and its height.
void addBlock(Part& part, const Vec2& corner, const Vec2& edge, double height) {
  const Outline foot{corner, corner + edge, corner + edge + Vec2(-edge.y, edge.x), corner + Vec2(-edge.y, edge.x)};
  addPrism(part, foot, {0, 0, kWall}, {1, 0, 0}, {0, 1, 0}, {0, 0, height});
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
  // Walls touch in edges, so that what is seen of each is all of one of its faces.
  const double foot = kWall, top = kWall + kRoom;
  addBox(floor, {0, 0, 0}, {kRoom, kRoom, foot});
  addBox(ceiling, {0, 0, top}, {kRoom, kRoom, top + kWall});
  addBox(back, {0, kRoom, foot}, {kRoom, kRoom + kWall, top});
  addBox(left, {-kWall, 0, foot}, {0, kRoom, top});
  addBox(right, {kRoom, 0, foot}, {kRoom + kWall, kRoom, top});
  for (Part* part : {&floor, &ceiling, &back, &left, &right}) scene.place("Room", std::move(*part));
  Part housing("Housing", white), panel("Panel", lamp);
  addBox(housing, {2.0625, 2.1875, top - 0.0625}, {3.4375, 3.3125, top});
  addSheet(panel, {2.125, 2.25, top - 0.09375}, {2.125, 3.25, top - 0.09375}, {3.375, 3.25, top - 0.09375},
           {3.375, 2.25, top - 0.09375});
  scene.place("Lamp", std::move(housing));
  scene.place("Lamp", std::move(panel));
  Part tall("Tall", white), low("Low", white);
  addBlock(tall, {1.125, 2.875}, {1.5625, 0.5}, 3.25);
  addBlock(low, {3.125, 0.75}, {1.5625, -0.4375}, 1.625);
  scene.place("Blocks", std::move(tall));
  scene.place("Blocks", std::move(low));
  return std::move(scene).take();
}

}  // namespace umbrage::samples::detail

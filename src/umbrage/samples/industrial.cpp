// An industrial site of 180 m x 120 m. What the scene is made of stands in industrial_*.cpp; here is where everything stands.
#include <array>
#include <string>

#include "umbrage/samples/detail/industrial.hpp"
#include "umbrage/samples/detail/scenes.hpp"

namespace umbrage::samples::detail {
namespace {

using namespace plant;

Colours colours(SceneBuilder& scene) {
  return {scene.material("concrete", 0xb8b4ab),
          scene.material("cladding", 0xc9d2d6),
          scene.material("cladding, blue", 0x5f8fb0),
          scene.material("steel", 0x6f7f88),
          scene.material("tank white", 0xe6e4dc),
          scene.material("silo", 0xd6c9a4),
          scene.material("brick", 0xa8604a),
          scene.material("signal red", 0xc24a3a),
          scene.material("pipe silver", 0xbfc6c9),
          scene.material("pipe yellow", 0xd9b043),
          scene.material("pipe green", 0x6f9a6a),
          scene.material("glass", 0xa6c8d4, 0.45),
          scene.material("door", 0x4d6a7d)};
}

void placeTanks(SceneBuilder& scene, const Colours& colour) {
  const std::uint32_t shell = scene.share(tank(colour)), stair = scene.share(tankStair(colour));
  int number = 0;
  for (const double y : {-12.0, 8.0})
    for (const double x : {-78.0, -58.0, -38.0}) {
      const std::string path = "Tank farm/Tank " + std::to_string(++number);
      scene.place(path + "/Body", shell, placed({x, y, 0.0}));
      scene.place(path + "/Stair", stair, placed({x, y, 0.0}, number));
    }
  scene.place("Tank farm", bund(colour, {-90.0, -24.0}, {-26.0, 20.0}));
}

void placeSpheres(SceneBuilder& scene, const Colours& colour) {
  const std::uint32_t sphere = scene.share(gasSphere(colour));
  scene.place("Spheres/Sphere 1", sphere, placed({-76.0, 42.0, 0.0}));
  scene.place("Spheres/Sphere 2", sphere, placed({-54.0, 42.0, 0.0}, 1));
}

void placeHalls(SceneBuilder& scene, const Colours& colour) {
  const std::uint32_t body = scene.share(sawToothHall(colour)), glazing = scene.share(sawToothGlass(colour));
  scene.place("Halls/Hall 1/Body", body, placed({28.0, 34.0, 0.0}));
  scene.place("Halls/Hall 1/Glazing", glazing, placed({28.0, 34.0, 0.0}));
  scene.place("Halls/Hall 2/Body", body, placed({28.0, -36.0, 0.0}));
  scene.place("Halls/Hall 2/Glazing", glazing, placed({28.0, -36.0, 0.0}));
}

void placeSilos(SceneBuilder& scene, const Colours& colour) {
  const std::uint32_t one = scene.share(silo(colour));
  for (int i = 0; i < 4; ++i)
    scene.place("Silos/Silo " + std::to_string(i + 1), one,
                placed({76.0 + 8.0 * (i % 2), 30.0 + 8.0 * (i / 2), 0.0}, i));
}

void placeChimneys(SceneBuilder& scene, const Colours& colour) {
  scene.place("Chimneys", chimney(colour, "Chimney 1", {-6.0, 36.0, 0.0}, 62.0, 2.5));
  scene.place("Chimneys", chimney(colour, "Chimney 2", {-6.0, 48.0, 0.0}, 48.0, 2.0));
}

}  // namespace

scene::Scene industrial() {
  SceneBuilder scene("industrial");
  const Colours colour = colours(scene);
  placeHalls(scene, colour);
  placeTanks(scene, colour);
  placeSpheres(scene, colour);
  placeSilos(scene, colour);
  placeChimneys(scene, colour);
  scene.place("Pipe rack", rackFrames(colour));
  scene.place("Pipe rack", rackPipes(colour));
  scene.place("Cooling towers", coolingShell(colour, {74.0, -38.0, 0.0}));
  scene.place("Cooling towers", coolingBase(colour, {74.0, -38.0, 0.0}));
  scene.place("Process", processFrame(colour));
  scene.place("Process", processVessels(colour));
  scene.place("Process", processStairs(colour));
  scene.place("Conveyor", conveyorTruss(colour));
  scene.place("Conveyor", conveyorGallery(colour));
  scene.place("Yard", containers(colour));
  return std::move(scene).take();
}

}  // namespace umbrage::samples::detail

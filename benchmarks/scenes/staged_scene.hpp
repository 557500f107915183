#pragma once

#include <string>
#include <vector>

#include "umbrage/scene/scene.hpp"

namespace umbrage::benchmarks {

/// A picture to be taken of a scene.
struct Shot {
  std::string name;
  scene::Camera camera;
  scene::Light light;
};

/// A scene made by code, with the pictures in which every program that draws shadows is measured, ours and others: the same
/// triangles, cameras and lights for all.
/// 1. Z is up, the ground is a square at height 0 that casts nothing, all casters are closed and wound outwards.
/// 2. Coordinates are whole multiples of 1/1024, which single precision holds.
struct StagedScene {
  std::string name;
  scene::Scene scene;
  std::vector<Shot> shots;
};

/// `boxes` x `boxes` (100: 120,000 triangles) houses on a grid of 20 m, 6 to 76 m high, each turned a little; shots `city_air`,
/// `city_street` and `city_lamp` (from the air again, with a lamp 14 m above a street, below the roofs).
[[nodiscard]] StagedScene city(int boxes = 100);

/// A torus knot with grooves, twice `columns` times `rows` triangles (64,800, of so few corners that 16 bits number them): curved, and everywhere near
/// its own shadow; shot `grooved_knot`.
[[nodiscard]] StagedScene groovedKnot(std::uint32_t columns = 600, std::uint32_t rows = 54);

/// All of them.
[[nodiscard]] std::vector<StagedScene> stagedScenes();

/// The scene as plain text for programs that know nothing of Umbrage, in world coordinates, one record a line:
///   mesh NAME CASTS CORNERS TRIANGLES    CASTS is 0 or 1; then CORNERS lines "x y z", TRIANGLES lines "a b c"
///   shot NAME EYE TARGET FOV LIGHT       EYE, TARGET, LIGHT (a point): x y z; FOV: vertical, in radians
[[nodiscard]] std::string exported(const StagedScene& stage);

}  // namespace umbrage::benchmarks

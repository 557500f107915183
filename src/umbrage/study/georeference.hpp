#pragma once

#include "umbrage/base/error.hpp"
#include "umbrage/scene/scene.hpp"
#include "umbrage/sun/sun.hpp"

namespace umbrage::study {

/// Where on Earth a scene stands.
struct Georeference {
  sun::Place place;    ///< of the middle of the scene's bounds
  Angle trueNorth;     ///< there, clockwise of the y axis of the scene's reference system
  double reach = 0.0;  ///< metres from the middle to the corners of its bounds
};

/// By Scene::crs. Errors: input, where the scene has none, it is not known or does not reach the scene.
[[nodiscard]] Result<Georeference> georeferenceOf(const scene::Scene& scene);

/// East and north (the scene's x and y with Z up, x and -z with Y up) of a point, in the scene's unit.
[[nodiscard]] inline Vec2 mapPoint(const Vec3& p, scene::UpAxis up) {
  return up == scene::UpAxis::z ? Vec2(p.x, p.y) : Vec2(p.x, -p.z);
}
[[nodiscard]] inline double mapHeight(const Vec3& p, scene::UpAxis up) { return up == scene::UpAxis::z ? p.z : p.y; }
/// The inverse of both.
[[nodiscard]] inline Vec3 scenePoint(const Vec2& p, double height, scene::UpAxis up) {
  return up == scene::UpAxis::z ? Vec3(p, height) : Vec3(p.x, height, -p.y);
}

}  // namespace umbrage::study

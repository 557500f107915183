#pragma once

#include <string>
#include <vector>

#include "umbrage/scene/scene.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::conformance {

struct NamedLight {
  std::string name;
  scene::Light light;
};
struct NamedView {
  std::string name;
  scene::Camera camera;
};

/// A scene, and every light under which and every camera from which it is judged.
struct Case {
  std::string name;
  scene::Scene scene;
  std::vector<NamedLight> lights;
  std::vector<NamedView> views;
};

/// Names of the scenes written in code: closed, open, non-manifold, soups, rooms, far, huge and tiny ones.
[[nodiscard]] std::vector<std::string> sceneNames();
/// REQUIRES: a name of sceneNames().
[[nodiscard]] Case makeCase(const std::string& name);

/// Lights and views made from a scene's own size, corners, faces and silhouettes, so that every scene meets the situations that
/// break shadows: eyes in volumes and on their sides, lights in corners and in planes of faces.
[[nodiscard]] std::vector<NamedLight> standardLights(const scene::Scene& scene);
[[nodiscard]] std::vector<NamedView> standardViews(const scene::Scene& scene, const std::vector<NamedLight>& lights);

/// `count` more views: random ones, and eyes at 0, 1e-6 .. 1e-2 of the scene's size from sides of shadow volumes, where z-pass is
/// weakest.
[[nodiscard]] std::vector<NamedView> searchViews(const Case& c, const shadow::Geometry& geometry, int count);

[[nodiscard]] scene::Camera looking(const Vec3& eye, const Vec3& target, double fovDegrees, int width, int height);

}  // namespace umbrage::conformance

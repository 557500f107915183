#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "umbrage/base/angle.hpp"
#include "umbrage/mesh/mesh.hpp"
#include "umbrage/scene/camera.hpp"
#include "umbrage/scene/light.hpp"

namespace umbrage::scene {

/// How a surface looks. colour: linear RGB in [0, 1]; opacity: 0 (nothing is seen of it) to 1.
struct Material {
  std::string name;
  Vec3 colour{0.8};
  double opacity = 1.0;
  std::optional<Vec3> filter = {};  ///< what passes it, per channel in [0, 1], where that is not (1 - opacity) x colour
  Vec3 emission{0.0};  ///< light that each side gives off by itself, the same to all directions; linear RGB, at least 0
  double mirror = 0.0;  ///< the part of its opacity that reflects as a mirror does, in its colour, in [0, 1]
  double ior =
      1.0;  ///< index of refraction of what its closed surfaces hold, at least 1; 1: light that passes goes straight on
};

/// The part of the light that passes a surface, per channel: mostly its colour where it is not opaque.
/// Source: Kim, Kim and Turk, real-time shadows of transparent casters, 2008.
[[nodiscard]] inline Vec3 transmittance(const Material& material) {
  return material.filter.value_or((1.0 - material.opacity) * material.colour);
}

/// One placed mesh. `name` is its path through the file's hierarchy, levels separated by '/': "House/Roof/Tiles".
struct Instance {
  std::string name;
  std::uint32_t mesh = 0;
  Mat4 toWorld{1.0};  ///< affine; may mirror and scale unevenly
  bool casts = true;  ///< false: it only receives shadows
  /// The building (or bridge, ..) that this is a part of, by the name the file knows it by; empty where the file says nothing of the kind.
  std::string group = {};
};

/// What a file (or a program) says about the world, in the file's own coordinates and units. Immutable once made: changes make
/// a new Scene, sharing the meshes.
/// 1. Every Instance::mesh and every material index is valid; every number is finite.
struct Scene {
  std::string source;  ///< file name, for messages
  UpAxis up = UpAxis::z;
  double metresPerUnit = 1.0;
  Angle northOffset;  ///< true north lies this much clockwise of the frame's north (see northVector)
  std::string crs;    ///< coordinate reference system as the file names it, for example "EPSG:28992"; empty: none
  std::vector<std::shared_ptr<const mesh::Mesh>> meshes;
  std::vector<Material> materials;  ///< never empty in a valid scene
  std::vector<Instance> instances;
  std::vector<Light> lights;
  std::vector<std::string> warnings;  ///< what was dropped or guessed while reading, for the user
};

[[nodiscard]] std::size_t triangleCount(const Scene& scene);

/// Bounds of all instances, or of those that cast.
[[nodiscard]] Box3 bounds(const Scene& scene, bool castersOnly = false);

/// What breaks law 1, or nothing. Importers and the hand-over from the reader process are checked by this.
[[nodiscard]] std::optional<std::string> findFault(const Scene& scene);

/// The name of the receiver that withGround adds.
inline constexpr const char* kGroundName = "ground";

/// The scene with a large horizontal receiver at `height` along the up axis (the scene's lowest point by default) that casts
/// nothing. Its half side is 64 times the scene's radius.
[[nodiscard]] Scene withGround(Scene scene, std::optional<double> height = std::nullopt);

/// The scene in which only instances whose name matches one of the shell patterns ('*', '?'; case counts) cast; a pattern
/// matches the whole path or any one level of it.
[[nodiscard]] Scene withCasters(Scene scene, const std::vector<std::string>& patterns);

/// The matching rule of withCasters.
[[nodiscard]] bool matchesName(const std::string& name, const std::string& pattern);

}  // namespace umbrage::scene

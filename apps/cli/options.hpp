#pragma once

#include <optional>
#include <string>
#include <vector>

#include "declare.hpp"
#include "graphics.hpp"
#include "parse.hpp"
#include "technique_options.hpp"
#include "umbrage/base/angle.hpp"
#include "umbrage/scene/scene.hpp"
#include "umbrage/shadow/finders/finder.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::cli {

/// Which scene, and how its file is to be understood.
struct SceneOptions {
  std::string file;
  std::optional<scene::UpAxis> up;
  std::optional<double> metresPerUnit;
  std::optional<Angle> north;
  bool trueNorth = false;  ///< --north true: as the scene's reference system says
  std::optional<std::string> lod;
  std::optional<std::string> crs;
  std::optional<std::string> heightProperty;
  std::optional<double> defaultHeight, floorHeight;
  std::optional<std::size_t> alphaTriangles, alphaTexels;
  std::vector<std::string> casters;  ///< patterns of the parts that cast; empty: all
};
void addSceneOptions(CLI::App& app, SceneOptions& options);

/// A file, or "sample:NAME". Errors: usage, when no part has a name that `casters` asks for.
[[nodiscard]] Result<scene::Scene> loadScene(const SceneOptions& options);
/// The same, its warnings shown on the console.
[[nodiscard]] Result<scene::Scene> loadScene(const SceneOptions& options, const Console& console);

/// Refuses a scene in which nothing casts a shadow: all figures of it would be those of an open field. Errors: input.
[[nodiscard]] Result<void> checkCasts(const scene::Scene& scene, const SceneOptions& options);

/// `--ground`: at a height, or at the scene's lowest point.
struct Ground {
  std::optional<double> height;
};

/// How the scene is looked at and lit.
struct ViewOptions {
  std::optional<Vec3> eye, target;
  Angle fov = Angle::degrees(45);
  Size size;
  std::optional<Ground> ground;
  std::vector<scene::Light> lights;
  double ambient = 0.25;
  double shadowRoom = 0.2;  ///< how far around the scene its ground is framed too, in heights of the scene
  int antialias = 1;        ///< the picture is drawn this many times as wide and high, and averaged
  shadow::FinderKind silhouettes = shadow::FinderKind::automatic;
  shadow::VolumeFill fill = shadow::VolumeFill::reduced;
  shadow::Extrusion extrusion = shadow::Extrusion::vertexShader;
  std::optional<int> veilLayers;
  std::optional<double> seeThrough;
  std::optional<Angle> smooth;  ///< the crease angle of smooth shading
  bool hideTerminator = false;
  shadow::SoftSampling soft;
  TechniqueOptions techniques;
};
void addCameraOptions(CLI::App& app, ViewOptions& options);
/// --ambient, for pictures whose light is that of lights alone.
void addAmbientOption(CLI::App& app, ViewOptions& options);
void addAntialiasOption(CLI::App& app, ViewOptions& options);
void addLightOptions(CLI::App& app, ViewOptions& options);
void addGroundOption(CLI::App& app, ViewOptions& options);
/// --silhouette, for commands that draw with techniques of shadow volumes.
void addSilhouetteOption(CLI::App& app, ViewOptions& options);
/// --veil-layers, for those that draw what lets light through.
void addVeilOption(CLI::App& app, ViewOptions& options);

/// The scene as it is drawn, and why it is looked at and lit so.
struct View {
  scene::Scene scene;
  scene::Camera camera;
  std::vector<scene::Light> lights;
  shadow::FinderKind silhouettes = shadow::FinderKind::automatic;
  shadow::VolumeFill fill = shadow::VolumeFill::reduced;
  shadow::Extrusion extrusion = shadow::Extrusion::vertexShader;
  std::optional<int> veilLayers = {};
  shadow::SoftSampling soft = {};
  TechniqueOptions techniques = {};
  bool detailed = false;  ///< statistics that take time of their own are wanted
  std::string cameraReason;
  std::string lightReason;
};
/// Errors: usage, when eye and target coincide or the picture with so many lights does not fit into memory.
[[nodiscard]] Result<View> makeView(scene::Scene scene, const ViewOptions& options);

}  // namespace umbrage::cli

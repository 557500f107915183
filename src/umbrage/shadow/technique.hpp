#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "umbrage/base/error.hpp"
#include "umbrage/scene/camera.hpp"
#include "umbrage/scene/light.hpp"
#include "umbrage/scene/surfaces.hpp"
#include "umbrage/shadow/caster_set.hpp"
#include "umbrage/shadow/filters.hpp"
#include "umbrage/shadow/finders/finder.hpp"
#include "umbrage/shadow/light_mask.hpp"
#include "umbrage/shadow/surface_buffer.hpp"
#include "umbrage/shadow/veils.hpp"

namespace umbrage::shadow {

/// What a technique is and promises.
struct Traits {
  std::string name;            ///< as the command line spells it: "zfail"
  std::string summary;         ///< one sentence
  bool soft = false;           ///< takes area lights
  bool tinted = false;         ///< knows coloured transparent casters
  bool needsClosed = false;    ///< exact for closed casters only
  bool needsGraphics = false;  ///< runs on OpenGL
  int edgeTolerancePx = 1;     ///< pixels this near to a true edge may differ from the truth
  /// Pixels may differ from the truth anywhere, fewer with more work: its error is a number to be measured, not a promise to be judged.
  bool approximate = false;
};

/// The geometry a technique is prepared for.
struct Geometry {
  scene::Surfaces surfaces;
  CasterSet casters;
  Filters filters = {};  ///< for techniques that know transparent casters; to all others every surface is opaque
};
[[nodiscard]] inline std::shared_ptr<const Geometry> makeGeometry(const scene::Scene& scene) {
  auto surfaces = scene::flatten(scene);
  auto casters = buildCasters(surfaces);
  Filters filters(surfaces, scene.materials);
  return std::make_shared<const Geometry>(Geometry{std::move(surfaces), std::move(casters), std::move(filters)});
}

/// How much of the shadow volumes is drawn; no pixel depends on it.
enum class VolumeFill {
  reduced,  ///< what can change a pixel
  plain,    ///< everything, to infinity: for comparison
};

/// Who carries the vertices of shadow volumes away from the light; no pixel depends on it.
enum class Extrusion {
  processor,       ///< every vertex that is drawn is computed and sent
  vertexShader,    ///< indices into doubled vertices are sent
  geometryShader,  ///< edges are sent; their sides are made of them on the way. Caps as vertexShader
};

/// How far along soft shadows are.
struct SoftProgress {
  std::size_t light = 0;    ///< of the frame
  std::size_t samples = 0;  ///< taken of it
  double error = 0.0;       ///< estimated, as SoftStats has it
};

/// How lights with an extent are sampled.
struct SoftSampling {
  std::size_t samples = 64;  ///< of each such light, at most
  double enough = 0.0;       ///< no more samples are taken where the estimated error is at most this
  /// Told after each part of the samples; false ends the light with what there is. Null: nobody wants to know.
  std::function<bool(const SoftProgress&)> progress = {};
};

/// One picture's worth of work.
struct Frame {
  scene::Camera camera;
  std::span<const scene::Light> lights;
  /// Who finds them, where the technique needs silhouettes; changes no pixel.
  FinderKind silhouettes = FinderKind::automatic;
  VolumeFill fill = VolumeFill::reduced;
  std::optional<Extrusion> extrusion = {};  ///< none: as the technique was made
  /// So many veils of each pixel, the nearest, are lit each by itself; those behind them as the last of these, and without any shadow when it is 0. None: all
  /// are lit by themselves. For techniques that are `tinted`.
  std::optional<int> veilLayers = {};
  SoftSampling soft = {};     ///< for techniques that are `soft`; to all others a light is its centre
  bool surfaceWanted = true;  ///< false: Shading::surface may be left empty, which saves time
  bool detailed = false;      ///< LightStats::choices and volumeFragments are wanted, which take time of their own
};

struct PhaseTime {
  std::string name;
  double milliseconds = 0.0;
};

/// What became of one component of the casters, and why.
enum class CasterChoice : std::uint8_t {
  zPass,         ///< counted before the surfaces
  zFail,         ///< counted behind the surfaces, as all are
  zFailTouched,  ///< since the eye touches a side of its volume, or the caster itself
  zFailBetween,  ///< since it may lie between the eye and the light
  hidden,        ///< left out, wholly in the shadow of a convex solid
  noReceiver,    ///< left out, no surface that is seen and faces the light lies in its volume
};
inline constexpr std::size_t kCasterChoices = 6;
/// "zpass", "zfail" or "left out".
[[nodiscard]] std::string_view name(CasterChoice choice);
/// In words, for people.
[[nodiscard]] std::string_view reason(CasterChoice choice);

/// What is known of a light with an extent.
struct SoftStats {
  std::size_t samples = 0;
  /// Root of the mean square error of the light over all pixels that show a surface, estimated from how much two halves of the samples differ: mostly
  /// too high, since the halves complete each other.
  double error = 0.0;
  std::size_t umbra = 0, penumbra = 0;  ///< pixels whose surface no sample reaches, and some
};

/// What was done for one light, for --stats.
struct LightStats {
  std::string method;  ///< for example "zpass", "zfail", "ray_traced"
  std::string reason;  ///< why this method, in words
  std::size_t edgesTested = 0;
  std::size_t silhouetteEdges = 0;
  std::size_t volumeTriangles = 0;
  std::size_t castersByZFail = 0;  ///< components that fell back from z-pass
  int eyeCount = 0;
  std::size_t planes = 0;      ///< that shadows were projected onto, by techniques that do so
  std::size_t shadowMaps = 0;  ///< that were drawn, by techniques that look them up
  std::size_t mapTexels = 0;   ///< of all of them
  std::string finder;          ///< who found the silhouette; empty when none was needed
  // What was left out, since it changes no pixel:
  std::size_t castersHidden = 0;       ///< components wholly in the shadow of a convex one
  std::size_t castersBehind = 0;       ///< components whose volumes touch no receiver's line of sight
  std::size_t sidesBehind = 0;         ///< further single sides
  std::size_t endlessCasters = 0;      ///< components whose volumes no plane can end
  std::optional<SoftStats> soft = {};  ///< of lights with an extent, by techniques that are `soft`
  // When the frame is `detailed`, of techniques of shadow volumes:
  std::vector<CasterChoice> choices;  ///< per component
  /// Pixels that the volumes' triangles cover where they are drawn, each triangle by itself: the cost of filling them.
  std::optional<std::uint64_t> volumeFragments;
};

struct FrameStats {
  std::vector<PhaseTime> phases;  ///< wall-clock, in order; with OpenGL each ends with a finish
  std::vector<LightStats> lights;
  bool surfaceKept = false;  ///< what the camera sees was known from a frame before
};

/// One mask per light of the frame, and what the camera sees.
struct Shading {
  SurfaceBuffer surface;  ///< of techniques that are `tinted`: the first opaque surfaces
  std::vector<LightMask> masks;
  VeilBuffer veils = {};  ///< before `surface`; only of techniques that are `tinted`
  FrameStats stats;
  /// 1 where the technique knows no shadows on what is seen, so that the masks tell only whether it faces the light; empty: it knows them everywhere.
  image::GreyImage unshadowed = {};
};

/// A way to compute shadows. prepare() once per geometry, shade() once per frame. Not thread-safe.
class Technique {
 public:
  virtual ~Technique() = default;
  [[nodiscard]] virtual const Traits& traits() const = 0;
  /// Errors: ErrorCode::device when memory or features are missing.
  [[nodiscard]] virtual Result<void> prepare(std::shared_ptr<const Geometry> geometry) = 0;
  /// REQUIRES: prepare() succeeded. A frame without lights gives the surface alone.
  [[nodiscard]] virtual Result<Shading> shade(const Frame& frame) = 0;
};

/// One row of a room's registry.
struct TechniqueEntry {
  Traits traits;
  /// Errors: ErrorCode::device, saying why it cannot run here.
  std::function<Result<std::unique_ptr<Technique>>()> create;
};

}  // namespace umbrage::shadow

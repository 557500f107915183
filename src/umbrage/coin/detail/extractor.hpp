#pragma once

#include <Inventor/SbMatrix.h>
#include <Inventor/SbViewportRegion.h>

#include <memory>
#include <optional>
#include <vector>

#include "umbrage/coin/detail/culling.hpp"
#include "umbrage/coin/detail/registry.hpp"
#include "umbrage/coin/detail/shape_triangles.hpp"
#include "umbrage/scene/light.hpp"

class SoPath;
class SoState;

namespace umbrage::coin::detail {

/// A shape at one of its places.
struct PlacedShape {
  std::shared_ptr<const ShapeTriangles> triangles;
  Mat4 toWorld{1.0};
  bool casts = true;
  Culled culled = Culled::none;
  friend bool operator==(const PlacedShape&, const PlacedShape&) = default;
};

/// Beyond this coordinate the shadows of all others would suffer.
inline constexpr double kMostReach = 1e15;

/// What a shape can lose to shadows.
struct Receiver {
  bool shadowed = true;               ///< false: it is drawn in full light, as its SoShadowStyle says
  std::vector<const SoNode*> lights;  ///< those before it, which alone can light it
};

struct PlacedLight {
  SoNode* node = nullptr;
  scene::Light light;  ///< in world coordinates
};

/// How the shapes are seen.
struct Sight {
  SbMatrix viewing, projection;
  SbViewportRegion viewport;
};
/// As OpenGL has it. `cameraToWorld`: the model matrix where the camera stands. None without a camera.
[[nodiscard]] std::optional<Sight> sightAt(SoState* state, const Mat4& cameraToWorld);

/// A scene graph at one moment.
struct Scan {
  std::vector<PlacedShape> shapes;  ///< those with triangles, in the order of the graph
  std::vector<Receiver> receivers;  ///< per shape
  std::vector<PlacedLight> lights;  ///< those that shine and cast
  std::vector<SoNode*> manifold;    ///< lights that stand at several places, which are not in `lights`
  std::optional<Sight> sight;       ///< of the first shape; none without a camera before it
  Mat4 cameraToWorld{1.0};          ///< the model matrix where the camera of that stands
  bool ownCamera = false;           ///< a camera stands inside, before the first shape
  bool ownStereo = false;           ///< and it is set to one eye of two
  std::size_t broken = 0;           ///< shapes left out, since they name points that they do not have
  std::size_t beyond = 0;           ///< shapes left out, since they reach beyond all measure
  std::size_t lightsDropped = 0;    ///< by Coin, where most shine at once, for OpenGL has no more
  std::size_t otherwiseSeen = 0;    ///< lit shapes left out, since they are seen by another camera than the first shape
};

struct ScanRequest {
  const SoPath* path = nullptr;  ///< down to the node whose shapes and lights are wanted
  SbViewportRegion viewport;
  const Registry* registry = nullptr;
  bool hasGlx =
      false;  ///< GLX works here: Coin makes a context with it to take NURBS apart, and dies where there is none
  int transparencyType = 0;    ///< SoGLRenderAction's, where no SoTransparencyType says another
  std::size_t mostLights = 8;  ///< that OpenGL has
};

/// Reads scene graphs, and keeps the triangles of shapes for as long as Coin's own rules for its caches say that they stay the same: the shape's
/// node id, and the elements of the state that it read. A shape that only stands elsewhere is not read again.
class Extractor {
 public:
  Extractor();
  Extractor(const Extractor&) = delete;
  Extractor& operator=(const Extractor&) = delete;
  ~Extractor();

  [[nodiscard]] Scan scan(const ScanRequest& request);

  /// All shapes in or below `node` are read anew with the next scan.
  void forget(const SoNode* node);

  /// Shapes that were read so far.
  [[nodiscard]] std::size_t extractions() const;
  /// Shapes whose triangles are kept, once for each state that they were read in.
  [[nodiscard]] std::size_t kept() const;

 private:
  class Traversal;
  class Memory;
  std::unique_ptr<Memory> memory_;
  std::vector<const SoNode*> forgotten_;
};

}  // namespace umbrage::coin::detail

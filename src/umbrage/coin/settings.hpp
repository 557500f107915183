#pragma once

#include <cstddef>
#include <optional>

namespace umbrage::coin {

/// Who computes the shadows. No pixel far from a true edge depends on it.
enum class Method {
  automatic,  ///< z-pass on a graphics card; without one, our own rasteriser and rays on the processor
  zPass,      ///< stencil shadow volumes counted before the surfaces, by OpenGL
  zFail,      ///< stencil shadow volumes counted behind the surfaces, by OpenGL
  rayTraced   ///< a ray from every pixel to the light, on the processor: the truth the others are judged by
};

enum class SceneType {
  withoutShadows,  ///< the scene as Coin draws it
  withShadows,
  visibleVolumes  ///< with shadows, and the shadow volumes drawn translucent over the scene
};

/// What triangles that let light through do to it. Those that are fully transparent never cast.
enum class TransparentCasters {
  none,   ///< they cast nothing
  opaque  ///< they cast as if they were opaque
};

/// How shadows are to be made.
struct Settings {
  Method method = Method::automatic;
  SceneType sceneType = SceneType::withShadows;
  TransparentCasters transparentCasters = TransparentCasters::none;
  /// How far volumes that are drawn or written reach from the caster, in scene units; none: to infinity, and in files three times as far
  /// as the scene is wide. Shadows themselves have no such end.
  std::optional<double> volumeDepth;
};

/// What had to be worked out since the beginning, and what had not.
struct Work {
  std::size_t frames = 0;          ///< pictures with shadows
  std::size_t extractions = 0;     ///< shapes whose triangles were asked of Coin
  std::size_t poses = 0;           ///< shapes that only moved
  std::size_t geometryBuilds = 0;  ///< times the casters of the world were put together
  std::size_t shades = 0;  ///< times shadows were computed; a picture of which nothing changed takes the last ones
  /// Times what the camera sees was found for them. On the processor, where only a light moved, it is known.
  std::size_t views = 0;
  std::size_t volumes = 0;        ///< volumes extruded, to be drawn or written
  std::size_t volumesReused = 0;  ///< volumes that were there already, perhaps at another place
};

}  // namespace umbrage::coin

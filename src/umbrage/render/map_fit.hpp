#pragma once

#include <optional>
#include <vector>

#include "umbrage/render/seen_receivers.hpp"
#include "umbrage/scene/light.hpp"

namespace umbrage::render {

/// How points become texels of one shadow map: it covers what is seen, faces the light and may lie behind a caster, and no more.
struct MapView {
  /// From (position - eye, 1) to clip coordinates. The map is -1..1; depths are 0..1, of what is seen, and greater nearer to the light.
  Mat4 toMap{1.0};
  HalfSpace drawn{0.0, 0.0, 0.0, 1.0};  ///< casters are cut off outside of it
  /// So many texels a side make a texel no larger than a pixel at 9 of 10 samples of the picture; 0: there are none.
  double texelsForPicture = 0.0;
};

/// All maps of a light; none where nothing that is seen can lie in shadow.
struct MapFit {
  std::vector<MapView> maps;
  /// Pixels that a texel is wide, on average over the samples of the picture, if every map were one texel: what a map of n x n divides by n.
  double pixelsPerTexel = 0.0;
  /// Of perspective maps: how far the virtual eye lies behind the true one; none where uniform maps serve better.
  std::optional<double> movedBack = {};
};

struct MapRequest {
  const scene::Surfaces& surfaces;
  const View& view;
  const scene::Camera& camera;
  const SeenReceivers& receivers;
  const scene::Light& light;             ///< without extent
  std::span<const std::uint8_t> facing;  ///< shadow::visibleSideFacesLight
};

/// One map of parallel rays for a direction, one for a spot, six (fewer where nothing is to be seen) around a lamp or a wide spot.
/// Source: L. Williams, casting curved shadows on curved surfaces, 1978.
[[nodiscard]] MapFit uniformMaps(const MapRequest& request);

/// Maps of the scene as the perspective of a virtual camera distorts it, so that texels are small where pixels are. That camera looks as the true
/// one does, from so far behind it that all receivers and the casters before them lie in front of it; of all such places that one is taken which gives the smallest texels
/// for the picture, or none. A light behind the virtual camera sees the order of things turned around.
/// Source: M. Stamminger and G. Drettakis, perspective shadow maps, 2002.
[[nodiscard]] MapFit perspectiveMaps(const MapRequest& request);

}  // namespace umbrage::render

#pragma once

#include "umbrage/shadow/technique.hpp"

namespace umbrage::render {

/// What becomes of counts that 8 bits of stencil cannot hold.
enum class Overflow {
  none,       ///< they do not come up: casters that may are counted in groups (shadow::groupLayers)
  wraps,      ///< 256 is 0: what is in so many shadows is lit
  saturates,  ///< as on cards before 2002: all that counts up is drawn first and stops at 255, then what counts down
};

/// What is done to draw less of the volumes. Nothing here but `overflow` changes a pixel of a shadow.
struct VolumeOptions {
  /// Volumes end behind the receivers and the eye (shadow::reachWithin) instead of at infinity.
  bool finite = true;
  /// Casters wholly in the shadow of a convex one are left out (shadow::findHiddenCasters).
  bool hiddenCasters = true;
  /// Volumes, and for z-pass single sides, that lie behind all receivers are left out (ReceiverTiles).
  bool hiddenParts = true;
  /// Both faces are counted in one pass. Without, as on cards before 2003, the volumes are drawn twice, with one face culled: for comparison.
  bool twoSided = true;
  /// Where the driver can (gl::Quirks::depthBounds), nothing is drawn over pixels whose depth no volume of the light reaches.
  bool depthBounds = true;
  /// Wrong on purpose unless none: to show what the first engines had to live with.
  Overflow overflow = Overflow::none;
  shadow::Extrusion extrusion = shadow::Extrusion::vertexShader;
};

/// Infinite volumes of all casters, as the textbooks have them.
inline constexpr VolumeOptions kPlainVolumes{
    .finite = false, .hiddenCasters = false, .hiddenParts = false, .depthBounds = false};

}  // namespace umbrage::render

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "umbrage/shadow/technique.hpp"

class SoNode;

namespace umbrage::coin {

/// A light of the last picture, and where it reaches.
struct LightShadow {
  const SoNode* node = nullptr;  ///< the light node; to be compared only, it may be gone
  scene::Light light;            ///< in world coordinates, as it was
  shadow::LightMask mask;        ///< one pixel a pixel of the viewport, row 0 at the top
  /// The same without a spot light's cone: what the picture is put together by, since OpenGL fades the light at the cone itself, by the shapes' corners.
  shadow::LightMask reach;
};

/// What the shadows of the last picture were made from, and what they are.
struct ShadowReport {
  std::shared_ptr<const shadow::Geometry>
      geometry;  ///< all surfaces that light stops at, in world coordinates; null before the first picture
  /// Per triangle of it, 1 where it casts but is looked through: it lets light through, or Coin culls the side that it shows. Empty: all are seen.
  std::vector<std::uint8_t> unseen;
  std::optional<scene::Camera> camera;  ///< none where no pinhole camera says it: parallel, shifted and stretched views
  std::vector<LightShadow> lights;      ///< in the order in which Coin meets them
  std::size_t passes = 0;               ///< times Coin drew the scene
  /// Milliseconds of wall clock: "scene" (what changed is asked of Coin), "geometry" (put together), "prepare" (what the method builds for a geometry),
  /// "shadows", "sets" (which pixels the same lights reach), "stencil" (their numbers are written into it), "drawing" (Coin's passes). What needed not
  /// be done is not there; drawing is not waited for.
  std::vector<shadow::PhaseTime> phases;
  std::string method;  ///< as Umbrage names it: "hybrid_cpu"
};

}  // namespace umbrage::coin

#pragma once

#include <memory>
#include <span>

#include "umbrage/gl/context.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::render {

struct OverlayOptions {
  bool volumes = false;     ///< the sides of the shadow volumes, translucent, fading out away from the caster
  bool silhouette = false;  ///< the edges that the volumes hang on
};

/// The picture with what the shadows are made of drawn over it, each light in its own colour, hidden behind surfaces as
/// real bodies would be. For looking at, not for measuring: volumes end where they leave the scene, or fade out.
/// `context`: null makes a headless one for the occasion. REQUIRES: the picture is of the camera's size.
/// Errors: ErrorCode::device.
[[nodiscard]] Result<image::RgbImage> drawOverlay(const image::RgbImage& picture, const shadow::Geometry& geometry,
                                                  const scene::Camera& camera, std::span<const scene::Light> lights,
                                                  const OverlayOptions& options,
                                                  std::shared_ptr<gl::Context> context = nullptr);

}  // namespace umbrage::render

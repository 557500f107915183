#pragma once

#include <optional>
#include <vector>

#include "umbrage/render/run_passes.hpp"
#include "umbrage/render/technique.hpp"

namespace umbrage::render {

// What techniques that draw into a GpuFrame share: data of a frame and of its lights on the graphics card, and what comes back from it.

/// Struct Material of the shaders.
struct MaterialRow {
  Vec4f colour;    ///< linear; w: opacity
  Vec4f emission;  ///< linear
  Vec4f passing;   ///< what of the light passes it
};
[[nodiscard]] std::vector<MaterialRow> materialRows(std::span<const scene::Material> materials);

/// Makes `frame` one of this size, if it is not. Errors: those of GpuFrame::make.
[[nodiscard]] Result<void> fit(std::optional<GpuFrame>& frame, int width, int height);

/// What no light changes.
struct FrameData {
  gl::Buffer view, shading, materials;
};
/// `options`: of the picture; null: only masks are wanted.
[[nodiscard]] Result<void> upload(FrameData& data, const View& view, const Vec3& origin, const scene::Camera& camera,
                                  const PictureOptions* options);

/// What the passes over the screen need to know of a light. Gives shadow::visibleSideFacesLight.
[[nodiscard]] Result<std::vector<std::uint8_t>> upload(GpuLight& gpu, const scene::Surfaces& surfaces, const View& view,
                                                       const scene::Camera& camera, const scene::Light& light);

/// What the camera sees, as the graphics card has it: depths are not distances yet.
[[nodiscard]] shadow::SurfaceBuffer readSurface(const gl::HostScope& scope, const GpuFrame& frame);

/// The masks of the first `lights` lights, and what the camera sees; `seen`: readSurface().
void readMasks(const gl::HostScope& scope, const GpuFrame& frame, const View& view, std::size_t lights,
               shadow::SurfaceBuffer seen, shadow::Shading& out);

}  // namespace umbrage::render

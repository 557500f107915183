#pragma once

#include "umbrage/base/error.hpp"
#include "umbrage/scene/camera.hpp"
#include "umbrage/shadow/surface_buffer.hpp"
#include "umbrage/trace/occlusion.hpp"

namespace umbrage::trace {

/// What the camera sees through the centre of each pixel. Depths come from the triangles' planes in double precision.
/// Errors: ErrorCode::device when memory runs out.
[[nodiscard]] Result<shadow::SurfaceBuffer> visibleSurfaces(const Occlusion& occlusion, const scene::Camera& camera);

}  // namespace umbrage::trace

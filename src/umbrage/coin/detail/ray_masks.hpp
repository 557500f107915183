#pragma once

#include <cstdint>

#include "umbrage/coin/detail/world.hpp"
#include "umbrage/shadow/light_mask.hpp"
#include "umbrage/trace/occlusion.hpp"

namespace umbrage::coin::detail {

/// What a view sees: per pixel a triangle (shadow::kNoTriangle: none) and the point of the world, relative to the origin of the surfaces.
struct SeenPoints {
  image::Image<std::uint32_t> triangle;
  image::Image<Vec3> point;
};

/// By rays from the near plane, in double precision. `where`: the pixels that are wanted, others see nothing; null: all.
/// Errors: ErrorCode::device when memory runs out.
[[nodiscard]] Result<SeenPoints> look(const trace::Occlusion& occlusion, const View& view, const Unseen& unseen,
                                      const image::GreyImage* where = nullptr);

/// By rays from the points seen to the light. For views that no technique takes, and for casters that are not seen.
/// Errors: ErrorCode::device when memory runs out.
[[nodiscard]] Result<shadow::LightMask> rayMask(const trace::Occlusion& occlusion, const View& view,
                                                const SeenPoints& seen, const scene::Light& light);

/// Makes the mask dark outside a spot light's cone. `triangle`: what each pixel sees.
void cutCone(shadow::LightMask& mask, const scene::Light& light, const View& view, const scene::Surfaces& surfaces,
             const image::Image<std::uint32_t>& triangle);

}  // namespace umbrage::coin::detail

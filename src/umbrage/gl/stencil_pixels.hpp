#pragma once

#include <cstdint>
#include <span>

#include "umbrage/base/error.hpp"
#include "umbrage/gl/host_scope.hpp"
#include "umbrage/gl/pass_state.hpp"

namespace umbrage::gl {

/// Writes stencil values into a host's framebuffer: one a pixel of `where`, for all its samples, row by row from the bottom.
/// REQUIRES: values.size() == where.width * where.height, both above 0.
/// Errors: ErrorCode::device in a core context, for a framebuffer of one sample a pixel; with more, while a display list is made, or when memory
/// is short.
[[nodiscard]] Result<void> writeStencil(HostScope& scope, std::span<const std::uint8_t> values, const Rect& where);

/// The stencil becomes `value` in the rectangle.
void fillStencil(HostScope& scope, std::uint8_t value, const Rect& where);

}  // namespace umbrage::gl

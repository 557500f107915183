#pragma once

#include <cstdint>
#include <span>

#include "umbrage/base/error.hpp"
#include "umbrage/gl/host_scope.hpp"
#include "umbrage/gl/pass_state.hpp"

namespace umbrage::gl {

/// Writes stencil values into a host's framebuffer: one a pixel of `where`, row by row from the bottom. The compatibility profile alone can do so
/// without a shader that counts bits.
/// REQUIRES: values.size() == where.width * where.height, both above 0.
/// Errors: ErrorCode::device in a core context.
[[nodiscard]] Result<void> writeStencil(HostScope& scope, std::span<const std::uint8_t> values, const Rect& where);

/// The stencil becomes `value` in the rectangle.
void fillStencil(HostScope& scope, std::uint8_t value, const Rect& where);

}  // namespace umbrage::gl

#pragma once

#include <cstdint>
#include <vector>

#include "umbrage/gl/objects.hpp"
#include "umbrage/gl/pass_state.hpp"
#include "umbrage/gl/program.hpp"

namespace umbrage::coin::detail {

/// Writes codes of pixels into the stencil of a host's framebuffer. REQUIRES: its context is current when it is made, used and dies.
class Stamp {
 public:
  Stamp();
  /// The stencil becomes `values`, row by row from the bottom, inside the viewport. The host's state is left as it was.
  /// Errors: ErrorCode::device when the framebuffer has fewer than 8 bits of stencil or no depth, or memory is short.
  [[nodiscard]] Result<void> write(const std::vector<std::uint8_t>& values, const gl::Rect& viewport);
  /// The stencil becomes 0 there.
  static void clear(const gl::Rect& viewport);

 private:
  gl::Program program_;
  gl::Buffer codes_, place_;
  gl::VertexArray nothing_;
};

/// Errors: ErrorCode::device when the current context, or the framebuffer that is bound, cannot take shadows.
[[nodiscard]] Result<void> checkTarget();

}  // namespace umbrage::coin::detail

#pragma once

#include <array>
#include <cstdint>

#include "umbrage/gl/host_scope.hpp"
#include "umbrage/gl/objects.hpp"
#include "umbrage/gl/pass_state.hpp"
#include "umbrage/gl/program.hpp"

namespace umbrage::gl {

/// One pass: applies a whole PassState to a target, draws, and returns to the house baseline.
/// REQUIRES: lives inside `scope`; passes do not nest (checked).
class Pass {
 public:
  Pass(HostScope& scope, const Framebuffer& target, const PassState& state);
  /// Into a framebuffer that the host owns (0: its window).
  Pass(HostScope& scope, unsigned hostFramebuffer, const PassState& state);
  Pass(const Pass&) = delete;
  Pass& operator=(const Pass&) = delete;
  ~Pass();

  // Clears obey the scissor, and the write masks of the state.
  void clearColour(const std::array<float, 4>& value);
  void clearIds(std::uint32_t value);
  void clearDepth(float value);
  void clearStencil(std::uint8_t value);

  void use(const Program& program);
  void uniforms(unsigned slot, const Buffer& buffer);
  void storage(unsigned slot, const Buffer& buffer);
  void texture(unsigned slot, const Texture& texture);
  /// Triangles by 32-bit indices.
  void drawIndexed(const VertexArray& vertices, std::size_t firstIndex, std::size_t indexCount);
  /// Triangles without a buffer.
  void draw(const VertexArray& vertices, std::size_t vertexCount);

 private:
  HostScope& scope_;
};

/// Waits until everything drawn so far is done: for timing by the wall clock.
void finish();

}  // namespace umbrage::gl

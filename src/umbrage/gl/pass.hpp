#pragma once

#include <array>
#include <cstdint>

#include "umbrage/gl/host_scope.hpp"
#include "umbrage/gl/objects.hpp"
#include "umbrage/gl/pass_state.hpp"
#include "umbrage/gl/program.hpp"

namespace umbrage::gl {

enum class Primitive { triangles, lines };

/// One draw whose size a shader has written: a buffer of these is what Pass::drawIndirect reads.
struct IndirectDraw {
  std::uint32_t count = 0;  ///< of indices
  std::uint32_t instances = 1;
  std::uint32_t firstIndex = 0;
  std::int32_t baseVertex = 0;
  std::uint32_t baseInstance = 0;
};

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
  void clearColour(const std::array<float, 4>& value, int picture = 0);
  void clearIds(std::uint32_t value);
  void clearDepth(float value);
  void clearStencil(std::uint8_t value);

  void use(const Program& program);
  void uniforms(unsigned slot, const Buffer& buffer);
  void storage(unsigned slot, const Buffer& buffer);
  void texture(unsigned slot, const Texture& texture);
  /// By 32-bit indices.
  void drawIndexed(const VertexArray& vertices, std::size_t firstIndex, std::size_t indexCount,
                   Primitive primitive = Primitive::triangles);
  /// The same with the numbers of entry `which` of a buffer of IndirectDraw; sees what Compute wrote.
  void drawIndirect(const VertexArray& vertices, const Buffer& draws, std::size_t which,
                    Primitive primitive = Primitive::triangles);
  /// What shaders of this pass wrote into storage is seen by those of later passes, by Compute and by Buffer::read.
  void publishStorage();
  /// Triangles without a buffer.
  void draw(const VertexArray& vertices, std::size_t vertexCount);

 private:
  HostScope& scope_;
};

/// Waits until everything drawn so far is done: for timing by the wall clock.
void finish();

}  // namespace umbrage::gl

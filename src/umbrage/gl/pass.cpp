#include "umbrage/gl/pass.hpp"

#include <epoxy/gl.h>

#include <algorithm>

#include "umbrage/base/check.hpp"

namespace umbrage::gl {
namespace {

// Draw calls count in signed 32-bit numbers; longer lists go in pieces, cut between triangles and between lines.
constexpr std::size_t kMostIndicesPerDraw = std::size_t{3} << 28;

GLenum code(Compare compare) {
  switch (compare) {
    case Compare::never: return GL_NEVER;
    case Compare::less: return GL_LESS;
    case Compare::lessOrEqual: return GL_LEQUAL;
    case Compare::equal: return GL_EQUAL;
    case Compare::notEqual: return GL_NOTEQUAL;
    case Compare::greater: return GL_GREATER;
    case Compare::greaterOrEqual: return GL_GEQUAL;
    case Compare::always: return GL_ALWAYS;
  }
  return GL_ALWAYS;
}

GLenum code(StencilOp op) {
  switch (op) {
    case StencilOp::keep: return GL_KEEP;
    case StencilOp::increment: return GL_INCR_WRAP;
    case StencilOp::decrement: return GL_DECR_WRAP;
    case StencilOp::replace: return GL_REPLACE;
    case StencilOp::incrementToLimit: return GL_INCR;
    case StencilOp::decrementToLimit: return GL_DECR;
  }
  return GL_KEEP;
}

GLenum code(Primitive primitive) { return primitive == Primitive::lines ? GL_LINES : GL_TRIANGLES; }

void turn(GLenum what, bool on) { on ? glEnable(what) : glDisable(what); }

void apply(const DepthState& depth) {
  turn(GL_DEPTH_TEST, depth.test);
  turn(GL_DEPTH_CLAMP, depth.clamp);
  glDepthFunc(code(depth.pass));
  glDepthMask(depth.write ? GL_TRUE : GL_FALSE);
}

void apply(const StencilState& stencil) {
  turn(GL_STENCIL_TEST, stencil.test);
  glStencilMask(stencil.writeMask);
  glStencilFunc(code(stencil.compare), stencil.reference, stencil.readMask);
  glStencilOpSeparate(GL_FRONT, GL_KEEP, code(stencil.front.depthFail), code(stencil.front.pass));
  glStencilOpSeparate(GL_BACK, GL_KEEP, code(stencil.back.depthFail), code(stencil.back.pass));
}

void applyColour(const PassState& state) {
  UMBRAGE_CHECK(state.colourTargets >= 1 && state.colourTargets <= kColourTargets, "HostScope does not save so many");
  const GLboolean write = state.colourWrite ? GL_TRUE : GL_FALSE;
  for (GLuint i = 0; i < static_cast<GLuint>(state.colourTargets); ++i) {
    state.blend == Blend::off ? glDisablei(GL_BLEND, i) : glEnablei(GL_BLEND, i);
    glBlendEquationi(i, GL_FUNC_ADD);
    glBlendFunci(i, GL_ONE, state.blend == Blend::over ? GL_ONE_MINUS_SRC_ALPHA : GL_ONE);
    glColorMaski(i, write, write, write, write);
  }
}

// The extension's state is left alone where there is none.
void applyBounds(const std::optional<std::array<float, 2>>& bounds, bool known) {
  UMBRAGE_CHECK(known || !bounds, "this driver knows no depth bounds");
  if (!known) return;
  turn(GL_DEPTH_BOUNDS_TEST_EXT, bounds.has_value());
  if (bounds) glDepthBoundsEXT(double((*bounds)[0]), double((*bounds)[1]));
}

void apply(const PassState& state, bool knowsDepthBounds) {
  applyBounds(state.depthBounds, knowsDepthBounds);
  apply(state.depth);
  apply(state.stencil);
  applyColour(state);
  turn(GL_CULL_FACE, state.cullBack);
  UMBRAGE_CHECK(state.clipDistances >= 0 && state.clipDistances <= kMostClipDistances, "so many clip distances");
  for (int i = 0; i < kMostClipDistances; ++i)
    turn(GL_CLIP_DISTANCE0 + static_cast<GLenum>(i), i < state.clipDistances);
  glFrontFace(state.frontIsClockwise ? GL_CW : GL_CCW);
  glClipControl(state.clipOrigin == ClipOrigin::lowerLeft ? GL_LOWER_LEFT : GL_UPPER_LEFT,
                state.clipDepth == ClipDepth::zeroToOne ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
  glDepthRangeIndexed(0, double(state.depthRange[0]), double(state.depthRange[1]));
  const Rect& v = state.viewport;
  glViewportIndexedf(0, float(v.x), float(v.y), float(v.width), float(v.height));
  // The scissor is always on: clears are not bounded by the viewport, and a host may share the framebuffer.
  const Rect s = state.scissor ? intersect(*state.scissor, v) : v;
  glEnablei(GL_SCISSOR_TEST, 0);
  glScissorIndexed(0, s.x, s.y, s.width, s.height);
}

}  // namespace

Pass::Pass(HostScope& scope, const Framebuffer& target, const PassState& state) : Pass(scope, target.name(), state) {}

Pass::Pass(HostScope& scope, unsigned hostFramebuffer, const PassState& state) : scope_(scope) {
  UMBRAGE_CHECK(!scope.inPass_, "passes do not nest");
  scope.inPass_ = true;
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, hostFramebuffer);
  apply(state, scope.knowsDepthBounds());
}

Pass::~Pass() {
  apply(PassState{}, scope_.knowsDepthBounds());
  glUseProgram(0);
  glBindVertexArray(0);
  scope_.inPass_ = false;
}

void Pass::clearColour(const std::array<float, 4>& value, int picture) {
  glClearBufferfv(GL_COLOR, picture, value.data());
}

void Pass::clearIds(std::uint32_t value) {
  const std::array<GLuint, 4> all{value, value, value, value};
  glClearBufferuiv(GL_COLOR, 0, all.data());
}

void Pass::clearDepth(float value) { glClearBufferfv(GL_DEPTH, 0, &value); }

void Pass::clearStencil(std::uint8_t value) {
  const GLint wide = value;
  glClearBufferiv(GL_STENCIL, 0, &wide);
}

void Pass::use(const Program& program) { glUseProgram(program.name()); }

void Pass::uniforms(unsigned slot, const Buffer& buffer) {
  UMBRAGE_CHECK(slot < kUniformSlots, "HostScope does not save this slot");
  glBindBufferBase(GL_UNIFORM_BUFFER, slot, buffer.name());
}

void Pass::storage(unsigned slot, const Buffer& buffer) {
  UMBRAGE_CHECK(slot < kStorageSlots, "HostScope does not save this slot");
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, slot, buffer.name());
}

void Pass::texture(unsigned slot, const Texture& texture) {
  UMBRAGE_CHECK(slot < kTextureSlots, "HostScope does not save this slot");
  glBindTextureUnit(slot, texture.name());
}

void Pass::drawIndexed(const VertexArray& vertices, std::size_t firstIndex, std::size_t indexCount,
                       Primitive primitive) {
  glBindVertexArray(vertices.name());
  for (std::size_t done = 0; done < indexCount; done += kMostIndicesPerDraw) {
    const auto count = static_cast<GLsizei>(std::min(kMostIndicesPerDraw, indexCount - done));
    const auto* offset = reinterpret_cast<const void*>((firstIndex + done) * sizeof(std::uint32_t));
    glDrawElements(code(primitive), count, GL_UNSIGNED_INT, offset);
  }
}

void Pass::drawIndirect(const VertexArray& vertices, const Buffer& draws, std::size_t which, Primitive primitive) {
  UMBRAGE_CHECK((which + 1) * sizeof(IndirectDraw) <= draws.bytes(), "no such draw");
  glBindVertexArray(vertices.name());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, draws.name());
  glDrawElementsIndirect(code(primitive), GL_UNSIGNED_INT, reinterpret_cast<const void*>(which * sizeof(IndirectDraw)));
}

void Pass::publishStorage() { glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT); }

void Pass::draw(const VertexArray& vertices, std::size_t vertexCount) {
  glBindVertexArray(vertices.name());
  if (vertexCount > 0) glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertexCount));
}

void finish() { glFinish(); }

}  // namespace umbrage::gl

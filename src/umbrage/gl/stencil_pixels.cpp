#include "umbrage/gl/stencil_pixels.hpp"

#include <epoxy/gl.h>
#include <umbrage_shaders/stencil_bit_frag.hpp>
#include <umbrage_shaders/stencil_bit_vert.hpp>

#include <array>
#include <functional>
#include <numeric>
#include <vector>

#include "umbrage/base/check.hpp"
#include "umbrage/gl/pass.hpp"

namespace umbrage::gl {
namespace {

PassState stateFor(const Rect& where) {
  PassState state;
  state.viewport = where;
  return state;
}

bool isCompatible() {
  GLint profile = 0;
  glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
  return (profile & GL_CONTEXT_COMPATIBILITY_PROFILE_BIT) != 0;
}

bool hasSamples(HostScope& scope) {
  const Pass pass(scope, scope.hostFramebuffer(), {});
  GLint samples = 0;
  glGetIntegerv(GL_SAMPLES, &samples);
  return samples > 1;
}

bool isRecorded() {
  GLint list = 0;
  glGetIntegerv(GL_LIST_INDEX, &list);
  return list != 0;
}

// Four values a word.
std::vector<std::uint32_t> packed(std::span<const std::uint8_t> values) {
  std::vector<std::uint32_t> words((values.size() + 3) / 4);
  for (std::size_t i = 0; i < values.size(); ++i) words[i / 4] |= std::uint32_t{values[i]} << (i % 4 * 8);
  return words;
}

PassState stateForBit(const Rect& where, int bit) {
  PassState state = stateFor(where);
  state.stencil.test = true;
  state.stencil.reference = 0xff;
  state.stencil.writeMask = static_cast<std::uint8_t>(1u << bit);
  state.stencil.front.pass = state.stencil.back.pass = StencilOp::replace;
  return state;
}

// Pixels that are drawn reach all samples, so every bit is drawn by itself.
Result<void> writeSamples(HostScope& scope, std::span<const std::uint8_t> values, const Rect& where) {
  const Program program(shaders::kStencilBitVert, shaders::kStencilBitFrag);
  const VertexArray none;
  Buffer words, parameters;
  if (auto done = words.setAll(packed(values)); !done) return done;
  const std::uint8_t used = std::accumulate(values.begin(), values.end(), std::uint8_t{0}, std::bit_or<std::uint8_t>());
  fillStencil(scope, 0, where);
  for (int bit = 0; bit < 8; ++bit) {
    if ((used >> bit & 1) == 0) continue;
    const std::array<std::int32_t, 4> here{where.x, where.y, where.width, bit};
    if (auto done = parameters.setOne(here); !done) return done;
    Pass pass(scope, scope.hostFramebuffer(), stateForBit(where, bit));
    pass.use(program);
    pass.storage(0, words);
    pass.uniforms(0, parameters);
    pass.draw(none, 3);
  }
  return {};
}

// Of a framebuffer with samples it reaches one of each pixel.
void writePixels(HostScope& scope, std::span<const std::uint8_t> values, const Rect& where) {
  const Pass pass(scope, scope.hostFramebuffer(), stateFor(where));
  // What HostScope knows nothing of, since no shader is subject to it.
  glPushAttrib(GL_CURRENT_BIT | GL_PIXEL_MODE_BIT);
  glPushClientAttrib(GL_CLIENT_PIXEL_STORE_BIT);
  GLint unpackBuffer = 0;
  glGetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &unpackBuffer);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  for (const GLenum what : {GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_ROWS, GL_UNPACK_LSB_FIRST})
    glPixelStorei(what, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (const GLenum what : {GL_INDEX_SHIFT, GL_INDEX_OFFSET, GL_MAP_STENCIL}) glPixelTransferi(what, 0);
  glPixelZoom(1.0f, 1.0f);
  glWindowPos2i(where.x, where.y);
  glDrawPixels(where.width, where.height, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, values.data());
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, static_cast<GLuint>(unpackBuffer));
  glPopClientAttrib();
  glPopAttrib();
}

}  // namespace

Result<void> writeStencil(HostScope& scope, std::span<const std::uint8_t> values, const Rect& where) {
  UMBRAGE_CHECK(!where.empty() && values.size() == std::size_t(where.width) * std::size_t(where.height), "size");
  const bool compatible = isCompatible();
  if (hasSamples(scope)) {
    if (compatible && isRecorded())
      return fail(ErrorCode::device, "a display list cannot hold what writes a stencil with samples");
    return writeSamples(scope, values, where);
  }
  if (!compatible) return fail(ErrorCode::device, "the context is not of OpenGL's compatibility profile");
  writePixels(scope, values, where);
  return {};
}

void fillStencil(HostScope& scope, std::uint8_t value, const Rect& where) {
  Pass pass(scope, scope.hostFramebuffer(), stateFor(where));
  pass.clearStencil(value);
}

}  // namespace umbrage::gl

#include "umbrage/gl/stencil_pixels.hpp"

#include <epoxy/gl.h>

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

}  // namespace

Result<void> writeStencil(HostScope& scope, std::span<const std::uint8_t> values, const Rect& where) {
  UMBRAGE_CHECK(!where.empty() && values.size() == std::size_t(where.width) * std::size_t(where.height), "size");
  if (!isCompatible()) return fail(ErrorCode::device, "the context is not of OpenGL's compatibility profile");
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
  return {};
}

void fillStencil(HostScope& scope, std::uint8_t value, const Rect& where) {
  Pass pass(scope, scope.hostFramebuffer(), stateFor(where));
  pass.clearStencil(value);
}

}  // namespace umbrage::gl

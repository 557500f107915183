#include "umbrage/gl/stencil_window.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>

namespace umbrage::gl {
namespace {

/// The stencil test of one face.
struct Face {
  GLenum side;
  GLint function = 0, reference = 0, readMask = 0, writeMask = 0, fail = 0, depthFail = 0, pass = 0;

  void save(bool back) {
    glGetIntegerv(back ? GL_STENCIL_BACK_FUNC : GL_STENCIL_FUNC, &function);
    glGetIntegerv(back ? GL_STENCIL_BACK_REF : GL_STENCIL_REF, &reference);
    glGetIntegerv(back ? GL_STENCIL_BACK_VALUE_MASK : GL_STENCIL_VALUE_MASK, &readMask);
    glGetIntegerv(back ? GL_STENCIL_BACK_WRITEMASK : GL_STENCIL_WRITEMASK, &writeMask);
    glGetIntegerv(back ? GL_STENCIL_BACK_FAIL : GL_STENCIL_FAIL, &fail);
    glGetIntegerv(back ? GL_STENCIL_BACK_PASS_DEPTH_FAIL : GL_STENCIL_PASS_DEPTH_FAIL, &depthFail);
    glGetIntegerv(back ? GL_STENCIL_BACK_PASS_DEPTH_PASS : GL_STENCIL_PASS_DEPTH_PASS, &pass);
  }
  void restore() const {
    glStencilFuncSeparate(side, static_cast<GLenum>(function), reference, static_cast<GLuint>(readMask));
    glStencilMaskSeparate(side, static_cast<GLuint>(writeMask));
    glStencilOpSeparate(side, static_cast<GLenum>(fail), static_cast<GLenum>(depthFail), static_cast<GLenum>(pass));
  }
};

}  // namespace

struct StencilWindow::State {
  Face front{GL_FRONT}, back{GL_BACK};
  bool stencilOn = false, scissorOn = false;
  std::array<GLint, 4> scissor{};
};

StencilWindow::StencilWindow(std::uint8_t value, const Rect& where) : state_(std::make_unique<State>()) {
  state_->front.save(false);
  state_->back.save(true);
  state_->stencilOn = glIsEnabled(GL_STENCIL_TEST) == GL_TRUE;
  state_->scissorOn = glIsEnabledi(GL_SCISSOR_TEST, 0) == GL_TRUE;
  glGetIntegeri_v(GL_SCISSOR_BOX, 0, state_->scissor.data());
  const auto& s = state_->scissor;
  const Rect cut = state_->scissorOn ? intersect(where, {s[0], s[1], s[2], s[3]}) : where;
  glEnable(GL_STENCIL_TEST);
  glStencilFunc(GL_EQUAL, value, 0xff);
  glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
  glStencilMask(0);
  glEnablei(GL_SCISSOR_TEST, 0);
  glScissorIndexed(0, cut.x, cut.y, std::max(cut.width, 0), std::max(cut.height, 0));
}

StencilWindow::~StencilWindow() {
  state_->front.restore();
  state_->back.restore();
  if (!state_->stencilOn) glDisable(GL_STENCIL_TEST);
  if (!state_->scissorOn) glDisablei(GL_SCISSOR_TEST, 0);
  const auto& s = state_->scissor;
  glScissorIndexed(0, s[0], s[1], s[2], s[3]);
}

}  // namespace umbrage::gl

#include "coin/stage.hpp"

#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/SoInteraction.h>
#include <Inventor/elements/SoGLCacheContextElement.h>
#include <Inventor/errors/SoDebugError.h>
#include <Inventor/misc/SoContextHandler.h>
#include <Inventor/nodekits/SoNodeKit.h>
#include <epoxy/gl.h>

#include "umbrage/base/check.hpp"
#include "umbrage/coin/exact_shadow_group.hpp"

namespace umbrage::coin::test {

void startCoin() {
  static const bool started = [] {
    SoDB::init();
    SoDB::enableRealTimeSensor(FALSE);  // pictures that are compared are of one moment
    // Coin's own pictures of some files (cubes without normals of their own) change when it makes a cache.
    SoSeparator::setNumRenderCaches(0);
    SoNodeKit::init();
    SoInteraction::init();
    coin::init();
    // Coin asks GLX for what only EGL knows, and says so each time.
    SoDebugError::setHandlerCallback([](const SoError*, void*) {}, nullptr);
    return true;
  }();
  (void)started;
}

Ref<> sceneOf(const std::string& text) {
  startCoin();
  const std::string whole = "#Inventor V2.1 ascii\n" + text;
  SoInput input;
  input.setBuffer(const_cast<char*>(whole.data()), whole.size());
  SoSeparator* root = SoDB::readAll(&input);
  UMBRAGE_CHECK(root != nullptr, "the test's scene cannot be read");
  return hold(root);
}

std::unique_ptr<Stage> Stage::make(int width, int height, bool stencil, int samples) {
  startCoin();
  auto context = gl::Context::createHeadless({.compatibility = true});
  if (!context) return nullptr;
  return std::unique_ptr<Stage>(new Stage(std::move(*context), width, height, stencil, samples));
}

Stage::Stage(std::shared_ptr<gl::Context> context, int width, int height, bool stencil, int samples)
    : context_(std::move(context)),
      current_(std::make_unique<gl::CurrentContext>(context_)),
      width_(width),
      height_(height),
      action_(SbViewportRegion(static_cast<short>(width), static_cast<short>(height))) {
  glCreateFramebuffers(1, &framebuffer_);
  glCreateRenderbuffers(2, buffers_);
  glNamedRenderbufferStorageMultisample(buffers_[0], samples, GL_RGBA8, width, height);
  glNamedRenderbufferStorageMultisample(buffers_[1], samples, stencil ? GL_DEPTH24_STENCIL8 : GL_DEPTH_COMPONENT24,
                                        width, height);
  glNamedFramebufferRenderbuffer(framebuffer_, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers_[0]);
  glNamedFramebufferRenderbuffer(framebuffer_, stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT,
                                 GL_RENDERBUFFER, buffers_[1]);
  if (samples > 0) {
    glCreateFramebuffers(1, &resolved_);
    glCreateRenderbuffers(1, &resolvedBuffer_);
    glNamedRenderbufferStorage(resolvedBuffer_, GL_RGBA8, width, height);
    glNamedFramebufferRenderbuffer(resolved_, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, resolvedBuffer_);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, width, height);
  glEnable(GL_DEPTH_TEST);  // as Coin's viewers do
  action_.setCacheContext(SoGLCacheContextElement::getUniqueCacheContext());
  action_.setTransparencyType(SoGLRenderAction::SORTED_OBJECT_BLEND);
}

Stage::~Stage() {
  enter();
  SoContextHandler::destructingContext(action_.getCacheContext());
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteRenderbuffers(2, buffers_);
  glDeleteFramebuffers(1, &resolved_);
  glDeleteRenderbuffers(1, &resolvedBuffer_);
}

void Stage::enter() {
  current_.reset();
  current_ = std::make_unique<gl::CurrentContext>(context_);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
}

void Stage::clear() {
  glClearColor(0.1f, 0.1f, 0.3f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

void Stage::apply(SoNode* scene) { action_.apply(scene); }

image::RgbaImage Stage::draw(SoNode* scene) {
  clear();
  apply(scene);
  return picture();
}

image::RgbaImage Stage::picture() const {
  image::RgbaImage out(width_, height_);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  if (resolved_ != 0) {
    glBlitNamedFramebuffer(framebuffer_, resolved_, 0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT,
                           GL_NEAREST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_);
  }
  for (int y = 0; y < height_; ++y) glReadPixels(0, height_ - 1 - y, width_, 1, GL_RGBA, GL_UNSIGNED_BYTE, out.row(y));
  if (resolved_ != 0) glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  return out;
}

image::Image<float> Stage::depth() const {
  image::Image<float> out(width_, height_);
  for (int y = 0; y < height_; ++y)
    glReadPixels(0, height_ - 1 - y, width_, 1, GL_DEPTH_COMPONENT, GL_FLOAT, out.row(y));
  return out;
}

}  // namespace umbrage::coin::test

#pragma once

#include <functional>
#include <memory>
#include <string>

#include "umbrage/base/error.hpp"
#include "umbrage/gl/quirks.hpp"

namespace umbrage::gl {

struct ContextOptions {
  bool debug = false;                        ///< ask for a debug context, so that DebugLog hears everything
  bool compatibility = false;                ///< the compatibility profile, as older hosts need
  std::function<void(Quirks&)> adjust = {};  ///< says what the driver is to be taken for: for tests
};

/// For programs that bring their own context. Errors: ErrorCode::device when none is current or it is older than OpenGL 4.5.
[[nodiscard]] Result<void> checkCurrentContext();

/// Whether the current context was made by EGL, and not by GLX or another.
[[nodiscard]] bool currentIsEgl();

/// An OpenGL 4.5 core context without a window, through EGL.
class Context {
 public:
  /// Tries hardware devices first, then Mesa's surfaceless platform, then software devices.
  /// Errors: ErrorCode::device, with what each of them answered.
  [[nodiscard]] static Result<std::shared_ptr<Context>> createHeadless(const ContextOptions& options = {});

  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context();

  [[nodiscard]] const std::string& renderer() const { return renderer_; }
  [[nodiscard]] const Quirks& quirks() const { return quirks_; }
  [[nodiscard]] bool isSoftware() const { return quirks_.software; }

 private:
  friend class CurrentContext;
  Context(void* display, void* context) : display_(display), context_(context) {}
  void* display_;
  void* context_;
  std::string renderer_;
  Quirks quirks_;
};

/// Makes a context current in this thread and gives back, at the end, the one that was current before.
/// A null context means "the caller's own": nothing changes. REQUIRES then: an OpenGL 4.5 context is current.
class CurrentContext {
 public:
  explicit CurrentContext(const std::shared_ptr<Context>& context);
  CurrentContext(const CurrentContext&) = delete;
  CurrentContext& operator=(const CurrentContext&) = delete;
  ~CurrentContext();

 private:
  std::shared_ptr<Context> context_;
  void* oldDisplay_ = nullptr;
  void* oldContext_ = nullptr;
  void* oldDraw_ = nullptr;
  void* oldRead_ = nullptr;
};

}  // namespace umbrage::gl

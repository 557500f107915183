#include "umbrage/gl/context.hpp"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>
#include <cstring>
#include <vector>

#include "umbrage/base/check.hpp"

namespace umbrage::gl {
namespace {

bool hasWord(const char* list, const char* word) {
  if (list == nullptr) return false;
  const std::size_t length = std::strlen(word);
  for (const char* at = std::strstr(list, word); at != nullptr; at = std::strstr(at + length, word))
    if ((at == list || at[-1] == ' ') && (at[length] == ' ' || at[length] == '\0')) return true;
  return false;
}

struct Candidate {
  std::string name;
  EGLenum platform;
  void* native;
};

// Devices that are hardware, the surfaceless platform, devices that are software: in the order in which they are tried.
std::vector<Candidate> candidates(const char* extensions) {
  std::vector<Candidate> hardware, software;
  if (hasWord(extensions, "EGL_EXT_platform_device") && hasWord(extensions, "EGL_EXT_device_enumeration")) {
    std::array<EGLDeviceEXT, 32> devices{};
    EGLint count = 0;
    if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count) != EGL_TRUE) count = 0;
    for (EGLint i = 0; i < count; ++i) {
      const char* own = eglQueryDeviceStringEXT(devices[i], EGL_EXTENSIONS);
      auto& list = hasWord(own, "EGL_MESA_device_software") ? software : hardware;
      list.push_back({"EGL device " + std::to_string(i), EGL_PLATFORM_DEVICE_EXT, devices[i]});
    }
  }
  if (hasWord(extensions, "EGL_MESA_platform_surfaceless"))
    hardware.push_back({"surfaceless Mesa", EGL_PLATFORM_SURFACELESS_MESA, nullptr});
  hardware.insert(hardware.end(), software.begin(), software.end());
  return hardware;
}

struct Handles {
  EGLDisplay display;
  EGLContext context;
};

Result<Handles> open(const Candidate& candidate, const ContextOptions& options) {
  const EGLDisplay display = eglGetPlatformDisplayEXT(candidate.platform, candidate.native, nullptr);
  if (display == EGL_NO_DISPLAY) return fail(ErrorCode::device, "no display", candidate.name);
  if (eglInitialize(display, nullptr, nullptr) != EGL_TRUE)
    return fail(ErrorCode::device, "EGL does not start", candidate.name);
  // Without a window no configuration is needed, but a display that cannot do without is left to the next candidate.
  const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
  if (!hasWord(extensions, "EGL_KHR_surfaceless_context") || !hasWord(extensions, "EGL_KHR_no_config_context"))
    return fail(ErrorCode::device, "cannot draw without a window", candidate.name);
  const EGLenum oldApi = eglQueryAPI();
  if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return fail(ErrorCode::device, "knows no OpenGL", candidate.name);
  const std::array<EGLint, 9> wanted{
      EGL_CONTEXT_MAJOR_VERSION,
      4,
      EGL_CONTEXT_MINOR_VERSION,
      5,
      EGL_CONTEXT_OPENGL_PROFILE_MASK,
      options.compatibility ? EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT : EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
      EGL_CONTEXT_OPENGL_DEBUG,
      options.debug ? EGL_TRUE : EGL_FALSE,
      EGL_NONE};
  const EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted.data());
  if (oldApi != EGL_NONE) eglBindAPI(oldApi);
  if (context == EGL_NO_CONTEXT) return fail(ErrorCode::device, "OpenGL 4.5 is not to be had", candidate.name);
  return Handles{display, context};
}

}  // namespace

std::string currentRenderer() {
  const auto* text = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return text != nullptr ? text : "unknown";
}

Result<void> checkCurrentContext() {
  // Without a context the dispatcher would abort; the version query is the one call that it answers by 0.
  if (const int version = epoxy_gl_version(); version < 45 || !epoxy_is_desktop_gl())
    return fail(ErrorCode::device,
                version <= 0 ? "no OpenGL context is current" : "the current context is older than OpenGL 4.5");
  return {};
}

bool currentIsEgl() { return epoxy_has_egl() && eglGetCurrentContext() != EGL_NO_CONTEXT; }

Quirks findQuirks() {
  Quirks quirks;
  const std::string renderer = currentRenderer();
  for (const char* name : {"llvmpipe", "softpipe", "swrast", "SWR"})
    quirks.software = quirks.software || renderer.find(name) != std::string::npos;
  quirks.timerQueriesMeasureSubmissionOnly = quirks.software;
  quirks.readsStorageLate = quirks.software;
  quirks.depthBounds = epoxy_has_gl_extension("GL_EXT_depth_bounds_test");
  GLint64 bytes = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
  quirks.maxStorageBytes = static_cast<std::uint64_t>(bytes);
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &quirks.maxTextureSize);
  return quirks;
}

Result<std::shared_ptr<Context>> Context::createHeadless(const ContextOptions& options) {
  if (!epoxy_has_egl())
    return fail(ErrorCode::device, "no OpenGL on this machine: libEGL is missing (package libegl1)");
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  std::string tried;
  for (const Candidate& candidate : candidates(extensions)) {
    const auto handles = open(candidate, options);
    if (!handles) {
      tried += (tried.empty() ? "" : "; ") + handles.error().text();
      continue;
    }
    std::shared_ptr<Context> context(new Context(handles->display, handles->context));
    const CurrentContext current(context);
    context->renderer_ = currentRenderer();
    context->quirks_ = findQuirks();
    if (options.adjust) options.adjust(context->quirks_);
    return context;
  }
  return fail(ErrorCode::device,
              "no OpenGL 4.5 on this machine (" +
                  (tried.empty() ? std::string("EGL offers no device; package libgl1-mesa-dri") : tried) + ")");
}

// The display is not terminated: EGL hands out one display per device to the whole process, and others may be using it.
Context::~Context() { eglDestroyContext(display_, context_); }

CurrentContext::CurrentContext(const std::shared_ptr<Context>& context) : context_(context) {
  if (context_ == nullptr) return;
  oldContext_ = eglGetCurrentContext();
  oldDisplay_ = eglGetCurrentDisplay();
  oldDraw_ = eglGetCurrentSurface(EGL_DRAW);
  oldRead_ = eglGetCurrentSurface(EGL_READ);
  const bool made = eglMakeCurrent(context_->display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_->context_) == EGL_TRUE;
  UMBRAGE_CHECK(made, "the context is current in another thread");
}

CurrentContext::~CurrentContext() {
  if (context_ == nullptr) return;
  if (oldContext_ == EGL_NO_CONTEXT)
    eglMakeCurrent(context_->display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  else
    eglMakeCurrent(oldDisplay_, oldDraw_, oldRead_, oldContext_);
}

}  // namespace umbrage::gl

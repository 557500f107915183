#include "umbrage/gl/debug_log.hpp"

#include <epoxy/gl.h>

namespace umbrage::gl {
namespace {

void APIENTRY hear(GLenum, GLenum type, GLuint, GLenum, GLsizei length, const GLchar* message, const void* user) {
  const bool complaint = type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR ||
                         type == GL_DEBUG_TYPE_DEPRECATED_BEHAVIOR;
  if (!complaint) return;
  auto* log = static_cast<DebugLog*>(const_cast<void*>(user));
  log->add(length < 0 ? std::string(message) : std::string(message, static_cast<std::size_t>(length)));
}

}  // namespace

DebugLog::DebugLog() {
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(hear, this);
}

DebugLog::~DebugLog() {
  glDebugMessageCallback(nullptr, nullptr);
  glDisable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDisable(GL_DEBUG_OUTPUT);
}

}  // namespace umbrage::gl

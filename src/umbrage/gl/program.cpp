#include "umbrage/gl/program.hpp"

#include <epoxy/gl.h>

#include <array>
#include <initializer_list>

#include "umbrage/base/check.hpp"

namespace umbrage::gl {
namespace {

constexpr GLsizei kLogSize = 4096;

GLuint compile(GLenum stage, std::string_view source) {
  const GLuint shader = glCreateShader(stage);
  const char* text = source.data();
  const auto length = static_cast<GLint>(source.size());
  glShaderSource(shader, 1, &text, &length);
  glCompileShader(shader);
  GLint good = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  std::array<char, kLogSize> log{};
  if (good != GL_TRUE) glGetShaderInfoLog(shader, kLogSize, nullptr, log.data());
  UMBRAGE_CHECK(good == GL_TRUE, log.data());
  return shader;
}

Handle link(std::initializer_list<GLuint> shaders) {
  const GLuint program = glCreateProgram();
  Handle handle(Handle::Kind::program, program);
  for (const GLuint shader : shaders) glAttachShader(program, shader);
  glLinkProgram(program);
  GLint good = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  std::array<char, kLogSize> log{};
  if (good != GL_TRUE) glGetProgramInfoLog(program, kLogSize, nullptr, log.data());
  UMBRAGE_CHECK(good == GL_TRUE, log.data());
  for (const GLuint shader : shaders) {
    glDetachShader(program, shader);
    glDeleteShader(shader);
  }
  return handle;
}

}  // namespace

Program::Program(std::string_view vertexSource, std::string_view fragmentSource)
    : handle_(link({compile(GL_VERTEX_SHADER, vertexSource), compile(GL_FRAGMENT_SHADER, fragmentSource)})) {}

Program::Program(std::string_view vertexSource, std::string_view geometrySource, std::string_view fragmentSource)
    : handle_(link({compile(GL_VERTEX_SHADER, vertexSource), compile(GL_GEOMETRY_SHADER, geometrySource),
                    compile(GL_FRAGMENT_SHADER, fragmentSource)})) {}

Program Program::compute(std::string_view source) {
  Program program;
  program.handle_ = link({compile(GL_COMPUTE_SHADER, source)});
  return program;
}

}  // namespace umbrage::gl

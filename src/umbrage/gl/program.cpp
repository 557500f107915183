#include "umbrage/gl/program.hpp"

#include <epoxy/gl.h>

#include <array>

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

}  // namespace

Program::Program(std::string_view vertexSource, std::string_view fragmentSource) {
  const GLuint vertex = compile(GL_VERTEX_SHADER, vertexSource);
  const GLuint fragment = compile(GL_FRAGMENT_SHADER, fragmentSource);
  const GLuint program = glCreateProgram();
  handle_ = Handle(Handle::Kind::program, program);
  glAttachShader(program, vertex);
  glAttachShader(program, fragment);
  glLinkProgram(program);
  GLint good = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  std::array<char, kLogSize> log{};
  if (good != GL_TRUE) glGetProgramInfoLog(program, kLogSize, nullptr, log.data());
  UMBRAGE_CHECK(good == GL_TRUE, log.data());
  for (const GLuint shader : {vertex, fragment}) {
    glDetachShader(program, shader);
    glDeleteShader(shader);
  }
}

}  // namespace umbrage::gl

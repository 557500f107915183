#include "umbrage/gl/objects.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <string>

#include "umbrage/base/check.hpp"

namespace umbrage::gl {
namespace {

GLenum internalFormat(Format format) {
  switch (format) {
    case Format::grey8: return GL_R8;
    case Format::rgba8: return GL_RGBA8;
    case Format::rgba16f: return GL_RGBA16F;
    case Format::rg32f: return GL_RG32F;
    case Format::rgba32f: return GL_RGBA32F;
    case Format::id32: return GL_R32UI;
    case Format::depth32f: return GL_DEPTH_COMPONENT32F;
    case Format::depth32fStencil8: return GL_DEPTH32F_STENCIL8;
    case Format::depth24Stencil8: return GL_DEPTH24_STENCIL8;
  }
  return GL_RGBA8;
}

GLenum attachment(Format depth) {
  return depth == Format::depth32f ? GL_DEPTH_ATTACHMENT : GL_DEPTH_STENCIL_ATTACHMENT;
}

// Errors that somebody else left behind must not be taken for ours.
void forgetOldErrors() {
  for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i) {
  }
}

}  // namespace

Handle::~Handle() {
  if (name_ == 0) return;
  switch (kind_) {
    case Kind::none: break;
    case Kind::buffer: glDeleteBuffers(1, &name_); break;
    case Kind::texture: glDeleteTextures(1, &name_); break;
    case Kind::framebuffer: glDeleteFramebuffers(1, &name_); break;
    case Kind::vertexArray: glDeleteVertexArrays(1, &name_); break;
    case Kind::program: glDeleteProgram(name_); break;
  }
}

Buffer::Buffer() {
  GLuint name = 0;
  glCreateBuffers(1, &name);
  handle_ = Handle(Handle::Kind::buffer, name);
}

Result<void> Buffer::set(std::span<const std::byte> bytes) {
  return allocate(bytes.size(), bytes.empty() ? nullptr : bytes.data());
}

Result<void> Buffer::reserve(std::size_t bytes) {
  if (bytes <= bytes_) return {};
  return allocate(bytes, nullptr);
}

Result<void> Buffer::allocate(std::size_t bytes, const std::byte* contents) {
  forgetOldErrors();
  // An empty buffer may not be bound for reading, so there is always at least one word.
  const std::size_t size = bytes == 0 ? 16 : bytes;
  glNamedBufferData(handle_.name(), static_cast<GLsizeiptr>(size), contents, GL_DYNAMIC_DRAW);
  if (glGetError() == GL_OUT_OF_MEMORY)
    return fail(ErrorCode::device, "graphics memory is short of " + std::to_string(size) + " bytes");
  bytes_ = bytes;
  return {};
}

void Buffer::clear() {
  // A value of ours would be fetched as a host's unpacking of pixels says; none stands for zeros.
  glClearNamedBufferData(handle_.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
}

void Buffer::read(std::span<std::byte> out) const {
  UMBRAGE_CHECK(out.size() <= bytes_, "read past the end of a buffer");
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  if (!out.empty()) glGetNamedBufferSubData(handle_.name(), 0, static_cast<GLsizeiptr>(out.size()), out.data());
}

Result<Texture> Texture::make(Format format, int width, int height) {
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (width < 1 || height < 1 || width > largest || height > largest)
    return fail(ErrorCode::device, "this driver draws pictures of 1 to " + std::to_string(largest) + " pixels a side");
  forgetOldErrors();
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &name);
  Texture texture;
  texture.handle_ = Handle(Handle::Kind::texture, name);
  texture.format_ = format;
  texture.width_ = width;
  texture.height_ = height;
  glTextureStorage2D(name, 1, internalFormat(format), width, height);
  // Integer pictures are incomplete with the default linear filter, even for texelFetch.
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  if (glGetError() != GL_NO_ERROR) return fail(ErrorCode::device, "graphics memory is short for a picture");
  return texture;
}

Result<Framebuffer> Framebuffer::make(const Texture* colour, const Texture* depth) {
  return make(std::span(&colour, colour != nullptr ? 1 : 0), depth);
}

Result<Framebuffer> Framebuffer::make(std::span<const Texture* const> colours, const Texture* depth) {
  UMBRAGE_CHECK(colours.size() <= kColourTargets, "more colour pictures than any driver draws into");
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  Framebuffer framebuffer;
  framebuffer.handle_ = Handle(Handle::Kind::framebuffer, name);
  std::array<GLenum, kColourTargets> draw{GL_NONE};
  for (std::size_t i = 0; i < colours.size(); ++i) {
    draw[i] = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i);
    glNamedFramebufferTexture(name, draw[i], colours[i]->name(), 0);
  }
  if (depth != nullptr) glNamedFramebufferTexture(name, attachment(depth->format()), depth->name(), 0);
  glNamedFramebufferDrawBuffers(name, std::max<GLsizei>(1, static_cast<GLsizei>(colours.size())), draw.data());
  glNamedFramebufferReadBuffer(name, draw[0]);
  const GLenum status = glCheckNamedFramebufferStatus(name, GL_DRAW_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE)
    return fail(ErrorCode::device, "the driver refuses a framebuffer (status " + std::to_string(status) + ")");
  return framebuffer;
}

VertexArray::VertexArray() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  handle_ = Handle(Handle::Kind::vertexArray, name);
}

VertexArray::VertexArray(const Buffer& indices) : VertexArray() {
  glVertexArrayElementBuffer(handle_.name(), indices.name());
}

}  // namespace umbrage::gl

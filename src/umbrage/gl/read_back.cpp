#include "umbrage/gl/read_back.hpp"

#include <epoxy/gl.h>

#include <algorithm>

namespace umbrage::gl {
namespace {

template <class T>
image::Image<T> read(const Framebuffer& from, int width, int height, GLenum format, GLenum type) {
  image::Image<T> picture(width, height);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from.name());
  glReadPixels(0, 0, width, height, format, type, picture.pixels().data());
  for (int y = 0; y < height / 2; ++y)
    std::swap_ranges(picture.row(y), picture.row(y) + width, picture.row(height - 1 - y));
  return picture;
}

}  // namespace

image::GreyImage readGrey(const HostScope&, const Framebuffer& from, int width, int height) {
  return read<std::uint8_t>(from, width, height, GL_RED, GL_UNSIGNED_BYTE);
}

image::RgbaImage readRgba(const HostScope&, const Framebuffer& from, int width, int height) {
  return read<image::Rgba8>(from, width, height, GL_RGBA, GL_UNSIGNED_BYTE);
}

image::Image<Vec2f> readPairs(const HostScope&, const Framebuffer& from, int width, int height) {
  return read<Vec2f>(from, width, height, GL_RG, GL_FLOAT);
}

image::Image<Vec4f> readQuadruples(const HostScope&, const Framebuffer& from, int width, int height) {
  return read<Vec4f>(from, width, height, GL_RGBA, GL_FLOAT);
}

image::Image<std::uint32_t> readIds(const HostScope&, const Framebuffer& from, int width, int height) {
  return read<std::uint32_t>(from, width, height, GL_RED_INTEGER, GL_UNSIGNED_INT);
}

image::Image<float> readDepth(const HostScope&, const Framebuffer& from, int width, int height) {
  return read<float>(from, width, height, GL_DEPTH_COMPONENT, GL_FLOAT);
}

image::GreyImage readStencil(const HostScope&, const Framebuffer& from, int width, int height) {
  return read<std::uint8_t>(from, width, height, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE);
}

}  // namespace umbrage::gl

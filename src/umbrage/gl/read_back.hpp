#pragma once

#include <cstdint>

#include "umbrage/gl/host_scope.hpp"
#include "umbrage/gl/objects.hpp"
#include "umbrage/image/image.hpp"
#include "umbrage/math/vec.hpp"

namespace umbrage::gl {

// Pictures from the graphics card, turned so that row 0 is the top. They wait until drawing is done.
// REQUIRES: called inside a HostScope (which sets the packing of pixels); the framebuffer has what is asked for, of this size.

[[nodiscard]] image::GreyImage readGrey(const HostScope& scope, const Framebuffer& from, int width, int height);
[[nodiscard]] image::RgbaImage readRgba(const HostScope& scope, const Framebuffer& from, int width, int height);
[[nodiscard]] image::Image<Vec2f> readPairs(const HostScope& scope, const Framebuffer& from, int width, int height);
[[nodiscard]] image::Image<Vec4f> readQuadruples(const HostScope& scope, const Framebuffer& from, int width,
                                                 int height);
[[nodiscard]] image::Image<std::uint32_t> readIds(const HostScope& scope, const Framebuffer& from, int width,
                                                  int height);
[[nodiscard]] image::Image<float> readDepth(const HostScope& scope, const Framebuffer& from, int width, int height);
[[nodiscard]] image::GreyImage readStencil(const HostScope& scope, const Framebuffer& from, int width, int height);

}  // namespace umbrage::gl

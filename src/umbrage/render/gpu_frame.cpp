#include "umbrage/render/gpu_frame.hpp"

namespace umbrage::render {
namespace {

Result<void> add(gl::Texture& texture, gl::Framebuffer& target, gl::Format format, int width, int height,
                 const gl::Texture* depthStencil) {
  auto made = gl::Texture::make(format, width, height);
  if (!made) return tl::unexpected(made.error());
  texture = std::move(*made);
  auto framebuffer = gl::Framebuffer::make(&texture, depthStencil);
  if (!framebuffer) return tl::unexpected(framebuffer.error());
  target = std::move(*framebuffer);
  return {};
}

}  // namespace

Result<GpuFrame> GpuFrame::make(int width, int height) {
  GpuFrame frame;
  auto depthStencil = gl::Texture::make(gl::Format::depth32fStencil8, width, height);
  if (!depthStencil) return tl::unexpected(depthStencil.error());
  frame.depthStencil_ = std::move(*depthStencil);
  auto stencil = gl::Framebuffer::make(nullptr, &frame.depthStencil_);
  if (!stencil) return tl::unexpected(stencil.error());
  frame.stencilTarget_ = std::move(*stencil);
  if (auto done = add(frame.ids_, frame.surfaceTarget_, gl::Format::id32, width, height, &frame.depthStencil_); !done)
    return tl::unexpected(done.error());
  return frame;
}

Result<void> GpuFrame::needMasks(std::size_t count) {
  while (masks_.size() < count) {
    Mask mask;
    if (auto done = add(mask.texture, mask.target, gl::Format::grey8, width(), height(), &depthStencil_); !done)
      return done;
    masks_.push_back(std::move(mask));
  }
  return {};
}

Result<void> GpuFrame::needTiles() {
  if (tiles_.name() != 0) return {};
  return add(tiles_, tilesTarget_, gl::Format::rg32f, tilesFor(width()), tilesFor(height()), nullptr);
}

Result<void> GpuFrame::needMaskSum() {
  if (maskSum_.name() != 0) return {};
  return add(maskSum_, maskSumTarget_, gl::Format::rgba32f, width(), height(), nullptr);
}

Result<void> GpuFrame::needTints() {
  if (tints_.opaque.name() != 0) return {};
  std::vector<const gl::Texture*> colours;
  for (gl::Texture& sum : tints_.sums) {
    auto made = gl::Texture::make(gl::Format::rg32f, width(), height());
    if (!made) return tl::unexpected(made.error());
    sum = std::move(*made);
    colours.push_back(&sum);
  }
  auto veilDepth = gl::Texture::make(gl::Format::depth32f, width(), height());
  if (!veilDepth) return tl::unexpected(veilDepth.error());
  tints_.veilDepth = std::move(*veilDepth);
  auto veils = gl::Framebuffer::make(nullptr, &tints_.veilDepth);
  if (!veils) return tl::unexpected(veils.error());
  tints_.veils = std::move(*veils);
  auto bare = gl::Framebuffer::make(colours[0], nullptr);
  if (!bare) return tl::unexpected(bare.error());
  tints_.bare = std::move(*bare);
  auto opaque = gl::Framebuffer::make(colours, &depthStencil_);
  if (!opaque) return tl::unexpected(opaque.error());
  tints_.opaque = std::move(*opaque);
  return {};
}

Result<void> GpuFrame::needPicture() {
  if (sum_.name() != 0) return {};
  if (auto done = add(picture_, pictureTarget_, gl::Format::rgba8, width(), height(), nullptr); !done) return done;
  return add(sum_, sumTarget_, gl::Format::rgba16f, width(), height(), &depthStencil_);
}

}  // namespace umbrage::render

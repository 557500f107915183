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
  return addSums(0, tints_.opaque, &tints_.bare);
}

Result<void> GpuFrame::needLayers() {
  if (tints_.layers.name() != 0) return {};
  if (auto done = add(tints_.depths, tints_.depthsTarget, gl::Format::rg32f, width(), height(), &depthStencil_); !done)
    return done;
  return addSums(TintTargets::kPairs, tints_.layers, nullptr);
}

// The sums from `first` on, and a target of all up to them.
Result<void> GpuFrame::addSums(std::size_t first, gl::Framebuffer& target, gl::Framebuffer* bare) {
  std::vector<const gl::Texture*> colours;
  for (std::size_t i = 0; i < first + TintTargets::kPairs; ++i) {
    if (i >= first) {
      auto made = gl::Texture::make(gl::Format::rg32f, width(), height());
      if (!made) return tl::unexpected(made.error());
      tints_.sums[i] = std::move(*made);
    }
    colours.push_back(&tints_.sums[i]);
  }
  if (bare != nullptr) {
    auto made = gl::Framebuffer::make(colours[0], nullptr);
    if (!made) return tl::unexpected(made.error());
    *bare = std::move(*made);
  }
  auto made = gl::Framebuffer::make(colours, &depthStencil_);
  if (!made) return tl::unexpected(made.error());
  target = std::move(*made);
  return {};
}

Result<void> GpuFrame::needPicture() {
  if (sum_.name() != 0) return {};
  if (auto done = add(picture_, pictureTarget_, gl::Format::rgba8, width(), height(), nullptr); !done) return done;
  return add(sum_, sumTarget_, gl::Format::rgba16f, width(), height(), &depthStencil_);
}

}  // namespace umbrage::render

#pragma once

#include <array>
#include <optional>
#include <vector>

#include "umbrage/gl/objects.hpp"

namespace umbrage::render {

/// Pixels a side of a tile in which receivers are summed up.
inline constexpr int kTile = 16;
[[nodiscard]] constexpr int tilesFor(int pixels) { return (pixels + kTile - 1) / kTile; }

/// Where shadow volumes sum up what casters take from the light, in pairs of channels that tinted_volume.frag tells.
struct TintTargets {
  static constexpr std::size_t kPairs = 4;
  std::array<gl::Texture, kPairs> sums;
  gl::Framebuffer opaque;  ///< all of them, with depth and stencil
  gl::Framebuffer bare;    ///< one picture without depth, for what only writes storage
  gl::Texture veilDepth;
  gl::Framebuffer veils;  ///< the depth of veils alone
};

/// The pictures that a frame is drawn into, of one size: triangle ids with depth and stencil; the tiles of a light's receivers, a mask
/// per light and the lit picture when they are asked for. REQUIRES: its context is current when it is made, used and destroyed.
class GpuFrame {
 public:
  /// Errors: ErrorCode::device when the size is beyond the driver's or memory is short.
  [[nodiscard]] static Result<GpuFrame> make(int width, int height);
  [[nodiscard]] Result<void> needMasks(std::size_t count);
  [[nodiscard]] Result<void> needPicture();
  [[nodiscard]] Result<void> needTiles();
  /// Room for the mean of many masks.
  [[nodiscard]] Result<void> needMaskSum();
  [[nodiscard]] Result<void> needTints();

  [[nodiscard]] int width() const { return depthStencil_.width(); }
  [[nodiscard]] int height() const { return depthStencil_.height(); }

  [[nodiscard]] const gl::Texture& ids() const { return ids_; }
  [[nodiscard]] const gl::Texture& depthStencil() const { return depthStencil_; }
  [[nodiscard]] const gl::Texture& mask(std::size_t light) const { return masks_[light].texture; }
  /// Light and weight of two halves of a light's samples.
  [[nodiscard]] const gl::Texture& maskSum() const { return maskSum_; }
  [[nodiscard]] const gl::Texture& sum() const { return sum_; }
  /// The finished picture, sRGB-encoded RGBA8, row 0 at the bottom: for a host to show.
  [[nodiscard]] const gl::Texture& picture() const { return picture_; }

  [[nodiscard]] const TintTargets& tints() const { return tints_; }

  [[nodiscard]] const gl::Framebuffer& surfaceTarget() const { return surfaceTarget_; }
  [[nodiscard]] const gl::Framebuffer& stencilTarget() const { return stencilTarget_; }
  [[nodiscard]] const gl::Framebuffer& maskTarget(std::size_t light) const { return masks_[light].target; }
  [[nodiscard]] const gl::Framebuffer& maskSumTarget() const { return maskSumTarget_; }
  [[nodiscard]] const gl::Framebuffer& tilesTarget() const { return tilesTarget_; }
  [[nodiscard]] const gl::Framebuffer& sumTarget() const { return sumTarget_; }
  [[nodiscard]] const gl::Framebuffer& pictureTarget() const { return pictureTarget_; }

 private:
  struct Mask {
    gl::Texture texture;
    gl::Framebuffer target;
  };
  GpuFrame() = default;
  gl::Texture ids_, depthStencil_, tiles_, maskSum_, sum_, picture_;
  std::vector<Mask> masks_;
  TintTargets tints_;
  gl::Framebuffer surfaceTarget_, stencilTarget_, tilesTarget_, maskSumTarget_, sumTarget_, pictureTarget_;
};

}  // namespace umbrage::render

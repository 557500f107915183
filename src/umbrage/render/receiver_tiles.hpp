#pragma once

#include <span>

#include "umbrage/image/image.hpp"
#include "umbrage/render/view.hpp"

namespace umbrage::render {

/// Per tile the depth of the farthest and of the nearest pixel whose triangle has a nonzero entry in `facing`, (2, -1) without any: what the
/// shader receiver_tiles.frag computes, for where pixels are in memory anyway. Rows from the top, tiles counted from the bottom.
[[nodiscard]] image::Image<Vec2f> receiverDepths(const image::Image<std::uint32_t>& ids,
                                                 const image::Image<float>& depths,
                                                 std::span<const std::uint8_t> facing);

/// What of a light's volumes cannot change a pixel that the light may reach, told from how near and far those pixels' surfaces are,
/// tile by tile. Everything else of the picture (sky, surfaces turned away from the light) is dark whatever the volumes count.
class ReceiverTiles {
 public:
  /// `depths`: per tile of kTile pixels a side, from the lower left, the depth of the farthest and of the nearest receiver (of
  /// viewOf(Camera)); (2, -1) where there is none. `width`, `height`: pixels of the viewport.
  ReceiverTiles(const View& view, image::Image<Vec2f> depths, int width, int height);

  /// True when no fragment of the convex hull of `points` (homogeneous, relative to the eye) is before a receiver: the hull lies behind
  /// the farthest receiver of every tile that it may touch, or outside the picture. Fragments that z-pass counts are before one.
  [[nodiscard]] bool behindAll(std::span<const Vec4> points) const;
  /// True when no fragment of it is behind a receiver. Fragments that z-fail counts are behind one.
  [[nodiscard]] bool beforeAll(std::span<const Vec4> points) const;

 private:
  struct Extent;
  [[nodiscard]] Extent extentOf(std::span<const Vec4> points) const;

  View view_;
  int width_, height_;
  image::Image<Vec2f> distances_;  ///< farthest (-1: none) and nearest (infinite: none)
};

}  // namespace umbrage::render

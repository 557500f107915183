#include "umbrage/render/receiver_tiles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "umbrage/render/gpu_frame.hpp"
#include "umbrage/shadow/surface_buffer.hpp"

namespace umbrage::render {
namespace {

// Rasterisers interpolate depth to about 2^-16 of itself over large triangles; this stays clear of that.
constexpr double kClear = 0x1p-10;
// Pixels that a hull is widened by, for the snapping of corners.
constexpr double kPixels = 1.5;
// A hull that comes nearer to the plane of the eye than this share of its size is not projected.
constexpr double kLeastDepth = 1e-6;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

}  // namespace

image::Image<Vec2f> receiverDepths(const image::Image<std::uint32_t>& ids, const image::Image<float>& depths,
                                   std::span<const std::uint8_t> facing) {
  const int width = ids.width(), height = ids.height();
  image::Image<Vec2f> tiles(tilesFor(width), tilesFor(height), Vec2f(2.0f, -1.0f));
  for (int y = 0; y < height; ++y) {
    Vec2f* row = tiles.row(tiles.height() - 1 - (height - 1 - y) / kTile);
    const std::uint32_t* id = ids.row(y);
    const float* depth = depths.row(y);
    for (int tile = 0; tile < tiles.width(); ++tile) {
      Vec2f range = row[tile];
      for (int x = tile * kTile, last = std::min(width, x + kTile); x < last; ++x) {
        if (id[x] == shadow::kNoTriangle || facing[id[x]] == 0) continue;
        range = {std::min(range.x, depth[x]), std::max(range.y, depth[x])};
      }
      row[tile] = range;
    }
  }
  return tiles;
}

// The tiles that a hull may touch, none when left > right, and its distances along the view.
struct ReceiverTiles::Extent {
  int left = 0, right = -1, bottom = 0, top = -1;
  double nearest = 0.0, farthest = kInfinite;
};

ReceiverTiles::ReceiverTiles(const View& view, image::Image<Vec2f> depths, int width, int height)
    : view_(view), width_(width), height_(height), distances_(std::move(depths)) {
  for (Vec2f& range : distances_.pixels())
    range = range.x > 1.0f ? Vec2f(-1.0f, std::numeric_limits<float>::infinity())
                           : Vec2f(depthToDistance(view_, range.x), depthToDistance(view_, range.y));
}

ReceiverTiles::Extent ReceiverTiles::extentOf(std::span<const Vec4> points) const {
  const Extent everything{0, distances_.width() - 1, 0, distances_.height() - 1, 0.0, kInfinite};
  Extent extent = everything;
  extent.farthest = 0.0;
  double left = kInfinite, right = -kInfinite, bottom = kInfinite, top = -kInfinite, nearest = kInfinite;
  bool crosses = false;
  int beyond[5] = {0, 0, 0, 0, 0};
  const double marginX = 1.0 + 2.0 * kPixels / width_, marginY = 1.0 + 2.0 * kPixels / height_;
  for (const Vec4& p : points) {
    const Vec4 clip = view_.toClip * p;
    beyond[0] += clip.x < -marginX * clip.w;
    beyond[1] += clip.x > marginX * clip.w;
    beyond[2] += clip.y < -marginY * clip.w;
    beyond[3] += clip.y > marginY * clip.w;
    beyond[4] += clip.w < 0.0;
    if (p.w == 0.0)
      extent.farthest = kInfinite;
    else
      extent.farthest = std::max(extent.farthest, clip.w / p.w);
    if (!(clip.w > kLeastDepth * glm::length(Vec3(p)))) {
      crosses = true;
      continue;
    }
    if (p.w != 0.0) nearest = std::min(nearest, clip.w / p.w);
    left = std::min(left, clip.x / clip.w);
    right = std::max(right, clip.x / clip.w);
    bottom = std::min(bottom, clip.y / clip.w);
    top = std::max(top, clip.y / clip.w);
  }
  const int all = static_cast<int>(points.size());
  if (std::any_of(std::begin(beyond), std::end(beyond), [&](int count) { return count == all; })) return {};
  if (crosses) return extent;
  extent.nearest = nearest;
  const auto tile = [](double ndc, int pixels, double margin) {
    const double at = std::clamp((0.5 + 0.5 * ndc) * pixels + margin, -1.0 * kTile, double(pixels) + kTile);
    return static_cast<int>(std::floor(at / kTile));
  };
  extent.left = std::max(0, tile(left, width_, -kPixels));
  extent.right = std::min(everything.right, tile(right, width_, kPixels));
  extent.bottom = std::max(0, tile(bottom, height_, -kPixels));
  extent.top = std::min(everything.top, tile(top, height_, kPixels));
  return extent;
}

bool ReceiverTiles::behindAll(std::span<const Vec4> points) const {
  const Extent extent = extentOf(points);
  const double nearest = extent.nearest * (1.0 - kClear);
  for (int y = extent.bottom; y <= extent.top; ++y) {
    const Vec2f* row = distances_.row(distances_.height() - 1 - y);
    for (int x = extent.left; x <= extent.right; ++x)
      if (double(row[x].x) >= nearest) return false;
  }
  return true;
}

bool ReceiverTiles::beforeAll(std::span<const Vec4> points) const {
  const Extent extent = extentOf(points);
  const double farthest = extent.farthest * (1.0 + kClear);
  for (int y = extent.bottom; y <= extent.top; ++y) {
    const Vec2f* row = distances_.row(distances_.height() - 1 - y);
    for (int x = extent.left; x <= extent.right; ++x)
      if (double(row[x].y) <= farthest) return false;
  }
  return true;
}

}  // namespace umbrage::render

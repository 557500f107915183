#pragma once

#include <mutex>

#include "umbrage/raster/bands.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::raster {

/// What a block shows, in short.
struct BlockSummary {
  static constexpr std::uint32_t kSeveral = shadow::kNoTriangle - 1;  ///< triangles, or one and nothing
  std::uint32_t triangle = shadow::kNoTriangle;                       ///< what all its pixels show
  float farthest = 0.0f, nearest = 0.0f;  ///< nearness of its pixels that show a surface; 0 where none does
  std::uint64_t covered = 0;              ///< those pixels, a bit each
};

/// What a camera sees, block by block.
struct SeenBlocks {
  std::vector<BlockSummary> summary;   ///< per block
  BlockImage<float> nearness;          ///< 1 / w of the pixel space; 0 where there is no surface
  BlockImage<std::uint32_t> triangle;  ///< shadow::kNoTriangle where there is none
};

/// A triangle of the surfaces as a patch whose plane function is nearness itself.
enum class Shown { no, yes, edgeOn };
/// edgeOn: the eye lies in its plane (liesInPlane), and nothing is seen of it.
[[nodiscard]] Shown makeSurfacePatch(const PixelSpace& space, const SeenPositions& positions,
                                     const scene::Surfaces& surfaces, std::uint32_t triangle, Patch& out);

/// Which surfaces are drawn.
enum class Drawn { all, opaque };

/// Draws what cameras see of a scene, on the processor: every triangle in the plane of its three corners, with no clipping and no rounding of
/// corners to a grid; where a pixel's centre lies on an edge two triangles share, exactly one of them covers it.
class SurfaceRaster {
 public:
  /// REQUIRES: `geometry` outlives this.
  explicit SurfaceRaster(const shadow::Geometry& geometry, Drawn drawn = Drawn::all);
  /// Another geometry, which outlives this. Memory is kept.
  void use(const shadow::Geometry& geometry);

  /// `positions`: those of the geometry, mapped by `space`.
  /// 1. Left out are triangles in whose plane the eye lies (liesInPlane): nothing is seen of them. Those of them that cast are `edgeOn`.
  /// Errors: ErrorCode::device when memory runs out.
  [[nodiscard]] Result<void> draw(const PixelSpace& space, const SeenPositions& positions, SeenBlocks& out);

  /// Of the last picture: triangles in whose plane the eye lies, ascending.
  [[nodiscard]] const std::vector<std::uint32_t>& edgeOn() const { return edgeOn_; }

 private:
  [[nodiscard]] bool make(const PixelSpace& space, const SeenPositions& positions, std::uint32_t triangle, Patch& out);
  void findAverted(const Vec3& eye);
  const shadow::Geometry* geometry_;
  Drawn drawn_;
  std::vector<std::uint8_t> veiled_;  ///< per component, where veils are left out
  std::vector<std::uint8_t> averted_;
  std::mutex edgeOnMutex_;
  std::vector<std::uint32_t> edgeOn_;
  Bands bands_;
};

/// As an image, with depths in scene units.
[[nodiscard]] Result<shadow::SurfaceBuffer> surfaceBuffer(const PixelSpace& space, const SeenBlocks& seen);

}  // namespace umbrage::raster

#pragma once

#include <mutex>

#include "umbrage/raster/bands.hpp"
#include "umbrage/raster/layers.hpp"
#include "umbrage/raster/surfaces.hpp"
#include "umbrage/shadow/veils.hpp"

namespace umbrage::raster {

/// Draws the veils that cameras see before the opaque surfaces, all of them, each in a layer of its pixel.
class VeilRaster {
 public:
  /// REQUIRES: `geometry` outlives this.
  explicit VeilRaster(const shadow::Geometry& geometry);

  /// `seen`: the opaque surfaces.
  /// 1. Of each pixel the veils are sorted by nearness; equal ones by the number of their triangle.
  /// 2. Veils in whose plane the eye lies are left out, and are `edgeOn`.
  /// Errors: ErrorCode::device when memory runs out.
  [[nodiscard]] Result<void> draw(const PixelSpace& space, const SeenPositions& positions, const SeenBlocks& seen,
                                  LayeredBlocks& out);

  /// Of the last picture: veils in whose plane the eye lies, ascending.
  [[nodiscard]] const std::vector<std::uint32_t>& edgeOn() const { return edgeOn_; }

 private:
  const shadow::Geometry& geometry_;
  std::vector<std::uint32_t> veils_;
  std::mutex edgeOnMutex_;
  std::vector<std::uint32_t> edgeOn_;
  Bands bands_;
};

/// The veils as a list per pixel, with depths in scene units.
[[nodiscard]] shadow::VeilBuffer veilBuffer(const PixelSpace& space, const LayeredBlocks& seen);

}  // namespace umbrage::raster

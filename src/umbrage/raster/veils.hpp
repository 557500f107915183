#pragma once

#include <mutex>

#include "umbrage/raster/bands.hpp"
#include "umbrage/raster/layers.hpp"
#include "umbrage/raster/surfaces.hpp"
#include "umbrage/shadow/veils.hpp"

namespace umbrage::raster {

/// Draws the veils that cameras see before the opaque surfaces, all of them.
class VeilRaster {
 public:
  /// REQUIRES: `geometry` outlives this.
  explicit VeilRaster(const shadow::Geometry& geometry);

  /// `seen`: the opaque surfaces.
  /// 1. Of each pixel the veils are sorted by depth; equal ones by the number of their triangle.
  /// 2. Veils in whose plane the eye lies are left out, and are `edgeOn`.
  /// Errors: ErrorCode::device when memory runs out.
  [[nodiscard]] Result<void> draw(const PixelSpace& space, const SeenPositions& positions, const SeenBlocks& seen,
                                  shadow::VeilBuffer& out);

  /// Of the last picture: veils in whose plane the eye lies, ascending.
  [[nodiscard]] const std::vector<std::uint32_t>& edgeOn() const { return edgeOn_; }

  /// A pixel of a veil.
  struct Fragment {
    std::uint32_t pixel;  ///< in its band, row by row
    float nearness;
    std::uint32_t triangle;
  };

 private:
  const shadow::Geometry& geometry_;
  std::vector<std::uint32_t> veils_;
  std::mutex edgeOnMutex_;
  std::vector<std::uint32_t> edgeOn_;
  Bands bands_;
  std::vector<std::vector<Fragment>> fragments_;  ///< per band
};

/// The nearest veils of every pixel, at most `most`, in layers. Errors: ErrorCode::device when memory runs out.
[[nodiscard]] Result<void> layersOf(const PixelSpace& space, const shadow::VeilBuffer& veils, std::size_t most,
                                    VeilLayers& out);

}  // namespace umbrage::raster

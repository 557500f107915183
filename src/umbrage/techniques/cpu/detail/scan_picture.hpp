#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "umbrage/raster/bands.hpp"
#include "umbrage/raster/scan_line.hpp"
#include "umbrage/shadow/phase_clock.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::techniques::detail {

/// A picture row by row: the runs of pixels that show one surface, found by scan lines, and masks that are painted run by run.
class ScanPicture {
 public:
  explicit ScanPicture(std::shared_ptr<const shadow::Geometry> geometry);

  /// Makes the mask of one light of the picture that is being shaded.
  using MaskMaker =
      std::function<Result<shadow::LightMask>(const scene::Light&, shadow::FrameStats&, shadow::PhaseClock&)>;
  /// The picture of a frame, for which all else that follows then holds, and a mask for each of its lights.
  /// Errors: ErrorCode::device when memory runs out; those of `maskOf`.
  [[nodiscard]] Result<shadow::Shading> shade(const shadow::Frame& frame, const MaskMaker& maskOf);

  /// Sets the pixels of a row's runs, all of which face the light, that are lit to 255. Called for rows that have some.
  using RowShader = std::function<void(int y, std::span<const raster::Run> runs, std::uint8_t* lit)>;
  /// Called once for each band of rows, from several threads at once: makes what shades the rows [first, end), one after the other.
  using BandShader = std::function<RowShader(int band, int first, int end)>;
  /// Errors: ErrorCode::device when memory runs out.
  [[nodiscard]] Result<shadow::LightMask> paint(const scene::Light& light, const BandShader& shader) const;

  [[nodiscard]] const shadow::Geometry& geometry() const { return *geometry_; }
  [[nodiscard]] const raster::PixelSpace& space() const { return space_; }
  [[nodiscard]] const raster::SeenPositions& positions() const { return positions_; }
  /// Caster triangles in whose plane the eye lies, which the picture does not show.
  [[nodiscard]] const std::vector<std::uint32_t>& invisible() const { return invisible_; }
  /// Per triangle of the surfaces: that of the casters, or shadow::kNoTriangle.
  [[nodiscard]] const std::vector<std::uint32_t>& casterOf() const { return casterOf_; }

 private:
  [[nodiscard]] Result<void> see(const scene::Camera& camera);
  [[nodiscard]] Result<shadow::SurfaceBuffer> surface() const;
  [[nodiscard]] Result<void> fillBands();
  void findRuns(int band);
  void darkenBeyondCone(const scene::Light& light, int y, std::span<const raster::Run> runs, std::uint8_t* lit) const;

  std::shared_ptr<const shadow::Geometry> geometry_;
  std::vector<std::uint32_t> casterOf_;
  scene::Camera camera_;
  raster::PixelSpace space_;
  raster::SeenPositions positions_;
  raster::Bands bands_;  ///< of surfaces
  std::vector<std::vector<raster::Run>> rows_;
  std::mutex edgeOnMutex_;
  std::vector<std::uint32_t> invisible_;
};

}  // namespace umbrage::techniques::detail

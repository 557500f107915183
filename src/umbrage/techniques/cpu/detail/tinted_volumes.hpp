#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "umbrage/raster/tint_sums.hpp"
#include "umbrage/raster/veils.hpp"
#include "umbrage/shadow/phase_clock.hpp"
#include "umbrage/techniques/cpu/detail/facing_memo.hpp"

namespace umbrage::techniques::detail {

/// Opaque surfaces, the veils before them and masks of a picture, rasterised on the processor; the masks by shadow volumes that sum up what casters take from
/// the light.
class TintedVolumes {
 public:
  explicit TintedVolumes(std::shared_ptr<const shadow::Geometry> geometry);

  /// What a camera sees, for the calls that follow. `veilLayers`: as Frame has it. `veils`: becomes those of the picture.
  /// Errors: ErrorCode::device when memory runs out.
  [[nodiscard]] Result<void> see(const scene::Camera& camera, std::optional<int> veilLayers, shadow::VeilBuffer& veils);
  [[nodiscard]] Result<shadow::SurfaceBuffer> surface() const { return raster::surfaceBuffer(space_, seen_); }

  /// `veils`: those of the picture. REQUIRES: see() for the same camera.
  [[nodiscard]] Result<shadow::LightMask> mask(const scene::Camera& camera, const scene::Light& light,
                                               const shadow::VeilBuffer& veils, shadow::PhaseClock& clock);
  /// Of the last light.
  [[nodiscard]] shadow::LightStats stats() const;

 private:
  class Painting;
  [[nodiscard]] Result<void> findReceivers(FacingMemo& facing);
  void findCrossings();

  std::shared_ptr<const shadow::Geometry> geometry_;
  std::vector<std::uint32_t> casterOf_;  ///< per triangle of the surfaces
  raster::SurfaceRaster surfaces_;
  raster::VeilRaster veils_;
  raster::TintSums sums_;
  raster::PixelSpace space_;
  raster::SeenPositions positions_;
  raster::SeenBlocks seen_;
  raster::VeilLayers layers_;
  std::size_t litLayers_ = 0;             ///< so many of a pixel's veils are lit by themselves
  std::vector<std::int8_t> eyeSide_;      ///< per caster triangle that is a veil: lightSide of the eye
  std::vector<std::uint32_t> invisible_;  ///< caster triangles in whose plane the eye lies
  shadow::TintedSilhouette silhouette_;
  std::vector<shadow::FilterSum>
      crossing_;  ///< per triangle of the surfaces that is a veil and casts; of all others nothing
  std::vector<std::uint64_t> receivers_;  ///< per surface of a block
  raster::TintField field_;
};

}  // namespace umbrage::techniques::detail

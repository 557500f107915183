#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "umbrage/raster/shadow_count.hpp"
#include "umbrage/shadow/phase_clock.hpp"

namespace umbrage::techniques::detail {

class FacingMemo;

/// Surfaces and masks of a picture, both rasterised on the processor; the masks by counting the sides of shadow volumes.
class CpuVolumes {
 public:
  explicit CpuVolumes(std::shared_ptr<const shadow::Geometry> geometry);
  /// Another geometry, as if made for it; but memory is kept.
  void use(std::shared_ptr<const shadow::Geometry> geometry);

  /// What a camera sees, for the calls that follow. What it saw last it sees again at once.
  /// Errors: ErrorCode::device when memory runs out.
  [[nodiscard]] Result<void> see(const scene::Camera& camera);
  [[nodiscard]] bool hasSeen(const scene::Camera& camera) const { return camera_ == camera; }
  [[nodiscard]] Result<shadow::SurfaceBuffer> surface() const { return raster::surfaceBuffer(space_, seen_); }

  /// The first step of mask(): which pixels face a light, and the silhouette.
  [[nodiscard]] Result<void> look(const scene::Light& light, shadow::FinderKind finder, shadow::PhaseClock& clock);
  [[nodiscard]] std::size_t receiverCount() const;  ///< pixels that face the light
  [[nodiscard]] std::size_t silhouetteSize() const { return silhouette_.edges.size(); }
  /// The second: the sides that may change a pixel; returns how many pieces there are to fill.
  [[nodiscard]] Result<std::size_t> plan(shadow::PhaseClock& clock);
  /// REQUIRES: see(), look() and plan() for the same camera and light.
  [[nodiscard]] Result<shadow::LightMask> mask(const scene::Camera& camera, const scene::Light& light,
                                               shadow::PhaseClock& clock);
  /// Of the light last looked at.
  [[nodiscard]] shadow::LightStats stats(bool detailed) const;

 private:
  [[nodiscard]] std::uint64_t receiversIn(std::size_t block, FacingMemo& facing) const;
  void findCasters();
  Result<void> findReceivers(const Vec4& light);
  [[nodiscard]] double depthOf(std::uint32_t triangle, const Vec3& ray) const;

  std::shared_ptr<const shadow::Geometry> geometry_;
  std::optional<scene::Camera> camera_;  ///< whose pictures are here
  std::vector<std::uint32_t> casterOf_;  ///< per triangle of the surfaces
  std::unique_ptr<shadow::SilhouetteFinder> finder_;
  raster::SurfaceRaster surfaces_;
  raster::ShadowCount count_;
  raster::PixelSpace space_;
  raster::SeenPositions positions_;
  raster::SeenBlocks seen_;
  shadow::Silhouette silhouette_;
  std::vector<std::uint64_t> receivers_;  ///< per block
  std::vector<std::uint32_t> invisible_;  ///< caster triangles in whose plane the eye lies
};

}  // namespace umbrage::techniques::detail

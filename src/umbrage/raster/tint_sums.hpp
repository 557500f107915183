#pragma once

#include <optional>
#include <span>

#include "umbrage/raster/receiver_depths.hpp"
#include "umbrage/raster/surfaces.hpp"
#include "umbrage/shadow/tinted_silhouette.hpp"

namespace umbrage::raster {

/// What lies between a point and the light.
struct TintSum {
  std::int32_t opaque = 0;  ///< surfaces
  shadow::FilterSum filter{};
};

/// TintSums' numbers of the pixels of one layer: by channel the opaque surfaces, then what veils take of red, green and blue.
struct alignas(64) LayerSums {
  static constexpr std::size_t kChannels = 4;
  std::array<std::array<std::int32_t, kBlock * kBlock>, kChannels> channel;

  [[nodiscard]] TintSum at(std::size_t pixel) const {
    return {channel[0][pixel], {channel[1][pixel], channel[2][pixel], channel[3][pixel]}};
  }
};

/// Sums up, for every layer of every pixel, what lies between its surface and the light: shadow volumes by z-pass, as ShadowCount does it, of casters that
/// let light through. All layers and all colours are done in one pass over the sides.
///
/// The veils themselves, which the way from the eye crosses too, are not in these sums: of each pixel they are its layers.
/// Source: Kim, Kim and Turk, real-time shadows of transparent casters, 2008.
class TintSums {
 public:
  explicit TintSums(const shadow::CasterSet& casters) : casters_(casters) {}

  struct Request {
    const PixelSpace& space;
    const SeenPositions& positions;
    const LayeredBlocks& seen;
    std::span<const mesh::Triangle> triangles;  ///< what `seen` names
    /// Per layer of `seen`: bit k is set when its pixel k is asked for.
    std::span<const std::uint64_t> receivers;
    Box3 room;  ///< that holds them and the eye
    /// Caster triangles that `seen` leaves out: the way from the eye may cross them.
    std::span<const std::uint32_t> invisible;
    const shadow::TintedSilhouette& silhouette;
    const shadow::Filters& filters;
  };
  /// Per layer of `seen`; what it says of pixels that were not asked for means nothing.
  /// Errors: ErrorCode::device when memory runs out.
  [[nodiscard]] Result<void> find(const Request& request, std::vector<LayerSums>& out);

  [[nodiscard]] std::size_t sideCount() const { return bands_.patchCount(); }  ///< of the last time
  [[nodiscard]] const TintSum& atEye() const { return atEye_; }                ///< of the last time

 private:
  const shadow::CasterSet& casters_;
  ReceiverDepths depths_;
  Bands bands_;
  TintSum atEye_;
};

}  // namespace umbrage::raster

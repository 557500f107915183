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

/// What lies between the surfaces that pixels show and the light. Surfaces are numbered as VeilLayers does it.
class TintField {
 public:
  /// Opaque surfaces, then what veils take of red, green and blue.
  static constexpr std::size_t kChannels = 4;
  struct alignas(64) Sums {
    std::array<std::array<std::int32_t, kBlock * kBlock>, kChannels> channel;
  };

  [[nodiscard]] TintSum at(std::size_t block, std::size_t surface, std::size_t pixel) const {
    TintSum sum = whole[block];
    if (isWhole(surface)) return sum;
    const auto& more = sums[source[surface]].channel;
    sum.opaque += more[0][pixel];
    for (std::size_t k = 0; k < 3; ++k) sum.filter[k] += more[k + 1][pixel];
    return sum;
  }
  /// The same for all pixels of a surface.
  [[nodiscard]] bool isWhole(std::size_t surface) const { return source[surface] == kWhole; }

  static constexpr std::uint32_t kWhole = ~std::uint32_t{0};
  std::vector<TintSum> whole;  ///< per block: of all its pixels
  std::vector<std::uint32_t>
      source;  ///< per surface: the place in `sums` of what comes to `whole`, which surfaces that no side separates share; kWhole: nothing
  std::vector<Sums> sums;  ///< at most one a surface
};

/// Sums up, for every surface of every pixel, what lies between its surface and the light: shadow volumes by z-pass, as ShadowCount does it, of casters that
/// let light through. All surfaces and all colours are done in one pass over the sides.
///
/// The veils themselves, which the way from the eye crosses too, are not in these sums: they are the layers of each pixel.
/// Source: Kim, Kim and Turk, real-time shadows of transparent casters, 2008.
class TintSums {
 public:
  explicit TintSums(const shadow::CasterSet& casters) : casters_(casters) {}

  struct Request {
    const PixelSpace& space;
    const SeenPositions& positions;
    const SeenBlocks& seen;  ///< what is opaque
    const VeilLayers& veils;
    std::span<const mesh::Triangle> triangles;  ///< what both name
    /// Per surface: bit k is set when its pixel k is asked for.
    std::span<const std::uint64_t> receivers;
    Box3 room;  ///< that holds them and the eye
    /// Caster triangles that both leave out: the way from the eye may cross them.
    std::span<const std::uint32_t> invisible;
    const shadow::TintedSilhouette& silhouette;
    const shadow::Filters& filters;
  };
  /// What `out` says of pixels that were not asked for means nothing.
  /// Errors: ErrorCode::device when memory runs out.
  [[nodiscard]] Result<void> find(const Request& request, TintField& out);

  [[nodiscard]] std::size_t sideCount() const { return bands_.patchCount(); }  ///< of the last time
  [[nodiscard]] const TintSum& atEye() const { return atEye_; }                ///< of the last time

 private:
  const shadow::CasterSet& casters_;
  ReceiverDepths depths_;
  std::vector<ReceiverDepths::Depths> ofSurface_;
  Bands bands_;
  TintSum atEye_;
};

}  // namespace umbrage::raster

#pragma once

#include <functional>
#include <optional>
#include <span>

#include "umbrage/raster/receiver_depths.hpp"
#include "umbrage/raster/surfaces.hpp"
#include "umbrage/shadow/silhouette.hpp"

namespace umbrage::raster {

/// Counts, for every pixel, the caster surfaces between what it shows and the light: those that are there at the eye, and what changes
/// where the way from the eye crosses sides of shadow volumes. Shadow volumes by z-pass, with counters that cannot overflow, on the processor.
///
/// A side is looked at block by block. Where a block lies wholly within it and behind it, one number counts for all its pixels; where it
/// shows no receiver behind the side, none. So the cost goes with the length of the sides' borders more than with their area.
class ShadowCount {
 public:
  explicit ShadowCount(const shadow::CasterSet& casters) : casters_(&casters) {}
  /// Others. Memory is kept.
  void use(const shadow::CasterSet& casters) { casters_ = &casters, request_.reset(); }

  struct Request {
    const PixelSpace& space;
    const SeenPositions& positions;
    const SeenBlocks& seen;
    std::span<const mesh::Triangle> triangles;  ///< what `seen` names
    /// Per block of `seen`: bit k is set when pixel k is to be counted.
    std::span<const std::uint64_t> receivers;
    Box3 room;  ///< that holds them and the eye
    std::span<const std::uint32_t>
        invisible;  ///< caster triangles that `seen` leaves out: the way from the eye may cross them
    const shadow::Silhouette& silhouette;
  };
  /// Finds the sides that may change a pixel. All that `request` names must live until count() is done.
  /// Errors: ErrorCode::device when memory runs out.
  [[nodiscard]] Result<void> plan(const Request& request);
  /// What was counted in a block.
  struct Counted {
    std::size_t block;
    std::int32_t whole;          ///< for all its pixels
    const std::int32_t* pixels;  ///< for each by itself, to be added; null: nothing
    [[nodiscard]] std::int32_t at(std::size_t pixel) const { return whole + (pixels != nullptr ? pixels[pixel] : 0); }
  };
  /// Counts, per pixel that is to be counted, the caster surfaces between it and the light (0 when it is lit), and hands out block after block, from
  /// many threads. REQUIRES: plan(). Errors: as plan().
  [[nodiscard]] Result<void> count(const std::function<void(const Counted&)>& use);

  [[nodiscard]] std::size_t sideCount() const { return bands_.patchCount(); }  ///< of the last plan
  [[nodiscard]] std::size_t pieceCount() const {
    return bands_.entryCount();
  }                                                         ///< parts of sides in bands, of the last plan
  [[nodiscard]] int eyeCount() const { return eyeCount_; }  ///< of the last count

 private:
  const shadow::CasterSet* casters_;
  ReceiverDepths depths_;
  Bands bands_;
  std::optional<Request> request_;
  int eyeCount_ = 0;
};

}  // namespace umbrage::raster

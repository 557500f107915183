#pragma once

#include "drawing.hpp"

namespace umbrage::cli {

/// How far two techniques agree about one light.
struct Agreement {
  std::size_t differing = 0;  ///< pixels whose mask differs
  std::size_t astray = 0;     ///< those that no true shadow or depth edge comes near
  std::size_t covered = 0;    ///< pixels with a surface

  /// One pixel in 100,000 may stray: depths in single precision decide no finer.
  [[nodiscard]] std::size_t allowed() const { return covered / 100000; }
  [[nodiscard]] bool holds() const { return astray <= allowed(); }
};

/// Per light, which pixels of `mine` differ from `theirs`. A pixel that differs is astray unless an edge of the truth is within
/// the techniques' own tolerance: an edge of the mask, or one that 32 x 32 rays a pixel find. The truth is ray_traced where it is
/// one of the two, so that a lone wrong pixel is no edge of its own; else `theirs`.
[[nodiscard]] Result<std::vector<Agreement>> compareMasks(const Drawing& mine, const Drawing& theirs, const View& view,
                                                          const std::shared_ptr<const shadow::Geometry>& geometry);

}  // namespace umbrage::cli

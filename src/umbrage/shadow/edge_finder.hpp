#pragma once

#include <memory>

#include "umbrage/shadow/contours.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::shadow {

/// Tells whether a true shadow or depth edge is near a pixel: what decides if a technique may differ there from the truth.
class EdgeFinder {
 public:
  /// REQUIRES: `truth` is prepared for `geometry`, and gives every pixel's answer by rays of its own.
  EdgeFinder(std::shared_ptr<const Geometry> geometry, std::shared_ptr<Technique> truth);

  /// True when one of these holds:
  /// 1. an edge (trueEdges) touches the pixel (x, y) or one of its eight neighbours, as 32 x 32 samples a pixel show it;
  /// 2. a visible contour passes within 1/256 pixel of its centre, the grid to which rasterisers snap corners: an edge too, but one
  ///    beside which the gap, or the surface itself, may be narrower than those samples.
  /// Costs some 10,000 rays. Errors: the truth's own.
  [[nodiscard]] Result<bool> edgeNear(const scene::Camera& camera, const scene::Light& light, int x, int y) const;

 private:
  [[nodiscard]] Result<bool> samplesShowEdge(const scene::Camera& camera, const scene::Light& light, int x,
                                             int y) const;
  [[nodiscard]] Result<bool> sees(const scene::Camera& camera, const scene::Light& light,
                                  const ContourPoint& point) const;

  std::shared_ptr<const Geometry> geometry_;
  std::shared_ptr<Technique> truth_;
  Contours contours_;
};

}  // namespace umbrage::shadow

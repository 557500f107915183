#pragma once

#include <vector>

#include "umbrage/mesh/edge_table.hpp"
#include "umbrage/scene/camera.hpp"
#include "umbrage/scene/light.hpp"
#include "umbrage/scene/surfaces.hpp"

namespace umbrage::shadow {

/// A point of a contour in a picture.
struct ContourPoint {
  double x, y;  ///< pixels; whole numbers plus 0.5 are centres
  Vec3 fromEye;
};

/// The lines where surfaces end, or turn away from the eye or from the light: what depth edges and shadow edges consist of, also
/// where the gap beside them, or the surface itself, is too narrow to be seen.
class Contours {
 public:
  /// REQUIRES: `surfaces` outlives this.
  explicit Contours(const scene::Surfaces& surfaces);

  /// Of every contour within `pixels` of the point (x, y) of the picture, hidden or not, the nearest point.
  [[nodiscard]] std::vector<ContourPoint> near(const scene::Camera& camera, const scene::Light& light, double x,
                                               double y, double pixels) const;

 private:
  [[nodiscard]] bool turnsAway(std::size_t edge, const Vec4& from) const;

  const scene::Surfaces& surfaces_;
  mesh::EdgeTable edges_;
};

}  // namespace umbrage::shadow

#pragma once

#include <memory>
#include <optional>

#include "umbrage/cut/effort.hpp"
#include "umbrage/cut/face_cut.hpp"
#include "umbrage/scene/light.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::cut {

/// What becomes of a spot's cone.
enum class ConeSides {
  none,   ///< nothing: whoever asks knows who is inside (scene::insideCone)
  lines,  ///< faces are cut along it, as a pyramid of 720 sides: within 1e-5 of its radius
};

/// Cuts faces into what one light reaches and what it does not, each face by itself.
///
/// 1. A point of a face is lit when the face's side that faces the light does so (shadow::visibleSideFacesLight, seen from the light) and no caster lies
///    between them: the definition of ray_traced. A face the light rakes along is dark as a whole.
/// 2. The borders of shadows are right to about 1e-12 of the scene's size; at a low sun to that divided by the sine of its elevation over the face.
/// 3. Any triangles in any order and position are fine: coplanar, crossing, duplicate, the light in a corner or a plane.
/// Lights with an extent are their centre. Const once it is made; all functions may run in many threads at once.
/// Source: N. Chin and S. Feiner, Near real-time shadow generation using BSP trees, 1989. Theirs is one tree for all faces, sent into it front to back by
/// a BSP tree of the scene; here every face has the tree of those shadow planes that cross it, which needs no order: a plane stands for
/// an edge at which the number of surfaces before a point changes, and one ray a leaf says whether that number is 0.
class LightCutter {
 public:
  LightCutter(std::shared_ptr<const shadow::Geometry> geometry, const scene::Light& light, ConeSides cone);
  LightCutter(LightCutter&&) noexcept;
  LightCutter& operator=(LightCutter&&) noexcept;
  ~LightCutter();

  /// `triangle`: of Geometry::surfaces. Nothing when the effort is spent.
  [[nodiscard]] std::optional<FaceCut> cut(std::uint32_t triangle, Effort& effort) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace umbrage::cut

#pragma once

#include <array>
#include <vector>

#include "umbrage/scene/camera.hpp"
#include "umbrage/scene/light.hpp"
#include "umbrage/shadow/surface_buffer.hpp"
#include "umbrage/trace/light_rays.hpp"

namespace umbrage::techniques::detail {

/// A triangle's plane: points p with dot(normal, p) = offset; the normal is of unit length, or zero.
struct Plane {
  Vec3 normal;
  double offset;
  double reach;  ///< the largest coordinate of its corners when it casts, else 0
};
/// One a triangle, and after them one that stands for no triangle.
[[nodiscard]] std::vector<Plane> planesOf(const scene::Surfaces& surfaces);

/// What is seen through the pixels of a packet.
struct Seen8 {
  std::array<std::uint32_t, 8> triangle;
  std::array<float, 8> depth;
};

/// For one picture and one light: the surface points behind the pixels of a packet whose visible side faces the light, which decides
/// shadow::visibleSideFacesLight, and which lie inside its cone. Everything in double precision, all lanes at once.
/// REQUIRES: outlived by `surfaces`, `planes` = planesOf(surfaces) and `light`.
class FacingPoints {
 public:
  FacingPoints(const scene::Surfaces& surfaces, const std::vector<Plane>& planes, const scene::Camera& camera,
               const scene::Light& light);

  /// Triangles as the eye and the light see them, kept from packet to packet: neighbours mostly see the same.
  struct Faces {
    Faces() { triangle.fill(shadow::kNoTriangle); }
    std::array<std::uint32_t, 8> triangle;
    std::uint32_t lit = 0;    ///< bit k: the side of triangle[k] that the eye sees faces the light
    trace::Vec3Lanes normal;  ///< of unit length, on the eye's side; or zero
    /// Distances from the triangle's plane of the eye, at least 0, and of the light (for a direction: the sine of its elevation),
    /// above 0 on the eye's side.
    alignas(64) trace::Lanes eyeHeight, lightHeight;
    trace::Lanes reach;  ///< as SurfacePoints8 has it
  };

  /// `points` of the packet whose first pixel is (x, y). False where there is none, and `points` mean nothing.
  [[nodiscard]] bool place(const Seen8& seen, int x, int y, Faces& faces, trace::SurfacePoints8& points) const;

 private:
  void lookAt(Faces& faces) const;
  [[nodiscard]] std::uint32_t litLanes(const Faces& faces) const;
  [[nodiscard]] std::uint32_t exactlyLit(const Faces& faces, std::uint32_t lanes) const;
  void placePoints(const Seen8& seen, const Faces& faces, int x, int y, trace::SurfacePoints8& points) const;
  [[nodiscard]] std::uint32_t insideCone(const trace::SurfacePoints8& points) const;

  const scene::Surfaces& surfaces_;
  const std::vector<Plane>& planes_;
  const scene::Light& light_;
  Vec4 towards_;                    ///< the light, homogeneous and relative to the origin of the surfaces
  Vec3 eye_;                        ///< relative to the origin of the surfaces
  double sureOfEye_, sureOfLight_;  ///< heights over a triangle's plane above which their sign is beyond doubt
  scene::PixelRays rays_;
  trace::Vec3Lanes step_;  ///< from the direction through a packet's first pixel to its others
  double precision_;       ///< of shadow borders, at depth 1
};

}  // namespace umbrage::techniques::detail

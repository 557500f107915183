#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "umbrage/shadow/reach.hpp"
#include "umbrage/shadow/silhouette.hpp"

namespace umbrage::shadow {

/// A shadow volume as indices into doubled vertices: 2i is position i itself, 2i+1 is position i carried away from the light, to
/// infinity ((p - light, 0) for a point light, (-light, 0) for a direction) or to where its component's Reach ends.
/// 1. Outward faces are counter-clockwise.
/// 2. `sides` alone is what z-pass draws; `sides` and `caps` together are a closed surface, as z-fail needs.
/// 3. Near caps lie on the casters themselves and far caps at infinity or beyond the room that holds eye and receivers, so where the
///    casters are in the depth buffer, no cap fragment is ever nearer than the picture: z-fail may let every cap fragment fail its
///    depth test (no comparison, no z-fighting with the caster or with surfaces that lie in its plane).
struct ShadowVolume {
  std::vector<std::uint32_t> sides;  ///< triangles
  std::vector<std::uint32_t> caps;  ///< triangles: near caps, and far caps where the far vertices are not all one point

  [[nodiscard]] std::size_t triangleCount() const { return (sides.size() + caps.size()) / 3; }
};

struct ExtrudeOptions {
  bool caps = true;
  /// Per component of the casters: 0 leaves it out. Empty: all are extruded.
  std::span<const std::uint8_t> components;
  const Reach* reach = nullptr;  ///< null: every component reaches to infinity
  /// False leaves a side out. Empty: all are extruded.
  std::function<bool(const SilhouetteEdge&)> keepSide;
  /// `sides` holds edges instead of triangles, two indices each, for a shader that makes sides of them: from 2a to 2b where the near cap runs
  /// from a to b. A side is then the triangles (2b, 2a, 2a+1) and, unless both far vertices are one point, (2b, 2a+1, 2b+1).
  bool sidesAsEdges = false;
  /// Far vertices are never taken for one point, so that they may be carried anywhere: all sides are quads and all caps have far caps.
  bool endsAnywhere = false;
  /// Near caps in whose plane this point lies, relative to the origin of the casters, are left out: an eye there sees them edge-on, and single precision
  /// would tilt them into its view.
  std::optional<Vec3> eye = {};
};

/// Whether a point, relative to the origin of the casters, lies in the plane of any of their triangles (liesInPlane).
[[nodiscard]] bool isInAFacesPlane(const CasterSet& casters, const Vec3& point);

[[nodiscard]] ShadowVolume extrude(const CasterSet& casters, const Silhouette& silhouette,
                                   const ExtrudeOptions& options = {});

/// The caster surfaces between a point and the light.
struct SurfaceCount {
  int count = 0;    ///< crossed by the segment for certain
  int unclear = 0;  ///< whose border the segment touches as far as double arithmetic can tell; not in `count`
};

/// How many caster surfaces lie between `point` and the light, by the rule the volumes count with, in double precision and by
/// brute force over all triangles. `point` is relative to the origin of the casters. Surfaces that the silhouette leaves out, and
/// those in whose plane the point lies, do not count. Components with a nonzero entry in `skip` are left out.
[[nodiscard]] SurfaceCount countSurfaces(const CasterSet& casters, const Silhouette& silhouette, const Vec3& point,
                                         std::span<const std::uint8_t> skip = {});

/// Which they are, instead of how many.
struct CrossedSurfaces {
  std::vector<std::uint32_t> triangles;  ///< of the casters, ascending; those crossed for certain
  int unclear = 0;                       ///< as SurfaceCount has it
};
[[nodiscard]] CrossedSurfaces crossedSurfaces(const CasterSet& casters, const Silhouette& silhouette, const Vec3& point,
                                              std::span<const std::uint8_t> skip = {});

}  // namespace umbrage::shadow

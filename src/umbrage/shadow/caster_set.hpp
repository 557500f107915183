#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "umbrage/mesh/mesh_report.hpp"
#include "umbrage/scene/surfaces.hpp"

namespace umbrage::shadow {

/// An edge of the casters with every triangle that uses it.
struct CasterEdge {
  std::uint32_t a, b;        ///< positions, a before b in lexicographic order of coordinates
  std::uint32_t begin, end;  ///< its uses in CasterSet::uses
};

/// A triangle's part in an edge: multiplicity of the edge = sum of sign x lightSide(triangle).
struct CasterEdgeUse {
  std::uint32_t triangle;  ///< index into CasterSet::triangles
  std::int32_t sign;       ///< +1 when the sorted triangle A<B<C runs a -> b along A->B->C->A, else -1
};

/// A position that no caster uses.
inline constexpr std::uint32_t kNoComponent = ~std::uint32_t{0};

/// What casts shadows, ready for silhouettes: any triangle soup, any number of triangles at an edge.
/// 1. positions are relative to `origin`, free of duplicates; corners of triangles are in lexicographic order.
/// 2. Nothing is refused for its topology; `report` says what it is.
/// 3. A component is a convex solid when it is closed, every edge has two triangles, and no corner lies outside any of its
///    planes by more than rounding.
struct CasterSet {
  Vec3 origin{0.0};
  std::vector<Vec3f> positions;
  std::vector<mesh::Triangle> triangles;
  std::vector<std::uint32_t>
      surfaceTriangle;  ///< per triangle: its index in the Surfaces (or the given list) it came from
  std::vector<CasterEdge> edges;
  std::vector<CasterEdgeUse> uses;
  std::vector<std::uint32_t> componentOf;  ///< per triangle: its connected component
  std::uint32_t componentCount = 0;
  std::vector<Box3> componentBounds;               ///< per component: of its corners
  std::vector<std::uint32_t> componentOfPosition;  ///< per position: the one component that uses it, or kNoComponent
  /// Per triangle of a convex solid: the value of lightSide for a light on its outer side, +1 or -1; 0 for all other triangles.
  std::vector<std::int8_t> outward;
  Box3 bounds;  ///< of the corners of all triangles, relative to origin
  mesh::MeshReport report;

  [[nodiscard]] Vec3 position(std::uint32_t i) const { return Vec3(positions[i]); }
  [[nodiscard]] Vec3 corner(std::uint32_t triangle, int k) const { return Vec3(positions[triangles[triangle][k]]); }
};

/// The casting triangles of `surfaces`. Position indices are those of `surfaces`.
[[nodiscard]] CasterSet buildCasters(const scene::Surfaces& surfaces);

/// The same for surfaces that only moved since `before` was built from them (scene::flattenMoved): what buildCasters(surfaces) gives, bit by bit, in a part
/// of the time.
[[nodiscard]] CasterSet moveCasters(const scene::Surfaces& surfaces, CasterSet before);

/// For hosts that hold their own geometry: welds, sorts, drops what has no three different corners.
/// REQUIRES: every index < positions.size(); finite coordinates.
[[nodiscard]] CasterSet buildCasters(std::span<const Vec3f> positions, std::span<const mesh::Triangle> triangles);

}  // namespace umbrage::shadow

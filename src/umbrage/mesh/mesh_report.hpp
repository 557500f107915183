#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "umbrage/mesh/edge_table.hpp"
#include "umbrage/mesh/mesh.hpp"

namespace umbrage::mesh {

enum class Topology { empty, closed, open, nonManifold };
[[nodiscard]] const char* name(Topology topology);

/// What a welded mesh is like. Nothing here is a reason to refuse it.
struct MeshReport {
  std::size_t triangles = 0;
  std::size_t edges = 0;
  std::size_t borderEdges = 0;          ///< used by one triangle
  std::size_t nonManifoldEdges = 0;     ///< used by more than two
  std::size_t windingFlips = 0;         ///< edges of two triangles that run through it in the same direction
  std::size_t components = 0;           ///< pieces connected through shared corners
  Topology topology = Topology::empty;  ///< nonManifold before open before closed
};

/// REQUIRES: `edges` was built from `triangles`.
[[nodiscard]] MeshReport inspect(std::span<const Triangle> triangles, const EdgeTable& edges);

/// The connected component of every triangle (shared corners connect), numbered from 0 in the order of first occurrence.
struct Components {
  std::vector<std::uint32_t> ofTriangle;
  std::uint32_t count = 0;
};
[[nodiscard]] Components connectedComponents(std::span<const Triangle> triangles);

}  // namespace umbrage::mesh

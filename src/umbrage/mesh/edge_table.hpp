#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "umbrage/mesh/mesh.hpp"

namespace umbrage::mesh {

/// One use of an edge by a triangle.
struct EdgeUse {
  std::uint32_t triangle;
  std::uint8_t opposite;  ///< which corner of the triangle (0..2) the edge does not touch
};

/// Every undirected edge with every triangle that uses it, any number of them.
/// 1. ends[i][0] < ends[i][1]; edges are sorted by their ends.
/// 2. uses of edge i: [begin[i], begin[i+1]), in the order of the triangles. begin has one entry more than ends.
struct EdgeTable {
  std::vector<std::array<std::uint32_t, 2>> ends;
  std::vector<std::uint32_t> begin;
  std::vector<EdgeUse> uses;

  [[nodiscard]] std::size_t size() const { return ends.size(); }
  [[nodiscard]] std::span<const EdgeUse> usesOf(std::size_t edge) const {
    return std::span(uses).subspan(begin[edge], begin[edge + 1] - begin[edge]);
  }
};

/// Triangles that name a corner twice contribute their proper edges only (an edge from a corner to itself is left out).
[[nodiscard]] EdgeTable buildEdgeTable(std::span<const Triangle> triangles);

}  // namespace umbrage::mesh

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "umbrage/math/vec.hpp"

namespace umbrage::mesh {

/// Identical positions made one. -0 and +0 are the same; nothing else is: no tolerance, so geometry never moves.
struct Weld {
  std::vector<std::uint32_t> first;  ///< per welded point: the index of its first occurrence, ascending
  std::vector<std::uint32_t> remap;  ///< per given point: its welded index
};

[[nodiscard]] Weld weld(std::span<const Vec3> positions);
[[nodiscard]] Weld weld(std::span<const Vec3f> positions);

}  // namespace umbrage::mesh

#pragma once

#include <cstdint>
#include <vector>

#include "umbrage/base/error.hpp"
#include "umbrage/io/reader/tinygltf.hpp"
#include "umbrage/math/vec.hpp"

namespace umbrage::io::reader {

/// The elements of an accessor, sparse ones filled in, normalised integers as fractions. Every offset, stride and count is held
/// against the buffers. Errors: an index out of range, a wrong type, data beyond its buffer.
[[nodiscard]] Result<std::vector<Vec3>> readPoints(const tinygltf::Model& model, int accessor);
[[nodiscard]] Result<std::vector<Vec2>> readCoordinates(const tinygltf::Model& model, int accessor);
[[nodiscard]] Result<std::vector<std::uint32_t>> readIndices(const tinygltf::Model& model, int accessor);

}  // namespace umbrage::io::reader

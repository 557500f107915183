#pragma once

#include <optional>
#include <vector>

#include "umbrage/base/error.hpp"
#include "umbrage/io/reader/tinygltf.hpp"
#include "umbrage/math/vec.hpp"
#include "umbrage/mesh/mesh.hpp"

namespace umbrage::io::reader {

/// The triangles of a primitive: strips and fans taken apart. Corners may not exist.
struct PrimitiveTriangles {
  std::vector<Vec3> points;
  std::vector<mesh::Triangle> triangles;
};

/// Points and lines have no triangles; a primitive without positions gives nothing. Errors: broken accessors, compression.
[[nodiscard]] Result<std::optional<PrimitiveTriangles>> readPrimitive(const tinygltf::Model& model,
                                                                      const tinygltf::Primitive& primitive);

inline constexpr const char* kDraco = "KHR_draco_mesh_compression";

}  // namespace umbrage::io::reader

#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "umbrage/base/error.hpp"
#include "umbrage/scene/scene.hpp"

namespace umbrage::io {

/// Triangles with a colour at every corner.
struct ColouredMesh {
  std::vector<Vec3> positions;
  std::vector<mesh::Triangle> triangles;
  std::vector<Vec3f> colours;   ///< per position: linear RGB in [0, 1]
  std::vector<Vec3f> exitance;  ///< per position: linear RGB as it was computed, of any brightness
};

/// Writes it in the format of the path's extension, whole or not at all: .glb (binary glTF 2.0) or .ply (binary, little-endian). Same mesh, same bytes.
/// 1. Both are in metres with Y up, as writeScene has them; `frame` says what the coordinates are. Positions are in single precision in .glb,
///    around the middle of the mesh, in double precision in .ply.
/// 2. .glb: COLOR_0 in single precision, linear, unlit (KHR_materials_unlit), and the exitance as _EXITANCE. .ply: red, green, blue as 8-bit sRGB,
///    and exitance_red, exitance_green, exitance_blue in single precision.
/// REQUIRES: one colour and one exitance a position, indices in range. Errors: usage (unknown extension), output (cannot be written).
[[nodiscard]] Result<void> writeColoured(const ColouredMesh& mesh, const scene::Scene& frame,
                                         const std::filesystem::path& path);

}  // namespace umbrage::io

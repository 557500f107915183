#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "umbrage/base/error.hpp"
#include "umbrage/scene/scene.hpp"

namespace umbrage::io {

/// Writes a scene in the format of the path's extension, whole or not at all: .glb (binary glTF 2.0), .iv (Open Inventor 2.1,
/// text), .city.json or .json (CityJSON 2.0), .obj (with the materials in an .mtl beside it). Same scene, same bytes.
///
/// 1. All files are in metres. .glb, .iv and .obj have Y up, CityJSON has Z up, as viewers expect: the scene is turned, exactly
///    ((x, y, z) -> (x, z, -y) from Z up to Y up), by a root node in .glb and .iv, whose meshes keep their own coordinates.
/// 2. No triangle, part or level of the hierarchy is lost, save triangles without three different corners in CityJSON. Meshes
///    that instances share stay shared in .glb and .iv.
/// 3. Positions: .glb and .iv in single precision; a mesh that it does not hold exactly is stored around its middle, with a
///    translation in double precision, and is off by at most 2^-24 of its size. .obj in double precision. CityJSON in whole
///    multiples of 2^-k m, with the smallest k that loses nothing, or 2^-20 m (a micrometre) where none does.
/// 4. Colour, opacity and the names of materials are kept (sRGB in .iv, .obj and CityJSON; linear in .glb). Material::filter is kept in
///    .glb alone, as a remark that loadScene reads; the others have no place for it, and what passes is (1 - opacity) x colour again.
/// 5. CityJSON: top levels are Buildings, what is below them BuildingParts; a part whose pieces are all closed and wound outwards
///    is one Solid for each piece, any other a MultiSurface.
/// 6. loadScene gives the names of parts back as they were, but: .obj has '_' for '/' and blanks; CityJSON numbers levels whose
///    name is taken ("Body (2)"). In .iv the names that other readers see have only letters, digits and '_'; materials too.
///    Of more than 64 levels the last are one, and a name has at most 400 bytes.
/// Errors: usage (unknown extension), input (a scene with a fault), output (cannot be written, or more than 4 GiB of .glb).
/// CAVEAT: lights are not written. `casts` is kept only as a remark in .glb and CityJSON, northOffset only in .glb.
[[nodiscard]] Result<void> writeScene(const scene::Scene& scene, const std::filesystem::path& path);

/// The extensions that writeScene knows, lower case, without the dot.
[[nodiscard]] std::span<const std::string_view> writableExtensions();

}  // namespace umbrage::io

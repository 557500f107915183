#include "umbrage/io/reader/city_mesh.hpp"

#include <cmath>

#include "umbrage/io/reader/json_access.hpp"
#include "umbrage/io/reader/surface_colours.hpp"
#include "umbrage/io/reader/tidy.hpp"

namespace umbrage::io::reader {
namespace {

// How many arrays lie round the surfaces of a geometry; nothing for geometries without surfaces.
std::optional<int> levelsOf(const std::string& type) {
  if (type == "MultiSurface" || type == "CompositeSurface") return 1;
  if (type == "Solid") return 2;
  if (type == "MultiSolid" || type == "CompositeSolid") return 3;
  return std::nullopt;
}

bool isFinite(const Vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

// The indices of the first theme: a nested "values" beside the boundaries, or one "value" for all of them.
const Json& firstTheme(const Json& material) {
  if (!material.is_object() || material.empty()) return member(material, "");
  const Json& theme = material.begin().value();
  const Json& values = member(theme, "values");
  return values.is_null() ? member(theme, "value") : values;
}

// One step down beside the boundaries; a single index holds for everything below it.
const Json& below(const Json& values, std::size_t i) { return values.is_array() ? element(values, i) : values; }

}  // namespace

void CityMaterials::addAppearance(const Json& document) {
  for (const Json& entry : member(member(document, "appearance"), "materials")) {
    scene::Material m;
    m.name = textOf(member(entry, "name"));
    m.colour = linearFromSrgb(vectorOf(member(entry, "diffuseColor")).value_or(Vec3(0.8)));
    m.opacity = 1.0 - numberOf(member(entry, "transparency")).value_or(0.0);
    appearance_.push_back(static_cast<std::uint32_t>(materials_.size()));
    materials_.push_back(std::move(m));
  }
}

std::uint32_t CityMaterials::ofType(const std::string& type) {
  const auto [at, isNew] = types_.try_emplace(type, static_cast<std::uint32_t>(materials_.size()));
  if (isNew) materials_.push_back({type, colourOfType(type), 1.0});
  return at->second;
}

std::optional<std::uint32_t> CityMaterials::ofAppearance(std::size_t index) const {
  return index < appearance_.size() ? std::optional(appearance_[index]) : std::nullopt;
}

// What decides the material of a surface, walked down together with the boundaries.
struct CityMesh::Look {
  const Json& surfaces;    ///< semantic surface objects
  const Json& semantics;   ///< nested indices into them
  const Json& appearance;  ///< nested indices into the file's materials
  const std::string& objectType;
};

void CityMesh::add(const Json& geometry, const std::string& objectType) {
  const auto levels = levelsOf(textOf(member(geometry, "type")));
  if (!levels) return;
  const Json& semantics = member(geometry, "semantics");
  addNested(member(geometry, "boundaries"), *levels,
            {member(semantics, "surfaces"), member(semantics, "values"), firstTheme(member(geometry, "material")),
             objectType});
}

void CityMesh::addNested(const Json& boundaries, int levels, const Look& look) {
  if (levels == 0) return addSurface(boundaries, look);
  if (!boundaries.is_array()) {
    ++counts_.seen;
    ++counts_.malformed;
    return;
  }
  for (std::size_t i = 0; i < boundaries.size(); ++i)
    addNested(boundaries[i], levels - 1,
              {look.surfaces, below(look.semantics, i), below(look.appearance, i), look.objectType});
}

bool CityMesh::readRings(const Json& rings, Rings& out) {
  if (!rings.is_array() || rings.empty()) return ++counts_.malformed, false;
  for (const Json& ring : rings) {
    if (!ring.is_array()) return ++counts_.malformed, false;
    std::vector<std::uint32_t> corners;
    for (const Json& value : ring) {
      if (!value.is_number_integer()) return ++counts_.malformed, false;
      const auto vertex = indexOf(value);
      if (!vertex || *vertex >= vertices_.size() || !isFinite(vertices_[*vertex])) return ++counts_.outOfRange, false;
      corners.push_back(corner(*vertex));
    }
    out.push_back(std::move(corners));
  }
  return true;
}

void CityMesh::addSurface(const Json& rings, const Look& look) {
  ++counts_.seen;
  Rings corners;
  if (!readRings(rings, corners)) return;
  const auto triangles = triangulate(mesh_.positions, corners);
  if (triangles.empty()) ++counts_.degenerate;
  mesh_.triangles.insert(mesh_.triangles.end(), triangles.begin(), triangles.end());
  mesh_.materials.insert(mesh_.materials.end(), triangles.size(), triangles.empty() ? 0 : materialOf(look));
}

std::uint32_t CityMesh::materialOf(const Look& look) {
  if (const auto index = indexOf(look.appearance))
    if (const auto material = materials_.ofAppearance(*index)) return *material;
  if (const auto index = indexOf(look.semantics))
    if (const std::string type = textOf(member(element(look.surfaces, *index), "type")); !type.empty())
      return materials_.ofType(type);
  return materials_.ofType(look.objectType);
}

std::uint32_t CityMesh::corner(std::size_t vertex) {
  const auto [at, isNew] = corners_.try_emplace(vertex, static_cast<std::uint32_t>(mesh_.positions.size()));
  if (isNew) mesh_.positions.push_back(vertices_[vertex]);
  return at->second;
}

}  // namespace umbrage::io::reader

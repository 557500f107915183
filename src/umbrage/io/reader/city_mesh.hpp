#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <unordered_map>
#include <vector>

#include "umbrage/io/reader/polygon.hpp"
#include "umbrage/scene/scene.hpp"

namespace umbrage::io::reader {

/// The materials of a CityJSON file: those of its appearance, and one per type of surface or object, made when first asked for.
class CityMaterials {
 public:
  explicit CityMaterials(std::vector<scene::Material>& materials) : materials_(materials) {}
  void addAppearance(const nlohmann::json& document);
  [[nodiscard]] std::uint32_t ofType(const std::string& type);
  [[nodiscard]] std::optional<std::uint32_t> ofAppearance(std::size_t index) const;

 private:
  std::vector<scene::Material>& materials_;
  std::vector<std::uint32_t> appearance_;
  std::map<std::string, std::uint32_t> types_;
};

/// How many surfaces were seen, and how many of them had to be left out.
struct SurfaceCounts {
  std::size_t seen = 0, malformed = 0, outOfRange = 0, degenerate = 0;
};

/// Collects the surfaces of one city object (or template) as triangles of one mesh.
class CityMesh {
 public:
  CityMesh(const std::vector<Vec3>& vertices, CityMaterials& materials, SurfaceCounts& counts)
      : vertices_(vertices), materials_(materials), counts_(counts) {}
  /// Adds a geometry object; types without surfaces (points, lines, instances) add nothing.
  void add(const nlohmann::json& geometry, const std::string& objectType);
  [[nodiscard]] mesh::Mesh take() { return std::move(mesh_); }

 private:
  struct Look;
  void addNested(const nlohmann::json& boundaries, int levels, const Look& look);
  void addSurface(const nlohmann::json& rings, const Look& look);
  [[nodiscard]] bool readRings(const nlohmann::json& rings, Rings& out);
  [[nodiscard]] std::uint32_t materialOf(const Look& look);
  [[nodiscard]] std::uint32_t corner(std::size_t vertex);

  const std::vector<Vec3>& vertices_;
  CityMaterials& materials_;
  SurfaceCounts& counts_;
  mesh::Mesh mesh_;
  std::unordered_map<std::size_t, std::uint32_t> corners_;
};

}  // namespace umbrage::io::reader

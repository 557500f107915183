// CityJSON 2.0. Source: Ledoux et al., CityJSON: a compact and easy-to-use encoding of the CityGML data model, 2019; cityjson.org/specs/2.0.
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "umbrage/io/writer/common.hpp"
#include "umbrage/io/writer/writers.hpp"
#include "umbrage/mesh/mesh_report.hpp"
#include "umbrage/mesh/weld.hpp"

namespace umbrage::io::writer {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFinest = 20;  // 2^-20 m

/// All parts on one lattice: position = translate + vertex * 2^-bits.
struct Quantised {
  Vec3 translate{0.0};
  double scale = 1.0;
  std::vector<Vec3> vertices;                      // whole numbers, each once
  std::vector<std::vector<mesh::Triangle>> parts;  // per instance, outward as its mesh is
};

/// The smallest number of binary digits after the point that holds all of `positions` relative to `origin`.
int digitsNeeded(const std::vector<Vec3>& positions, const Vec3& origin) {
  int bits = 0;
  for (const Vec3& p : positions) {
    const auto whole = [&] {
      const Vec3 scaled = (p - origin) * std::ldexp(1.0, bits);
      return scaled == glm::round(scaled);
    };
    while (bits < kFinest && !whole()) ++bits;
  }
  return bits;
}

Quantised quantise(const scene::Scene& scene) {
  const Mat4 turn = toMetres(scene, scene::UpAxis::z);
  std::vector<Vec3> positions;
  Quantised result;
  for (const scene::Instance& instance : scene.instances) {
    const mesh::Mesh& m = *scene.meshes[instance.mesh];
    const Mat4 placed = turn * instance.toWorld;
    const bool mirrored = glm::dot(glm::cross(Vec3(placed[0]), Vec3(placed[1])), Vec3(placed[2])) < 0.0;
    auto& part = result.parts.emplace_back();
    for (mesh::Triangle t : m.triangles) {
      if (mirrored) std::swap(t[1], t[2]);
      for (std::uint32_t& corner : t) {
        positions.push_back(transformPoint(placed, m.positions[corner]));
        corner = static_cast<std::uint32_t>(positions.size() - 1);
      }
      part.push_back(t);
    }
  }
  Box3 box;
  for (const Vec3& p : positions) box.add(p);
  if (!box.empty()) result.translate = glm::floor(box.min);
  const int bits = digitsNeeded(positions, result.translate);
  result.scale = std::ldexp(1.0, -bits);
  for (Vec3& p : positions) p = glm::round((p - result.translate) * std::ldexp(1.0, bits));
  const mesh::Weld weld = mesh::weld(positions);
  for (const std::uint32_t first : weld.first) result.vertices.push_back(positions[first]);
  for (auto& part : result.parts)
    for (mesh::Triangle& t : part)
      for (std::uint32_t& corner : t) corner = weld.remap[corner];
  return result;
}

/// A part's triangles with their materials, split into its pieces when all of them are solids.
struct Shell {
  std::vector<mesh::Triangle> triangles;
  std::vector<std::uint32_t> materials;
};

double volume(const Shell& shell, const std::vector<Vec3>& vertices) {
  double sum = 0.0;
  const Vec3 origin = shell.triangles.empty() ? Vec3(0.0) : vertices[shell.triangles[0][0]];
  for (const auto& [a, b, c] : shell.triangles)
    sum += glm::dot(vertices[a] - origin, glm::cross(vertices[b] - origin, vertices[c] - origin));
  return sum;
}

/// Empty when the part is not made of closed pieces wound outwards.
std::vector<Shell> solidsOf(const Shell& part, const std::vector<Vec3>& vertices) {
  const mesh::MeshReport report = mesh::inspect(part.triangles, mesh::buildEdgeTable(part.triangles));
  if (report.topology != mesh::Topology::closed || report.windingFlips > 0) return {};
  const mesh::Components pieces = mesh::connectedComponents(part.triangles);
  std::vector<Shell> shells(pieces.count);
  for (std::size_t t = 0; t < part.triangles.size(); ++t) {
    shells[pieces.ofTriangle[t]].triangles.push_back(part.triangles[t]);
    shells[pieces.ofTriangle[t]].materials.push_back(part.materials[t]);
  }
  const bool solid =
      std::all_of(shells.begin(), shells.end(), [&](const Shell& s) { return volume(s, vertices) > 0.0; });
  return solid ? shells : std::vector<Shell>{};
}

Json geometryJson(const Shell& shell, bool solid) {
  Json surfaces = Json::array();
  for (const auto& [a, b, c] : shell.triangles) surfaces.push_back(Json::array({Json::array({a, b, c})}));
  const bool uniform = std::adjacent_find(shell.materials.begin(), shell.materials.end(), std::not_equal_to<>()) ==
                       shell.materials.end();
  Json json;
  json["type"] = solid ? "Solid" : "MultiSurface";
  json["lod"] = "3";
  json["boundaries"] = solid ? Json::array({std::move(surfaces)}) : std::move(surfaces);
  Json& look = json["material"]["default"];
  if (uniform)
    look["value"] = shell.materials.front();
  else
    look["values"] = solid ? Json::array({shell.materials}) : Json(shell.materials);
  return json;
}

/// CityObjects by id: an object for every level of the hierarchy, each with its parent.
class CityObjects {
 public:
  /// The object for a path, with the objects above it. One that has a geometry is not given again.
  Json& at(const std::vector<std::string>& path);
  [[nodiscard]] Json take() && { return std::move(objects_); }

 private:
  std::string idOf(const std::vector<std::string>& path);

  std::map<std::vector<std::string>, std::string> ids_;
  std::set<std::string> taken_;
  Json objects_ = Json::object();
};

std::string CityObjects::idOf(const std::vector<std::string>& path) {
  if (const auto known = ids_.find(path); known != ids_.end()) return known->second;
  std::string id = path.back();
  for (int number = 2; !taken_.insert(id).second; ++number) id = path.back() + " (" + std::to_string(number) + ")";
  ids_[path] = id;
  Json object;
  object["type"] = path.size() == 1 ? "Building" : "BuildingPart";
  if (path.size() > 1) {
    const std::string parent = idOf({path.begin(), path.end() - 1});
    object["parents"].push_back(parent);
    objects_[parent]["children"].push_back(id);
  }
  object["geometry"] = Json::array();
  objects_[id] = std::move(object);
  return id;
}

Json& CityObjects::at(const std::vector<std::string>& path) {
  Json& object = objects_[idOf(path)];
  if (object["geometry"].empty()) return object;
  ids_.erase(path);
  return objects_[idOf(path)];
}

Json vectorJson(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

Json materialsJson(const scene::Scene& scene) {
  Json materials = Json::array();
  for (const scene::Material& m : scene.materials) {
    Json json;
    json["name"] = m.name;
    json["diffuseColor"] = vectorJson(srgbFromLinear(m.colour));
    json["transparency"] = 1.0 - m.opacity;
    materials.push_back(std::move(json));
  }
  return materials;
}

Json metadataJson(const scene::Scene& scene, const Quantised& data) {
  Box3 box;
  for (const Vec3& v : data.vertices) box.add(data.translate + data.scale * v);
  Json json;
  if (!box.empty()) json["geographicalExtent"] = {box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z};
  if (scene.crs.starts_with("EPSG:"))
    json["referenceSystem"] = "https://www.opengis.net/def/crs/EPSG/0/" + scene.crs.substr(5);
  return json;
}

Json objectsJson(const scene::Scene& scene, const Quantised& data) {
  CityObjects objects;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const scene::Instance& instance = scene.instances[i];
    const mesh::Mesh& m = *scene.meshes[instance.mesh];
    Shell part;
    for (std::size_t t = 0; t < data.parts[i].size(); ++t) {
      const auto& [a, b, c] = data.parts[i][t];
      if (a == b || b == c || c == a) continue;
      part.triangles.push_back({a, b, c});
      part.materials.push_back(materialOf(m, t));
    }
    if (part.triangles.empty()) continue;
    Json& object = objects.at(levels(instance.name));
    if (!instance.casts) object["attributes"]["casts"] = false;
    const std::vector<Shell> solids = solidsOf(part, data.vertices);
    for (const Shell& solid : solids) object["geometry"].push_back(geometryJson(solid, true));
    if (solids.empty()) object["geometry"].push_back(geometryJson(part, false));
  }
  return std::move(objects).take();
}

}  // namespace

Result<Document> cityJson(const scene::Scene& scene, const std::string&) {
  const Quantised data = quantise(scene);
  Json json;
  json["type"] = "CityJSON";
  json["version"] = "2.0";
  json["transform"]["scale"] = vectorJson(Vec3(data.scale));
  json["transform"]["translate"] = vectorJson(data.translate);
  if (Json metadata = metadataJson(scene, data); !metadata.empty()) json["metadata"] = std::move(metadata);
  json["appearance"]["materials"] = materialsJson(scene);
  json["CityObjects"] = objectsJson(scene, data);
  Json& vertices = json["vertices"] = Json::array();
  for (const Vec3& v : data.vertices)
    vertices.push_back(Json::array({std::llround(v.x), std::llround(v.y), std::llround(v.z)}));
  return Document{json.dump(-1, ' ', false, Json::error_handler_t::replace), {}, {}};
}

}  // namespace umbrage::io::writer

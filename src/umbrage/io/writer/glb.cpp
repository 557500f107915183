// Binary glTF 2.0. Assembled here rather than by a library: it is one JSON text and one block of numbers, and this way the room
// needs no parser. Source: Khronos, glTF 2.0 specification, 2021.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "umbrage/io/writer/common.hpp"
#include "umbrage/io/writer/glb_file.hpp"
#include "umbrage/io/writer/writers.hpp"

namespace umbrage::io::writer {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF stores numbers with the least byte first");

using Json = nlohmann::ordered_json;

constexpr int kFloat = 5126, kUnsignedInt = 5125;
constexpr int kVertices = 34962, kIndices = 34963;

Json vectorJson(const Vec3& v) { return {v.x, v.y, v.z}; }

Json matrixJson(const Mat4& m) {
  Json numbers = Json::array();
  for (int i = 0; i < 16; ++i) numbers.push_back(m[i / 4][i % 4] + 0.0);
  return numbers;
}

// Factors are at most 1; what shines brighter has a strength beside.
void addEmission(Json& json, const Vec3& emission) {
  const double strength = std::max({1.0, emission.x, emission.y, emission.z});
  json["emissiveFactor"] = vectorJson(emission / strength);
  if (strength > 1.0) json["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = strength;
}

Json materialJson(const scene::Material& material) {
  Json json;
  if (!material.name.empty()) json["name"] = material.name;
  Json& surface = json["pbrMetallicRoughness"];
  surface["baseColorFactor"] = {material.colour.x, material.colour.y, material.colour.z, material.opacity};
  // A mirror is a smooth metal (see the reader).
  surface["metallicFactor"] = material.mirror > 0.0 ? 1.0 : 0.0;
  surface["roughnessFactor"] = material.mirror > 0.0 ? 1.0 - std::sqrt(material.mirror) : 0.9;
  if (material.emission != Vec3(0.0)) addEmission(json, material.emission);
  if (material.ior > 1.0) {
    json["extensions"]["KHR_materials_ior"]["ior"] = material.ior;
    json["extensions"]["KHR_materials_volume"]["thicknessFactor"] = 1.0;
  }
  json["doubleSided"] = true;
  if (material.opacity < 1.0) json["alphaMode"] = "BLEND";
  // No extension knows a filter of its own: KHR_materials_transmission filters with the base colour.
  if (material.filter) json["extras"]["filter"] = vectorJson(*material.filter);
  return json;
}

class GlbWriter {
 public:
  explicit GlbWriter(const scene::Scene& scene) : scene_(scene), shared_(scene.meshes.size()) {}

  Result<Document> write();

 private:
  struct Shared {
    int mesh;
    Vec3 origin;
  };
  int addNode(const std::string& name, std::optional<int> parent);
  void addInstance(const scene::Instance& instance);
  int groupOf(const std::vector<std::string>& path);
  const Shared& meshOf(std::uint32_t index);
  template <class T>
  int addView(const std::vector<T>& values, int target);
  int addPositions(const std::vector<Vec3f>& positions);
  int addIndices(const mesh::Mesh& m, std::uint32_t material);
  [[nodiscard]] Json document() const;

  const scene::Scene& scene_;
  std::vector<std::optional<Shared>> shared_;
  std::vector<Json> nodes_;
  std::map<std::vector<std::string>, int> groups_;
  Json meshes_ = Json::array(), accessors_ = Json::array(), views_ = Json::array();
  std::string binary_;
};

int GlbWriter::addNode(const std::string& name, std::optional<int> parent) {
  const int node = static_cast<int>(nodes_.size());
  nodes_.push_back(name.empty() ? Json::object() : Json{{"name", name}});
  if (parent) nodes_[static_cast<std::size_t>(*parent)]["children"].push_back(node);
  return node;
}

/// Groups carry no transform: every part's matrix is its own, whatever stands above it in the hierarchy.
int GlbWriter::groupOf(const std::vector<std::string>& path) {
  if (path.empty()) return 0;
  if (const auto known = groups_.find(path); known != groups_.end()) return known->second;
  const int parent = groupOf({path.begin(), path.end() - 1});
  return groups_[path] = addNode(path.back(), parent);
}

void GlbWriter::addInstance(const scene::Instance& instance) {
  if (scene_.meshes[instance.mesh]->triangles.empty()) return;
  const Shared& shared = meshOf(instance.mesh);
  std::vector<std::string> path = levels(instance.name);
  const std::string name = path.back();
  path.pop_back();
  Json& node = nodes_[static_cast<std::size_t>(addNode(name, groupOf(path)))];
  node["mesh"] = shared.mesh;
  Mat4 placed = instance.toWorld;
  placed[3] = instance.toWorld * Vec4(shared.origin, 1.0);
  if (placed != Mat4(1.0)) node["matrix"] = matrixJson(placed);
  if (!instance.casts) node["extras"]["casts"] = false;
}

const GlbWriter::Shared& GlbWriter::meshOf(std::uint32_t index) {
  auto& shared = shared_[index];
  if (shared) return *shared;
  const mesh::Mesh& m = *scene_.meshes[index];
  const SinglePrecision single = inSinglePrecision(m);
  const int positions = addPositions(single.positions);
  Json primitives = Json::array();
  for (const std::uint32_t material : usedMaterials(m)) {
    Json primitive;
    primitive["attributes"]["POSITION"] = positions;
    primitive["indices"] = addIndices(m, material);
    primitive["material"] = material;
    primitives.push_back(std::move(primitive));
  }
  shared = Shared{static_cast<int>(meshes_.size()), single.origin};
  Json json;
  if (!m.name.empty()) json["name"] = m.name;
  json["primitives"] = std::move(primitives);
  meshes_.push_back(std::move(json));
  return *shared;
}

template <class T>
int GlbWriter::addView(const std::vector<T>& values, int target) {
  const std::size_t bytes = values.size() * sizeof(T);
  views_.push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes}, {"target", target}});
  binary_.append(reinterpret_cast<const char*>(values.data()), bytes);
  return static_cast<int>(views_.size()) - 1;
}

int GlbWriter::addPositions(const std::vector<Vec3f>& positions) {
  Box3 box;
  for (const Vec3f& p : positions) box.add(Vec3(p));
  accessors_.push_back({{"bufferView", addView(positions, kVertices)},
                        {"componentType", kFloat},
                        {"count", positions.size()},
                        {"type", "VEC3"},
                        {"min", vectorJson(box.min)},
                        {"max", vectorJson(box.max)}});
  return static_cast<int>(accessors_.size()) - 1;
}

int GlbWriter::addIndices(const mesh::Mesh& m, std::uint32_t material) {
  std::vector<std::uint32_t> corners;
  for (std::size_t t = 0; t < m.triangles.size(); ++t)
    if (materialOf(m, t) == material) corners.insert(corners.end(), m.triangles[t].begin(), m.triangles[t].end());
  accessors_.push_back({{"bufferView", addView(corners, kIndices)},
                        {"componentType", kUnsignedInt},
                        {"count", corners.size()},
                        {"type", "SCALAR"}});
  return static_cast<int>(accessors_.size()) - 1;
}

Json GlbWriter::document() const {
  Json json;
  json["asset"]["version"] = "2.0";
  json["asset"]["generator"] = "umbrage";
  json["scene"] = 0;
  Json root;
  root["nodes"].push_back(0);
  Json extras = Json::object();
  if (scene_.northOffset != Angle()) extras["northOffsetDegrees"] = scene_.northOffset.degrees();
  if (!scene_.crs.empty()) extras["crs"] = scene_.crs;
  if (!extras.empty()) root["extras"] = extras;
  json["scenes"].push_back(std::move(root));
  json["nodes"] = nodes_;
  std::set<std::string> used;
  for (const scene::Material& material : scene_.materials) {
    Json& last = json["materials"].emplace_back(materialJson(material));
    if (last.contains("extensions"))
      for (const auto& extension : last["extensions"].items()) used.insert(extension.key());
  }
  for (const std::string& extension : used) json["extensionsUsed"].push_back(extension);
  if (meshes_.empty()) return json;
  json["meshes"] = meshes_;
  json["accessors"] = accessors_;
  json["bufferViews"] = views_;
  json["buffers"].push_back(Json{{"byteLength", binary_.size()}});
  return json;
}

Result<Document> GlbWriter::write() {
  addNode("", std::nullopt);
  if (const Mat4 turn = toMetres(scene_, scene::UpAxis::y); turn != Mat4(1.0)) nodes_[0]["matrix"] = matrixJson(turn);
  for (const scene::Instance& instance : scene_.instances) addInstance(instance);
  // Names that are not UTF-8 are mended, not refused.
  const std::string text = document().dump(-1, ' ', false, Json::error_handler_t::replace);
  auto bytes = glbFile(text, std::move(binary_));
  if (!bytes) return tl::unexpected(bytes.error());
  return Document{std::move(*bytes), {}, {}};
}

}  // namespace

Result<Document> glb(const scene::Scene& scene, const std::string&) { return GlbWriter(scene).write(); }

}  // namespace umbrage::io::writer

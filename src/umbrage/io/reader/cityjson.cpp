// CityJSON 1.0 to 2.0 and CityJSONSeq. Coordinates are vertex * scale + translate in double precision, up is Z, the unit is the
// metre as the specification demands.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <unordered_map>

#include "umbrage/geo/projection.hpp"
#include "umbrage/io/reader/city_mesh.hpp"
#include "umbrage/io/reader/files.hpp"
#include "umbrage/io/reader/geojson.hpp"
#include "umbrage/io/reader/json_access.hpp"
#include "umbrage/io/reader/read.hpp"
#include "umbrage/io/reader/tidy.hpp"

namespace umbrage::io::reader {
namespace {

constexpr std::size_t kMaxHierarchy = 16;

struct Transform {
  Vec3 scale{1.0}, translate{0.0};
};

Transform transformOf(const Json& document) {
  const Json& transform = member(document, "transform");
  return {vectorOf(member(transform, "scale")).value_or(Vec3(1.0)),
          vectorOf(member(transform, "translate")).value_or(Vec3(0.0))};
}

// A vertex that is not three numbers keeps its place in the count, as not a number: what uses it is dropped and counted.
std::vector<Vec3> verticesOf(const Json& list, const Transform& transform) {
  std::vector<Vec3> vertices;
  if (!list.is_array()) return vertices;
  vertices.reserve(list.size());
  for (const Json& entry : list)
    vertices.push_back(vectorOf(entry).value_or(Vec3(std::numeric_limits<double>::quiet_NaN())) * transform.scale +
                       transform.translate);
  return vertices;
}

std::string lodText(const Json& lod) {
  if (lod.is_string()) return lod.get<std::string>();
  return lod.is_number() ? lod.dump() : std::string();
}
double lodNumber(const std::string& lod) {
  double value = -1.0;
  std::from_chars(lod.data(), lod.data() + lod.size(), value);
  return value;
}

// Where an object stands among the others.
struct Ancestry {
  std::string path;  // the ancestors' names, outermost first
  std::string
      group;  // the building, bridge, .. it belongs to: its outermost ancestor that is no mere collection, or itself
};

// Who is whose parent: by what children say of their parents, else by what parents say of their children. Collections
// (CityObjectGroup) are parents only where their members say so themselves.
class Family {
 public:
  explicit Family(const Json& objects) : objects_(objects) {
    for (const auto& [id, object] : objects.items())
      if (!isCollection(id))
        for (const Json& child : member(object, "children")) parents_.try_emplace(textOf(child), id);
  }
  [[nodiscard]] Ancestry of(const std::string& id) const;

 private:
  [[nodiscard]] bool isCollection(const std::string& id) const {
    return textOf(member(member(objects_, id.c_str()), "type")) == "CityObjectGroup";
  }
  [[nodiscard]] std::string parentOf(const std::string& id) const {
    const std::string named = textOf(element(member(member(objects_, id.c_str()), "parents"), 0));
    if (!named.empty()) return named;
    const auto known = parents_.find(id);
    return known == parents_.end() ? std::string() : known->second;
  }
  const Json& objects_;
  std::unordered_map<std::string, std::string> parents_;
};

// Parents that lead back to where one came from end the path.
Ancestry Family::of(const std::string& id) const {
  std::vector<std::string> names = {id};
  Ancestry ancestry{{}, id};
  while (names.size() < kMaxHierarchy) {
    const std::string parent = parentOf(names.back());
    if (parent.empty() || std::find(names.begin(), names.end(), parent) != names.end()) break;
    names.push_back(parent);
    if (!isCollection(parent)) ancestry.group = parent;
  }
  for (auto name = names.rbegin(); name != names.rend(); ++name) ancestry.path = childPath(ancestry.path, *name);
  return ancestry;
}

class CityReader {
 public:
  explicit CityReader(std::optional<std::string> lod) : lod_(std::move(lod)), materials_(scene_.materials) {}

  Result<void> begin(const Json& document);
  void addObjects(const Json& objects, const Json& vertices);
  void countBrokenLine() { ++brokenLines_; }
  void countLine() { ++lines_; }
  [[nodiscard]] scene::Scene finish();

 private:
  using Chosen = std::vector<const Json*>;
  [[nodiscard]] std::string lodOf(const Json& geometry) const;
  [[nodiscard]] Chosen chooseGeometries(const Json& object);
  void addObject(const Ancestry& ancestry, const Json& object, const std::vector<Vec3>& vertices);
  void addInstance(const Ancestry& ancestry, const Json& geometry, const std::string& objectType,
                   const std::vector<Vec3>& vertices);
  [[nodiscard]] std::optional<std::uint32_t> templateMesh(std::size_t index, const std::string& objectType);

  std::optional<std::string> lod_;
  scene::Scene scene_;
  CityMaterials materials_;
  Transform transform_;
  Json templates_;
  std::vector<Vec3> templateVertices_;
  std::map<std::pair<std::size_t, std::string>, std::uint32_t> templateMeshes_;  // the type decides the material
  SurfaceCounts counts_;
  std::set<std::string> lodsSeen_;
  std::size_t objectsWithoutLod_ = 0, objectsMalformed_ = 0, instancesDropped_ = 0, lines_ = 0, brokenLines_ = 0;
};

Result<void> CityReader::begin(const Json& document) {
  if (textOf(member(document, "type")) != "CityJSON")
    return fail(ErrorCode::input, "is not CityJSON: its \"type\" is not \"CityJSON\"");
  scene_.up = scene::UpAxis::z;
  scene_.crs = geo::shortName(textOf(member(member(document, "metadata"), "referenceSystem")));
  transform_ = transformOf(document);
  materials_.addAppearance(document);
  const Json& templates = member(document, "geometry-templates");
  templates_ = member(templates, "templates");
  templateVertices_ = verticesOf(member(templates, "vertices-templates"), {});
  return {};
}

void CityReader::addObjects(const Json& objects, const Json& vertexList) {
  if (!objects.is_object()) return;
  const std::vector<Vec3> vertices = verticesOf(vertexList, transform_);
  const Family family(objects);
  for (const auto& [id, object] : objects.items()) addObject(family.of(id), object, vertices);
}

std::string CityReader::lodOf(const Json& geometry) const {
  if (const auto index = indexOf(member(geometry, "template")))
    return lodText(member(element(templates_, *index), "lod"));
  return lodText(member(geometry, "lod"));
}

// All geometries of the level of detail asked for, or of the object's highest.
CityReader::Chosen CityReader::chooseGeometries(const Json& object) {
  Chosen all;
  double best = -1.0;
  for (const Json& geometry : member(object, "geometry")) {
    all.push_back(&geometry);
    lodsSeen_.insert(lodOf(geometry));
    best = std::max(best, lodNumber(lodOf(geometry)));
  }
  const double wanted = lod_ ? lodNumber(*lod_) : best;
  Chosen chosen;
  for (const Json* geometry : all) {
    const std::string lod = lodOf(*geometry);
    if ((lod_ && lod == *lod_) || lodNumber(lod) == wanted) chosen.push_back(geometry);
  }
  if (!all.empty() && chosen.empty()) ++objectsWithoutLod_;
  return chosen;
}

void CityReader::addObject(const Ancestry& ancestry, const Json& object, const std::vector<Vec3>& vertices) {
  if (!object.is_object()) {
    ++objectsMalformed_;
    return;
  }
  const std::string type = textOf(member(object, "type"));
  CityMesh builder(vertices, materials_, counts_);
  for (const Json* geometry : chooseGeometries(object)) {
    if (textOf(member(*geometry, "type")) == "GeometryInstance")
      addInstance(ancestry, *geometry, type, vertices);
    else
      builder.add(*geometry, type);
  }
  mesh::Mesh m = builder.take();
  if (m.triangles.empty()) return;
  m.name = ancestry.path;
  scene_.instances.push_back(
      {ancestry.path, static_cast<std::uint32_t>(scene_.meshes.size()), Mat4(1.0), true, ancestry.group});
  scene_.meshes.push_back(std::make_shared<const mesh::Mesh>(std::move(m)));
}

// The specification's matrix is row by row, relative to the reference point.
std::optional<Mat4> placement(const Json& geometry, const std::vector<Vec3>& vertices) {
  const Json& numbers = member(geometry, "transformationMatrix");
  const auto anchor = indexOf(element(member(geometry, "boundaries"), 0));
  if (!numbers.is_array() || numbers.size() != 16 || !anchor || *anchor >= vertices.size()) return std::nullopt;
  Mat4 m;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) {
      const auto value = numberOf(numbers[static_cast<std::size_t>(4 * row + column)]);
      if (!value) return std::nullopt;
      m[column][row] = *value;
    }
  m[3] += Vec4(vertices[*anchor], 0.0);
  return m;
}

void CityReader::addInstance(const Ancestry& ancestry, const Json& geometry, const std::string& objectType,
                             const std::vector<Vec3>& vertices) {
  const auto index = indexOf(member(geometry, "template"));
  const auto mesh = index ? templateMesh(*index, objectType) : std::nullopt;
  const auto where = placement(geometry, vertices);
  if (!mesh || !where) {
    ++instancesDropped_;
    return;
  }
  scene_.instances.push_back({ancestry.path, *mesh, *where, true, ancestry.group});
}

std::optional<std::uint32_t> CityReader::templateMesh(std::size_t index, const std::string& objectType) {
  const auto key = std::pair(index, objectType);
  if (const auto known = templateMeshes_.find(key); known != templateMeshes_.end()) return known->second;
  const Json& geometry = element(templates_, index);
  if (!geometry.is_object()) return std::nullopt;
  CityMesh builder(templateVertices_, materials_, counts_);
  builder.add(geometry, objectType);
  mesh::Mesh m = builder.take();
  m.name = "template " + std::to_string(index);
  const auto mesh = static_cast<std::uint32_t>(scene_.meshes.size());
  scene_.meshes.push_back(std::make_shared<const mesh::Mesh>(std::move(m)));
  templateMeshes_[key] = mesh;
  return mesh;
}

scene::Scene CityReader::finish() {
  auto& warnings = scene_.warnings;
  const std::string of = " of " + counted(counts_.seen, "surface") + " dropped: ";
  const auto surfaces = [&](std::size_t count, const char* why) {
    if (count > 0) warnings.push_back(std::to_string(count) + of + why);
  };
  surfaces(counts_.malformed, "not rings of vertex indices");
  surfaces(counts_.outOfRange, "vertices that do not exist or are not finite");
  surfaces(counts_.degenerate, "fewer than three different corners");
  if (instancesDropped_ > 0)
    warnings.push_back(counted(instancesDropped_, "template instance") + " dropped: no such template or placement");
  if (objectsMalformed_ > 0) warnings.push_back(counted(objectsMalformed_, "city object") + " dropped: not an object");
  if (brokenLines_ > 0)
    warnings.push_back(std::to_string(brokenLines_) + " of " + counted(lines_, "line") +
                       " dropped: not a CityJSONFeature");
  if (objectsWithoutLod_ > 0) {
    std::string levels;
    for (const std::string& lod : lodsSeen_) levels += (levels.empty() ? "" : ", ") + lod;
    warnings.push_back(counted(objectsWithoutLod_, "city object") + " left out: not in LoD " + lod_.value_or("") +
                       " (the file has " + levels + ")");
  }
  return std::move(scene_);
}

// A line of a sequence is worth a warning when it is broken, not the loss of the others.
void addFeature(CityReader& reader, std::string_view line) {
  reader.countLine();
  const auto feature = parseJson(line);
  if (!feature || textOf(member(*feature, "type")) != "CityJSONFeature" || !member(*feature, "CityObjects").is_object())
    return reader.countBrokenLine();
  reader.addObjects(member(*feature, "CityObjects"), member(*feature, "vertices"));
}

std::string_view nextLine(std::string_view& text) {
  const auto end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

bool isBlank(std::string_view line) { return line.find_first_not_of(" \t\r") == std::string_view::npos; }

}  // namespace

Result<scene::Scene> readCityJson(const Request& request) {
  auto bytes = readJsonBytes(request.file);
  if (!bytes) return tl::unexpected(bytes.error());
  auto document = parseJson(asText(*bytes));
  if (!document) return tl::unexpected(document.error());
  *bytes = {};
  if (isGeoJson(*document)) return sceneOfGeoJson(*document, request.hints);
  CityReader reader(request.hints.lod);
  if (auto begun = reader.begin(*document); !begun) return tl::unexpected(begun.error());
  reader.addObjects(member(*document, "CityObjects"), member(*document, "vertices"));
  return reader.finish();
}

Result<scene::Scene> readCityJsonSeq(const Request& request) {
  const auto bytes = readJsonBytes(request.file);
  if (!bytes) return tl::unexpected(bytes.error());
  std::string_view text = asText(*bytes);
  auto header = parseJson(nextLine(text));
  if (!header) return tl::unexpected(header.error());
  CityReader reader(request.hints.lod);
  if (auto begun = reader.begin(*header); !begun) return tl::unexpected(begun.error());
  reader.addObjects(member(*header, "CityObjects"), member(*header, "vertices"));
  while (!text.empty())
    if (const std::string_view line = nextLine(text); !isBlank(line)) addFeature(reader, line);
  return reader.finish();
}

}  // namespace umbrage::io::reader

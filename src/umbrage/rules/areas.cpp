#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>

#include "umbrage/base/file.hpp"
#include "umbrage/geo/projection.hpp"
#include "umbrage/outline/combine.hpp"
#include "umbrage/rules/detail/json_reader.hpp"
#include "umbrage/rules/targets.hpp"
#include "umbrage/study/georeference.hpp"

namespace umbrage::rules {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kLargestFile = std::size_t{64} << 20;
constexpr double kFarthest = 1e9;

const Json& member(const Json& object, const char* key) {
  static const Json kNull;
  if (!object.is_object()) return kNull;
  const auto found = object.find(key);
  return found == object.end() ? kNull : *found;
}
std::string textOf(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  return value.is_number() ? value.dump() : std::string();
}

// From the file's coordinates to those of the scene's plan.
class Way {
 public:
  [[nodiscard]] static Result<Way> make(const Json& document, const scene::Scene& scene) {
    Way way;
    if (document.contains("crs") && document.at("crs").is_null()) return way;
    const std::string named = textOf(member(member(member(document, "crs"), "properties"), "name"));
    const std::string from = named.empty() ? "OGC:CRS84" : geo::shortName(named);
    if (!scene.crs.empty() && from == geo::shortName(scene.crs)) return way;
    if (scene.crs.empty())
      return fail(
          ErrorCode::input,
          "is in " + std::string(named.empty() ? "degrees (a GeoJSON without a \"crs\")" : from) +
              ", and the scene has no reference system; \"crs\": null says that coordinates are the scene's own");
    auto source = geo::Projection::make(from), target = geo::Projection::make(scene.crs);
    if (!source) return tl::unexpected(source.error());
    if (!target) return tl::unexpected(target.error());
    way.source_ = std::move(*source), way.target_ = std::move(*target);
    return way;
  }
  [[nodiscard]] std::optional<Vec2> operator()(const Vec2& p) const {
    if (!source_) return p;
    const auto degrees = source_->toDegrees(p);
    return degrees ? target_->fromDegrees(*degrees) : std::nullopt;
  }

 private:
  std::optional<geo::Projection> source_, target_;
};

// An empty ring where a position is none.
outline::Ring ringOf(const Json& positions, const Way& way) {
  outline::Ring ring;
  if (!positions.is_array()) return {};
  for (const Json& position : positions) {
    if (!position.is_array() || position.size() < 2 || !position[0].is_number() || !position[1].is_number()) return {};
    const auto p = way({position[0].get<double>(), position[1].get<double>()});
    if (!p || !(std::abs(p->x) <= kFarthest && std::abs(p->y) <= kFarthest)) return {};
    ring.push_back(*p);
  }
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  return ring.size() < 3 ? outline::Ring{} : ring;
}

outline::Region turned(outline::Ring ring) {
  if (outline::areaOf(ring) < 0.0) std::reverse(ring.begin(), ring.end());
  outline::Region region;
  region.polygons.push_back({std::move(ring), {}});
  return outline::together({region});
}

// False where it is no polygon of positions.
bool addPolygon(const Json& rings, const Way& way, std::vector<outline::Region>& parts) {
  if (!rings.is_array() || rings.empty()) return false;
  outline::Region region;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    outline::Ring ring = ringOf(rings[i], way);
    if (ring.empty()) return false;
    outline::Region part = turned(std::move(ring));
    region = i == 0 ? std::move(part) : outline::without(region, part);
  }
  if (region.area > 0.0) parts.push_back(std::move(region));
  return true;
}

bool addGeometry(const Json& geometry, const Way& way, std::vector<outline::Region>& parts) {
  const std::string type = textOf(member(geometry, "type"));
  const Json& coordinates = member(geometry, "coordinates");
  if (type == "Polygon") return addPolygon(coordinates, way, parts);
  if (type == "MultiPolygon") {
    for (const Json& polygon : coordinates)
      if (!addPolygon(polygon, way, parts)) return false;
  }
  if (type == "GeometryCollection") {
    for (const Json& part : member(geometry, "geometries"))
      if (!addGeometry(part, way, parts)) return false;
  }
  return true;
}

std::string nameOf(const Json& feature, std::size_t number) {
  for (const char* key : {"name", "id"})
    if (std::string name = textOf(member(member(feature, "properties"), key)); !name.empty()) return name;
  const std::string id = textOf(member(feature, "id"));
  return id.empty() ? fmt::format("area {}", number) : id;
}

/// Farther from the scene, in its sizes and in metres, nobody means it.
constexpr double kFarthestSizes = 20.0, kFarthestMetres = 20'000.0;

/// How far areas lie from the scene, in metres, where that is too far to be meant.
std::optional<double> farAway(const std::vector<Area>& areas, const scene::Scene& scene) {
  const Box3 box = scene::bounds(scene);
  if (box.empty()) return std::nullopt;
  const Vec2 a = study::mapPoint(box.min, scene.up), b = study::mapPoint(box.max, scene.up);
  const Vec2 low = glm::min(a, b), high = glm::max(a, b);
  double nearest = std::numeric_limits<double>::infinity();
  for (const Area& area : areas)
    for (const outline::Polygon& polygon : area.region.polygons)
      for (const Vec2& p : polygon.outer) nearest = std::min(nearest, glm::length(p - glm::clamp(p, low, high)));
  const double most = std::max(kFarthestSizes * glm::length(high - low), kFarthestMetres / scene.metresPerUnit);
  if (!(nearest > most) || std::isinf(nearest)) return std::nullopt;
  return nearest * scene.metresPerUnit;
}

}  // namespace

Result<std::vector<Area>> readAreas(const std::filesystem::path& path, const scene::Scene& scene) {
  const auto bytes = readFile(path, kLargestFile);
  if (!bytes) return tl::unexpected(bytes.error());
  const auto document = detail::parseJson({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path.string());
  if (!document) return tl::unexpected(document.error());
  const auto way = Way::make(*document, scene);
  if (!way) return fail(way.error().code, way.error().message, path.string());
  std::vector<Area> areas;
  const bool collection = textOf(member(*document, "type")) == "FeatureCollection";
  const Json features = collection ? member(*document, "features") : Json::array({*document});
  std::size_t number = 0;
  for (const Json& feature : features) {
    const Json& geometry = textOf(member(feature, "type")) == "Feature" ? member(feature, "geometry") : feature;
    std::vector<outline::Region> parts;
    ++number;
    if (!addGeometry(geometry, *way, parts))
      return fail(ErrorCode::input,
                  fmt::format("feature {} is no polygon of finite coordinates that the scene reaches", number),
                  path.string());
    if (!parts.empty()) areas.push_back({nameOf(feature, number), outline::together(parts)});
  }
  if (areas.empty()) return fail(ErrorCode::input, "has no polygon", path.string());
  if (const auto far = farAway(areas, scene))
    return fail(
        ErrorCode::input,
        fmt::format("lies {:.0f} km from the scene; GeoJSON has longitude before latitude, or names its \"crs\"",
                    *far / 1000.0),
        path.string());
  return areas;
}

}  // namespace umbrage::rules

// GeoJSON (RFC 7946, and the older "crs" member): every polygon with a height becomes a closed prism on the ground, Z = 0. Longitude and
// latitude are projected to metres; what says it is lengths stays as it is.
#include "umbrage/io/reader/geojson.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "umbrage/geo/projection.hpp"
#include "umbrage/io/reader/building_height.hpp"
#include "umbrage/io/reader/files.hpp"
#include "umbrage/io/reader/footprint.hpp"
#include "umbrage/io/reader/map_frame.hpp"
#include "umbrage/io/reader/read.hpp"
#include "umbrage/io/reader/surface_colours.hpp"
#include "umbrage/io/reader/tidy.hpp"

namespace umbrage::io::reader {
namespace {

// Collections within collections are no footprints anybody drew.
constexpr int kDeepestCollection = 8;

/// One feature with polygons: where its rings lie among all points, and how high it is.
struct Building {
  std::string name;
  BuildingHeight height;
  std::vector<std::vector<std::vector<std::size_t>>> polygons;  // indices of points, ring by ring
};

/// What was left out, and why.
struct Dropped {
  std::size_t features = 0, notPolygons = 0, malformed = 0, noHeight = 0, oddHeight = 0, notPositive = 0, tooTall = 0;
  std::size_t polygons = 0, tooFew = 0, repaired = 0, tangled = 0;
};

class Collector {
 public:
  explicit Collector(const detail::Hints& hints)
      : rules_{hints.heightProperty, hints.defaultHeight, hints.floorHeight} {}
  void addDocument(const Json& document);

  std::vector<Vec2> points;
  std::vector<Building> buildings;
  Dropped dropped;

 private:
  void addFeature(const Json& geometry, const Json& properties, const std::string& name);
  [[nodiscard]] bool addGeometry(const Json& geometry, Building& building, int depth);
  [[nodiscard]] bool addPolygon(const Json& rings, Building& building);

  HeightRules rules_;
};

std::string nameOf(const Json& feature, std::size_t number) {
  const auto text = [](const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    return value.is_number() ? value.dump() : std::string();
  };
  const Json& properties = member(feature, "properties");
  for (const char* key : {"name", "id", "@id", "osm_id", "gml_id", "identificatie"})
    if (const std::string name = text(member(properties, key)); !name.empty()) return name;
  const std::string id = text(member(feature, "id"));
  return id.empty() ? "building " + std::to_string(number) : id;
}

void Collector::addDocument(const Json& document) {
  const std::string type = textOf(member(document, "type"));
  if (type == "FeatureCollection") {
    std::size_t number = 0;
    for (const Json& feature : member(document, "features"))
      addFeature(member(feature, "geometry"), member(feature, "properties"), nameOf(feature, ++number));
  } else if (type == "Feature") {
    addFeature(member(document, "geometry"), member(document, "properties"), nameOf(document, 1));
  } else {
    addFeature(document, Json(), "building");
  }
}

void Collector::addFeature(const Json& geometry, const Json& properties, const std::string& name) {
  ++dropped.features;
  const std::size_t pointsBefore = points.size();
  Building building{childPath("", name), {}, {}};
  if (!addGeometry(geometry, building, 0)) {
    ++dropped.malformed;
    points.resize(pointsBefore);
    return;
  }
  if (building.polygons.empty()) {
    ++dropped.notPolygons;
    return;
  }
  const auto height = heightOf(properties, rules_);
  if (const auto* known = std::get_if<BuildingHeight>(&height)) {
    building.height = *known;
    buildings.push_back(std::move(building));
    return;
  }
  points.resize(pointsBefore);
  switch (std::get<HeightFault>(height)) {
    case HeightFault::absent: ++dropped.noHeight; break;
    case HeightFault::notANumber: ++dropped.oddHeight; break;
    case HeightFault::notPositive: ++dropped.notPositive; break;
    case HeightFault::tooTall: ++dropped.tooTall; break;
  }
}

bool Collector::addGeometry(const Json& geometry, Building& building, int depth) {
  const std::string type = textOf(member(geometry, "type"));
  const Json& coordinates = member(geometry, "coordinates");
  if (type == "Polygon") return addPolygon(coordinates, building);
  if (type == "MultiPolygon") {
    return coordinates.is_array() && std::all_of(coordinates.begin(), coordinates.end(),
                                                 [&](const Json& polygon) { return addPolygon(polygon, building); });
  }
  if (type != "GeometryCollection" || depth >= kDeepestCollection) return true;
  const Json& parts = member(geometry, "geometries");
  return std::all_of(parts.begin(), parts.end(),
                     [&](const Json& part) { return addGeometry(part, building, depth + 1); });
}

bool Collector::addPolygon(const Json& rings, Building& building) {
  if (!rings.is_array() || rings.empty()) return false;
  auto& polygon = building.polygons.emplace_back();
  for (const Json& ring : rings) {
    if (!ring.is_array()) return false;
    auto& indices = polygon.emplace_back();
    for (const Json& position : ring) {
      const auto x = numberOf(element(position, 0)), y = numberOf(element(position, 1));
      if (!x || !y || !std::isfinite(*x) || !std::isfinite(*y)) return false;
      indices.push_back(points.size());
      points.emplace_back(*x, *y);
    }
  }
  return true;
}

// The middle one of the buildings' sizes: one outlier decides nothing.
double typicalSize(const Collector& map) {
  std::vector<double> sizes;
  for (const Building& building : map.buildings) {
    Extent extent;
    for (const auto& polygon : building.polygons)
      for (const auto& ring : polygon)
        for (const std::size_t i : ring) extent.add(map.points[i]);
    // One that crosses the 180th meridian is not as wide as the world.
    const double size = extent.size() > 180.0 && extent.size() <= 360.0 ? 360.0 - extent.size() : extent.size();
    if (size > 0.0) sizes.push_back(size);
  }
  if (sizes.empty()) return 0.0;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

// What the command line says goes before the file; a file that says nothing means WGS84 (RFC 7946), and `"crs": null` means
// no place in particular (the specification of 2008).
Result<MapClaim> claimOf(const Json& document, const detail::Hints& hints) {
  if (hints.crs) return MapClaim{*hints.crs == "local" ? "" : geo::shortName(*hints.crs), "--crs"};
  if (!document.contains("crs")) return MapClaim{"OGC:CRS84", "GeoJSON without a \"crs\""};
  const Json& crs = document.at("crs");
  if (crs.is_null()) return MapClaim{"", "its \"crs\" of null"};
  const std::string name = textOf(member(member(crs, "properties"), "name"));
  if (name.empty())
    return fail(ErrorCode::unsupported,
                "has a \"crs\" without a name; --crs EPSG:CODE or --crs local says what is meant");
  return MapClaim{geo::shortName(name), "its \"crs\""};
}

Footprint footprintOf(const std::vector<std::vector<std::size_t>>& polygon, const std::vector<Vec2>& points) {
  Footprint footprint;
  for (const auto& ring : polygon) {
    auto& corners = footprint.emplace_back();
    for (const std::size_t i : ring) corners.push_back(points[i]);
  }
  return cleanFootprint(footprint);
}

bool isFinite(const Footprint& footprint) {
  for (const auto& ring : footprint)
    for (const Vec2& p : ring)
      if (!std::isfinite(p.x) || !std::isfinite(p.y)) return false;
  return true;
}

mesh::Mesh meshOf(const Building& building, const Collector& map, double metresPerUnit, Dropped& dropped) {
  mesh::Mesh mesh;
  mesh.name = building.name;
  const double base = building.height.base / metresPerUnit, top = building.height.top / metresPerUnit;
  for (const auto& polygon : building.polygons) {
    ++dropped.polygons;
    const Footprint footprint = footprintOf(polygon, map.points);
    if (footprint.empty() || !isFinite(footprint)) {
      ++dropped.tooFew;
    } else if (isSimple(footprint)) {
      addPrism(mesh, footprint, base, top);
    } else {
      const auto parts = untangle(footprint);
      ++(parts.empty() ? dropped.tangled : dropped.repaired);
      for (const Footprint& part : parts) addPrism(mesh, part, base, top);
    }
  }
  return mesh;
}

void addWarnings(std::vector<std::string>& warnings, const Collector& map, const detail::Hints& hints) {
  const Dropped& d = map.dropped;
  const auto say = [&](std::size_t count, std::size_t of, const char* noun, const std::string& what) {
    if (count > 0) warnings.push_back(fmt::format("{} of {} {}", count, counted(of, noun), what));
  };
  say(d.notPolygons, d.features, "feature", "left out: not a polygon");
  say(d.malformed, d.features, "feature", "dropped: not rings of finite coordinates");
  say(d.noHeight, d.features, "feature",
      hints.heightProperty
          ? "dropped: no property \"" + *hints.heightProperty + "\" with a value"
          : "dropped: no height (height, measuredHeight, building:levels, floors, ...); --height-property names it, "
            "--default-height gives one");
  say(d.oddHeight, d.features, "feature", "dropped: a height that is no length");
  say(d.notPositive, d.features, "feature", "dropped: a height that is negative, zero or no higher than its base");
  say(d.tooTall, d.features, "feature",
      fmt::format("dropped: higher than {:g} m; heights are taken as metres", kTallest));
  say(d.tooFew, d.polygons, "polygon", "dropped: fewer than three different corners");
  say(d.tangled, d.polygons, "polygon", "dropped: rings that enclose nothing");
  say(d.repaired, d.polygons, "polygon", "repaired: rings that crossed themselves or each other");
  const auto having = [&](auto what) { return std::count_if(map.buildings.begin(), map.buildings.end(), what); };
  const auto floors = static_cast<std::size_t>(having([](const Building& b) { return b.height.fromFloors; }));
  const auto fallback = static_cast<std::size_t>(having([](const Building& b) { return b.height.fromFallback; }));
  say(floors, map.buildings.size(), "building", fmt::format("as high as their floors, {:g} m each", hints.floorHeight));
  if (fallback > 0 && hints.defaultHeight)
    say(fallback, map.buildings.size(), "building", fmt::format("{:g} m high by default", *hints.defaultHeight));
}

}  // namespace

bool isGeoJson(const Json& document) {
  const std::string type = textOf(member(document, "type"));
  return type == "FeatureCollection" || type == "Feature" || type == "Polygon" || type == "MultiPolygon" ||
         type == "GeometryCollection";
}

Result<scene::Scene> sceneOfGeoJson(const Json& document, const detail::Hints& hints) {
  if (!isGeoJson(document)) return fail(ErrorCode::input, "is not GeoJSON: its \"type\" is not \"FeatureCollection\"");
  const auto claim = claimOf(document, hints);
  if (!claim) return tl::unexpected(claim.error());
  Collector map(hints);
  map.addDocument(document);
  const auto frame = placeOnMap(*claim, map.points, typicalSize(map));
  if (!frame) return tl::unexpected(frame.error());
  scene::Scene scene;
  scene.up = scene::UpAxis::z;
  scene.crs = frame->crs;
  scene.metresPerUnit = frame->metresPerUnit;
  if (!frame->warning.empty()) scene.warnings.push_back(frame->warning);
  scene.materials.push_back({"Building", colourOfType("Building"), 1.0});
  for (const Building& building : map.buildings) {
    mesh::Mesh mesh = meshOf(building, map, frame->metresPerUnit, map.dropped);
    if (mesh.triangles.empty()) continue;
    scene.instances.push_back({building.name, static_cast<std::uint32_t>(scene.meshes.size()), Mat4(1.0), true});
    scene.meshes.push_back(std::make_shared<const mesh::Mesh>(std::move(mesh)));
  }
  addWarnings(scene.warnings, map, hints);
  return scene;
}

Result<scene::Scene> readGeoJson(const Request& request) {
  auto bytes = readJsonBytes(request.file);
  if (!bytes) return tl::unexpected(bytes.error());
  const auto document = parseJson(asText(*bytes));
  if (!document) return tl::unexpected(document.error());
  return sceneOfGeoJson(*document, request.hints);
}

}  // namespace umbrage::io::reader

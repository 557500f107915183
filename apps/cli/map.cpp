#include "map.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "outputs.hpp"
#include "umbrage/outline/shadow.hpp"
#include "umbrage/study/georeference.hpp"
#include "umbrage/study/ledger.hpp"

namespace umbrage::cli {

void addMapOptions(CLI::App& app, MapOptions& options) {
  const auto height = [](const std::string& word) { return parseNumber(word, -1e12, 1e12); };
  addValue(app, "--plane", "HEIGHT", "The height of the plane (default: the scene's lowest point)", options.plane,
           height);
  addWord(app, "-o,--output", "OUT.{geojson,dxf,svg}", "The map", options.output, {.required = true});
}

Result<void> checkMapFile(const MapOptions& options, const std::string& scene) {
  if (auto known = checkExtension("-o", options.output, {".geojson", ".json", ".dxf", ".svg"}); !known) return known;
  return checkOutputs({options.output}, scene);
}

namespace {

// Which part of its area stands upright.
double uprightPart(const outline::CasterPart& part) {
  double upright = 0.0, all = 0.0;
  for (const mesh::Triangle& t : part.triangles) {
    const Vec3 normal = glm::cross(part.points[t[1]] - part.points[t[0]], part.points[t[2]] - part.points[t[0]]);
    const double area = glm::length(normal);
    all += area;
    if (std::abs(normal.z) < 0.2 * area) upright += area;
  }
  return all > 0.0 ? upright / all : 0.0;
}

// Terrain, roads and water are flat for their size and have hardly any walls; drawn as buildings they would hide the map.
bool isGround(const outline::CasterPart& part) {
  constexpr double kFlat = 0.03, kFewWalls = 0.05;
  const Vec3 size = part.bounds.size();
  return size.z < kFlat * std::max(size.x, size.y) && uprightPart(part) < kFewWalls;
}

std::vector<outline::CasterPart> standing(std::vector<outline::CasterPart> parts) {
  std::erase_if(parts, isGround);
  return parts;
}

}  // namespace

double planeOf(const MapOptions& options, const scene::Scene& scene) {
  const Box3 box = scene::bounds(scene, true);
  return options.plane.value_or(box.empty() ? 0.0 : study::mapHeight(box.min, scene.up));
}

Result<report::VectorMap> mapOf(const scene::Scene& scene, const std::vector<outline::CasterPart>& casters,
                                double plane, const sun::Place& place, const PlaceOptions& when,
                                const std::string& clockOffset, const MapSubject& subject,
                                const std::vector<std::string>& patterns) {
  report::VectorMap map;
  map.title = subject.title;
  map.subtitle = fmt::format("{}, {}", shortName(std::filesystem::path(scene.source).filename().string()),
                             sun::dateText(when.date));
  map.crs = scene.crs;
  map.metresPerUnit = scene.metresPerUnit;
  map.height = plane;
  map.north = scene.northOffset;
  // What stands on the plane, seen from above.
  auto plans = outline::shadowsOnPlane(standing(casters), plane, {Vec2(0.0)}, outline::Grouping::merged);
  if (!plans) return tl::unexpected(plans.error());
  map.buildings = std::move(plans->front().front().region.polygons);
  map.ledger = {{"Place", study::placeText(place)},
                {"Date", sun::dateText(when.date)},
                study::clockLine(when.zone, clockOffset),
                study::sunLine({}, subject.sun),
                {"Plane", fmt::format("horizontal, at height {:g}", plane)},
                study::northLine(scene),
                study::unitLine(scene),
                study::castersLine(patterns)};
  map.ledger.insert(map.ledger.end(), subject.more.begin(), subject.more.end());
  map.ledger.push_back(study::inputLine(scene));
  map.ledger.push_back(study::versionLine(subject.method, when.zone));
  return map;
}

Result<void> write(const report::VectorMap& map, const MapOptions& options) {
  return writeOutputs({{options.output, [&](const std::string& path) { return report::writeMap(map, path); }}});
}

}  // namespace umbrage::cli

// Maps written as DXF, read back by a program that knows nothing of us.
#include <gdal.h>
#include <gtest/gtest.h>
#include <ogr_api.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <memory>

#include "umbrage/outline/shadow.hpp"
#include "umbrage/report/vector_map.hpp"

namespace umbrage::report {
namespace {

struct CloseDataset {
  void operator()(GDALDatasetH dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<void, CloseDataset>;

Dataset open(const std::filesystem::path& path) {
  GDALAllRegister();
  return Dataset(GDALOpenEx(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, nullptr, nullptr, nullptr));
}

// An object in a file: its layer, and the closed line it is.
struct Line {
  std::string layer;
  bool closed = false;
  double area = 0.0;  // positive where it runs counter-clockwise
  double height = 0.0;
};

Line lineOf(OGRFeatureH feature) {
  Line line{OGR_F_GetFieldAsString(feature, OGR_F_GetFieldIndex(feature, "Layer"))};
  const OGRGeometryH g = OGR_F_GetGeometryRef(feature);
  const int n = OGR_G_GetPointCount(g);
  if (n < 4) return line;
  const double x0 = OGR_G_GetX(g, 0), y0 = OGR_G_GetY(g, 0);
  line.closed = x0 == OGR_G_GetX(g, n - 1) && y0 == OGR_G_GetY(g, n - 1);
  line.height = OGR_G_GetZ(g, 0);
  for (int i = 0; i + 1 < n; ++i)
    line.area += 0.5 * ((OGR_G_GetX(g, i) - x0) * (OGR_G_GetY(g, i + 1) - y0) -
                        (OGR_G_GetX(g, i + 1) - x0) * (OGR_G_GetY(g, i) - y0));
  return line;
}

std::vector<Line> linesOf(const std::filesystem::path& path) {
  const Dataset file = open(path);
  EXPECT_TRUE(file) << "no program could open it";
  std::vector<Line> lines;
  if (!file) return lines;
  const OGRLayerH entities = GDALDatasetGetLayerByName(file.get(), "entities");
  EXPECT_NE(entities, nullptr);
  while (const OGRFeatureH feature = OGR_L_GetNextFeature(entities)) {
    lines.push_back(lineOf(feature));
    OGR_F_Destroy(feature);
  }
  return lines;
}

// Areas of a GeoJSON's polygons, by layer.
std::map<std::string, double> areasOf(const std::filesystem::path& path) {
  const Dataset file = open(path);
  EXPECT_TRUE(file);
  std::map<std::string, double> areas;
  const OGRLayerH layer = GDALDatasetGetLayer(file.get(), 0);
  while (const OGRFeatureH feature = OGR_L_GetNextFeature(layer)) {
    areas[OGR_F_GetFieldAsString(feature, OGR_F_GetFieldIndex(feature, "layer"))] +=
        OGR_G_Area(OGR_F_GetGeometryRef(feature));
    OGR_F_Destroy(feature);
  }
  return areas;
}

// A wall around a court, as in a map of the Netherlands: far from the origin.
outline::CasterPart court(const Vec2& corner) {
  outline::CasterPart part{"court", {}, {}, {}};
  const auto add = [&](double x, double y, double width, double depth) {
    const auto first = static_cast<std::uint32_t>(part.points.size());
    for (const double z : {0.0, 6.0})
      for (const Vec2& p : {Vec2(x, y), Vec2(x + width, y), Vec2(x + width, y + depth), Vec2(x, y + depth)})
        part.points.emplace_back(corner + p, z);
    constexpr std::uint32_t kFaces[6][4] = {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                            {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    for (const auto& f : kFaces) {
      part.triangles.push_back({first + f[0], first + f[1], first + f[2]});
      part.triangles.push_back({first + f[0], first + f[2], first + f[3]});
    }
  };
  add(0, 0, 40, 3), add(0, 37, 40, 3), add(0, 3, 3, 34), add(37, 3, 3, 34);
  for (const Vec3& p : part.points) part.bounds.add(p);
  return part;
}

VectorMap mapOf(const std::vector<Vec2>& slopes) {
  VectorMap map;
  map.title = "Shadow outlines";
  map.height = 1.25;
  map.ledger = {{"Place", "52.0000 N, 4.4000 E"}};
  const auto shadows = outline::shadowsOnPlane({court({85000, 446000}), court({85100.123, 446050.456})}, 0.0, slopes,
                                               outline::Grouping::parts);
  EXPECT_TRUE(shadows);
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    map.layers.push_back({"at " + std::to_string(i), {200, 100, 50}});
    for (const outline::Shadow& shadow : (*shadows)[i])
      map.features.push_back({i, shadow.region, {{"area_m2", shadow.region.area}}});
  }
  return map;
}

std::size_t ringsOf(const VectorMap& map) {
  std::size_t rings = 0;
  for (const MapFeature& feature : map.features)
    for (const auto& polygon : feature.region.polygons) rings += 1 + polygon.holes.size();
  return rings;
}

TEST(DxfReadBack, layersClosedLinesHolesAndAreasAreThoseOfTheGeoJson) {
  const VectorMap map = mapOf({{1.5, 0.75}, {-0.25, 2.0}, {0.0, 1.0}});
  const auto folder = std::filesystem::temp_directory_path();
  const auto dxf = folder / "umbrage-read-back.dxf", json = folder / "umbrage-read-back.geojson";
  ASSERT_TRUE(writeMap(map, dxf));
  ASSERT_TRUE(writeMap(map, json));
  const auto lines = linesOf(dxf);
  EXPECT_EQ(lines.size(), ringsOf(map));
  std::map<std::string, double> net;
  std::map<std::string, int> holes;
  for (const Line& line : lines) {
    EXPECT_TRUE(line.closed) << line.layer;
    EXPECT_EQ(line.height, 1.25);
    net[line.layer] += line.area;
    holes[line.layer] += line.area < 0.0 ? 1 : 0;
  }
  const auto areas = areasOf(json);
  ASSERT_EQ(areas.size(), 3U);
  ASSERT_EQ(net.size(), 3U);
  for (std::size_t i = 0; i < map.layers.size(); ++i) {
    const std::string layer = "AT_" + std::to_string(i);
    const double expected = areas.at(map.layers[i].name);
    EXPECT_GT(expected, 2.0 * (40 * 40 - 34 * 34)) << "the walls and more";
    EXPECT_NEAR(net.at(layer), expected, 1e-6 * expected) << layer;
    EXPECT_EQ(holes.at(layer), 2) << "a lit part of each court";
  }
  std::filesystem::remove(dxf);
  std::filesystem::remove(json);
}

TEST(DxfReadBack, anEmptyMapOpensToo) {
  const auto dxf = std::filesystem::temp_directory_path() / "umbrage-read-back-empty.dxf";
  ASSERT_TRUE(writeMap({}, dxf));
  EXPECT_TRUE(linesOf(dxf).empty());
  std::filesystem::remove(dxf);
}

}  // namespace
}  // namespace umbrage::report

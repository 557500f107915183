#include "umbrage/report/vector_map.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace umbrage::report {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

VectorMap sample() {
  VectorMap map;
  map.title = "A <map> & more";
  map.layers = {{"09:00", {200, 100, 50}}, {"9/00", {10, 20, 30}}};
  outline::Polygon square{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{{2, 2}, {2, 4}, {4, 4}, {4, 2}}}};
  map.features.push_back({0, {{square}, 96.0}, {{"area_m2", 96.0}, {"name", std::string("a \"b\"")}}});
  map.features.push_back({1, {{square, square}, 192.0}, {}});
  map.features.push_back({1, {}, {}});
  map.ledger = {{"Place", "here"}};
  map.height = 1.5;
  return map;
}

std::string written(const VectorMap& map, const std::string& extension) {
  const auto path =
      std::filesystem::temp_directory_path() /
      ("umbrage-map-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + extension);
  const auto done = writeMap(map, path);
  EXPECT_TRUE(done) << done.error().text();
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  std::filesystem::remove(path);
  return text.str();
}

TEST(VectorMap, geoJsonKeepsHolesAndNames) {
  EXPECT_THAT(written(sample(), ".geojson"),
              AllOf(HasSubstr("[[[0,0],[10,0],[10,10],[0,10],[0,0]],[[2,2],[2,4],[4,4],[4,2],[2,2]]]"),
                    HasSubstr("\"crs\":null"), HasSubstr("\"name\":\"a \\\"b\\\"\""), HasSubstr("\"Place\":\"here\""),
                    HasSubstr("MultiPolygon")));
}

TEST(VectorMap, geoJsonIsInDegreesWhereItCanBe) {
  VectorMap map = sample();
  map.crs = "+proj=tmerc +lat_0=48 +lon_0=16 +k=1 +x_0=0 +y_0=0 +ellps=WGS84 +units=m";
  EXPECT_THAT(written(map, ".json"), AllOf(HasSubstr("[[[16,48],[16.000134"), Not(HasSubstr("\"crs\":null"))));
}

TEST(VectorMap, missingProjDataAreSaid) {
  VectorMap map = sample();
  map.crs = "EPSG:28992";
  ::setenv("PROJ_LIB", "/nowhere", 1);
  ::setenv("PROJ_DATA", "/nowhere", 1);
  const auto done = writeMap(map, std::filesystem::temp_directory_path() / "umbrage-map-none.geojson");
  ::unsetenv("PROJ_LIB");
  ::unsetenv("PROJ_DATA");
  ASSERT_FALSE(done);
  EXPECT_THAT(done.error().message, HasSubstr("proj.db"));
}

TEST(VectorMap, dxfHasALayerForEachAndClosedPolylines) {
  const std::string dxf = written(sample(), ".dxf");
  EXPECT_THAT(dxf, AllOf(HasSubstr("AC1009"), HasSubstr("\n09_00\n"), HasSubstr("\n9_00\n"), HasSubstr("EOF"),
                         HasSubstr("Place: here")));
  std::size_t polylines = 0;
  for (std::size_t at = dxf.find("POLYLINE"); at != std::string::npos; at = dxf.find("POLYLINE", at + 1)) ++polylines;
  EXPECT_EQ(polylines, 6U);
}

TEST(VectorMap, svgEscapesAndDrawsHolesAsHoles) {
  EXPECT_THAT(written(sample(), ".svg"),
              AllOf(HasSubstr("A &lt;map&gt; &amp; more"), HasSubstr("evenodd"), HasSubstr("id=\"layer-1\"")));
}

TEST(VectorMap, anEmptyMapIsStillAFile) {
  VectorMap map;
  for (const char* extension : {".geojson", ".dxf", ".svg"}) EXPECT_FALSE(written(map, extension).empty());
  EXPECT_EQ(writeMap(map, "x.png").error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace umbrage::report

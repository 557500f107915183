#include "umbrage/io/raster.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "umbrage/io/load.hpp"
#include "umbrage/io/test_data.hpp"

namespace umbrage::io {
namespace {

// 6 columns, 4 rows, cells of 2 m; the south-western corner at (100, 200).
const std::string kHead = "ncols 6\nnrows 4\nxllcorner 100\nyllcorner 200\ncellsize 2\nNODATA_value -9999\n";

bool warns(const scene::Scene& scene, const std::string& part) {
  for (const std::string& warning : scene.warnings)
    if (warning.find(part) != std::string::npos) return true;
  return false;
}

TEST(Raster, cellsAreCorners) {
  const test::Folder folder;
  const auto file = folder.write("a.asc", kHead + "1 1 1 1 1 1\n1 9 1 1 1 1\n1 1 1 1 1 1\n1 1 1 1 1 2\n");
  const auto scene = loadScene(file);
  ASSERT_TRUE(scene) << scene.error().text();
  EXPECT_EQ(scene->up, scene::UpAxis::z);
  EXPECT_EQ(scene::triangleCount(*scene), 2U * 5U * 3U);
  const auto& points = scene->meshes.at(0)->positions;
  EXPECT_EQ(points.size(), 24U);
  EXPECT_NE(std::find(points.begin(), points.end(), Vec3(103, 205, 9)), points.end());
  EXPECT_NE(std::find(points.begin(), points.end(), Vec3(111, 201, 2)), points.end());
}

TEST(Raster, cellsWithoutHeightAreHoles) {
  const test::Folder folder;
  const auto scene =
      loadScene(folder.write("a.asc", kHead + "1 1 1 1 1 1\n1 -9999 1 1 1 1\n1 1 1 1 1 1\n1 1 1 1 1 1\n"));
  ASSERT_TRUE(scene) << scene.error().text();
  EXPECT_EQ(scene::triangleCount(*scene), 30U - 6U);
  EXPECT_TRUE(warns(*scene, "1 of 24 cells have no height"));
}

// Cells of a tenth of a millimetre beside a tower of nine metres: longitude and latitude of a file that does not say so.
TEST(Raster, degreesAreNotTakenForMetres) {
  const test::Folder folder;
  const auto file = folder.write("a.asc",
                                 "ncols 3\nnrows 3\nxllcorner 16.37\nyllcorner 48.2\ncellsize 0.0001\n"
                                 "0 0 0\n0 9 0\n0 0 0\n");
  const auto refused = loadScene(file);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::input);
  for (const char* part : {"look like degrees", "0.1 mm", "--crs EPSG:4326", "--crs local"})
    EXPECT_NE(refused.error().message.find(part), std::string::npos) << refused.error().message;
  EXPECT_FALSE(inspectRaster(file));
  LoadOptions options;
  options.crs = "EPSG:31256";
  EXPECT_FALSE(loadScene(file, options)) << "a system of metres makes it no better";
  options.crs = "EPSG:4326";
  const auto projected = loadScene(file, options);
  ASSERT_TRUE(projected) << projected.error().text();
  EXPECT_NEAR(scene::bounds(*projected).size().y, 22.24, 0.05);
  options.crs = "local";
  EXPECT_TRUE(loadScene(file, options));
  // A model on a table is small too, but not taller than it is wide.
  EXPECT_TRUE(loadScene(folder.write("b.asc",
                                     "ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 0.005\n"
                                     "0 0 0\n0 0.01 0\n0 0 0\n")));
}

TEST(Raster, inspected) {
  const test::Folder folder;
  const auto info =
      inspectRaster(folder.write("a.asc", kHead + "1 1 1 1 1 1\n1 9 1 1 1 1\n1 1 1 1 1 1\n1 1 1 -3 1 -9999\n"));
  ASSERT_TRUE(info) << info.error().text();
  EXPECT_EQ(info->columns, 6);
  EXPECT_EQ(info->rows, 4);
  EXPECT_EQ(info->lowest, -3.0);
  EXPECT_EQ(info->highest, 9.0);
  EXPECT_EQ(info->middle(1, 1), Vec2(103, 205));
}

// A tower far away is kept where it reaches the tile at the sun's least elevation, and left out where it does not.
TEST(Raster, tilesKeepWhatReachesThem) {
  const test::Folder folder;
  std::string rows = "ncols 200\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 200; ++column)
      rows += std::string(column == 150 ? "30" : "0") + (column == 199 ? "\n" : " ");
  const auto file = folder.write("a.asc", rows);
  const auto highest = [&](double slope) {
    LoadOptions options;
    options.tile = RasterTile{0, 0, 20, 3, slope, 30.0};
    const auto scene = loadScene(file, options);
    EXPECT_TRUE(scene) << scene.error().text();
    // The tile itself and its rim are always there.
    EXPECT_GE(scene::triangleCount(*scene), 2U * 2U * 19U);
    EXPECT_LT(scene::triangleCount(*scene), 2U * 2U * 40U);
    return scene::bounds(*scene).max.z;
  };
  // From the tile's last cell it is 131 m to the tower.
  EXPECT_EQ(highest(30.0 / 120.0), 0.0);
  EXPECT_EQ(highest(30.0 / 132.0), 30.0);
  EXPECT_EQ(highest(30.0 / 170.0), 30.0);
}

TEST(Raster, geoTiffOfGothenburg) {
  const auto data = test::testData();
  if (data.empty()) GTEST_SKIP() << "no test data: set UMBRAGE_TEST_DATA";
  const auto file = data / "city/goteborg/DSM_KRbig.tif";
  const auto scene = loadScene(file);
  ASSERT_TRUE(scene) << scene.error().text();
  EXPECT_EQ(scene::triangleCount(*scene), 2U * 233U * 222U);
  EXPECT_EQ(scene->crs, "EPSG:3007");
  EXPECT_NEAR(scene::bounds(*scene).max.z, 58.07, 0.01);
  const auto info = inspectRaster(file);
  ASSERT_TRUE(info) << info.error().text();
  EXPECT_EQ(info->columns, 234);
  EXPECT_EQ(info->crs, "EPSG:3007");
}

TEST(Raster, brokenFilesAreErrors) {
  const test::Folder folder;
  EXPECT_EQ(loadScene(folder.write("a.tif", "II*")).error().code, ErrorCode::input);
  EXPECT_FALSE(loadScene(folder.write("b.asc", "ncols 6\n")));
  EXPECT_FALSE(inspectRaster(folder.write("c.obj", "v 0 0 0\n")));
  const auto huge =
      loadScene(folder.write("d.asc", "ncols 30000\nnrows 30000\nxllcorner 0\nyllcorner 0\ncellsize 1\n1"));
  ASSERT_FALSE(huge);
  EXPECT_NE(huge.error().message.find("tile by tile"), std::string::npos) << huge.error().text();
}

}  // namespace
}  // namespace umbrage::io

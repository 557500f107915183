#include "umbrage/terrain/terrain_hours.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "umbrage/sun/zone.hpp"

namespace umbrage::terrain {
namespace {

// Hills and towers, 90 x 70 cells of 2 m, with a hole.
std::filesystem::path writeTerrain() {
  // Every test in a program of its own may run at once with the others.
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
  const auto path = std::filesystem::temp_directory_path() / ("umbrage-terrain-" + test + ".asc");
  std::ofstream out(path);
  out << "ncols 90\nnrows 70\nxllcorner 5000\nyllcorner 7000\ncellsize 2\nNODATA_value -9999\n";
  for (int row = 0; row < 70; ++row)
    for (int column = 0; column < 90; ++column) {
      double height = 3.0 * std::sin(column * 0.11) + 2.0 * std::cos(row * 0.17);
      if (column % 23 < 4 && row % 19 < 5) height += 14.0 + column * 0.1;
      if (column == 40 && row == 33) height = -9999;
      out << height << (column == 89 ? '\n' : ' ');
    }
  return path;
}

std::vector<float> hoursIn(const std::filesystem::path& path, int tile, int step, TerrainReport* report = nullptr) {
  const auto place = sun::makePlace(48.2, 16.37);
  const auto day = std::chrono::sys_days(std::chrono::year(2026) / 9 / 18);
  TerrainOptions options;
  options.tile = tile;
  options.step = step;
  options.leastElevation = Angle::degrees(12);
  std::vector<float> all(std::size_t((90 + step - 1) / step) * std::size_t((70 + step - 1) / step), -2.0F);
  const int columns = (90 + step - 1) / step;
  const auto done = terrainHours(
      path, *place, {day, day + std::chrono::hours(24)}, options, [&](const TerrainTile& t) -> Result<void> {
        for (int r = 0; r < t.rows; ++r)
          for (int c = 0; c < t.columns; ++c)
            all[std::size_t((t.row + r) * columns + t.column + c)] = t.hours[std::size_t(r * t.columns + c)];
        return {};
      });
  EXPECT_TRUE(done) << done.error().text();
  if (report != nullptr && done) *report = *done;
  return all;
}

TEST(TerrainHours, tilesDoNotShow) {
  const auto path = writeTerrain();
  TerrainReport one, many;
  const auto whole = hoursIn(path, 1000, 1, &one), tiled = hoursIn(path, 16, 1, &many);
  EXPECT_EQ(one.tiles, 1U);
  EXPECT_EQ(many.tiles, 6U * 5U);
  EXPECT_LT(many.mostCasters, one.mostCasters / 2);
  ASSERT_EQ(whole.size(), tiled.size());
  for (std::size_t i = 0; i < whole.size(); ++i)
    EXPECT_NEAR(whole[i], tiled[i], 2.0 / 3600.0) << i % 90 << " " << i / 90;
  EXPECT_EQ(whole[33 * 90 + 40], -1.0F) << "no height";
  const auto [low, high] = std::minmax_element(whole.begin(), whole.end());
  EXPECT_LT(*low, 1.0F);
  EXPECT_NEAR(*high, double(one.up.count()) / 3.6e6, 1e-3);
  const auto coarse = hoursIn(path, 32, 4);
  for (int row = 0; row < 70; row += 4)
    for (int column = 0; column < 90; column += 4)
      ASSERT_NEAR(coarse[std::size_t(row / 4 * 23 + column / 4)], whole[std::size_t(row * 90 + column)], 2.0 / 3600.0);
  std::filesystem::remove(path);
}

TEST(TerrainHours, theSunMustRise) {
  const auto path = writeTerrain();
  const auto place = sun::makePlace(48.2, 16.37);
  const auto day = std::chrono::sys_days(std::chrono::year(2026) / 12 / 21);
  TerrainOptions options;
  options.leastElevation = Angle::degrees(40);
  const auto none = terrainHours(path, *place, {day, day + std::chrono::hours(24)}, options,
                                 [](const TerrainTile&) -> Result<void> { return {}; });
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::usage);
  const auto high = whileHigh(*place, {day, day + std::chrono::hours(24)}, Angle::degrees(10));
  EXPECT_NEAR(sun::sunPosition(*place, high.from).elevation.degrees(), 10.0, 1e-3);
  EXPECT_NEAR(sun::sunPosition(*place, high.to).elevation.degrees(), 10.0, 1e-3);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace umbrage::terrain

#include "report/frames.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "peers/ogre/stage.hpp"
#include "plot/chart.hpp"
#include "scenes/staged_scene.hpp"
#include "umbrage/base/file.hpp"

namespace umbrage::benchmarks {
namespace {

namespace fs = std::filesystem;

TEST(FrameTimes, SlowRoundsCancelInRatios) {
  FrameTimes::Shot shot;
  shot.times["ours"] = {10, 100, 10, 30, 10};
  shot.times["theirs"] = {20, 200, 20, 60, 20};
  EXPECT_EQ(ratio(shot, "theirs", "ours"), 2.0);
  EXPECT_EQ(medianTime(shot, "ours"), 10.0);
  EXPECT_TRUE(std::isnan(ratio(shot, "nobody", "ours")));
  EXPECT_TRUE(std::isnan(medianTime(shot, "nobody")));
}

TEST(FrameTimes, WhatIsNoFileOfTimesIsAnError) {
  const fs::path path = fs::path(testing::TempDir()) / "no_times.json";
  ASSERT_TRUE(writeFile(path, "{\"rounds\": 3}"));
  EXPECT_FALSE(readFrameTimes(path));
}

TEST(Export, PeersReadBackWhatWasStaged) {
  const StagedScene stage = city(10);
  const fs::path path = fs::path(testing::TempDir()) / "city.stage";
  ASSERT_TRUE(writeFile(path, exported(stage)));
  const auto read = peers::readStage(path.string());
  ASSERT_TRUE(read);
  ASSERT_EQ(read->parts.size(), stage.scene.instances.size());
  ASSERT_EQ(read->shots.size(), stage.shots.size());
  for (std::size_t i = 0; i < read->parts.size(); ++i) {
    const mesh::Mesh& mesh = *stage.scene.meshes[stage.scene.instances[i].mesh];
    EXPECT_EQ(read->parts[i].casts, stage.scene.instances[i].casts);
    EXPECT_EQ(read->parts[i].triangles, mesh.triangles);
    ASSERT_EQ(read->parts[i].corners.size(), mesh.positions.size());
    for (std::size_t c = 0; c < mesh.positions.size(); ++c)
      for (int k = 0; k < 3; ++k)
        EXPECT_EQ(read->parts[i].corners[c][static_cast<std::size_t>(k)], mesh.positions[c][k]);
  }
}

TEST(Export, MergingLosesNoTriangleAndKeepsToTheLimit) {
  const fs::path path = fs::path(testing::TempDir()) / "merged.stage";
  ASSERT_TRUE(writeFile(path, exported(city(10))));
  const auto read = peers::readStage(path.string());
  ASSERT_TRUE(read);
  const auto parts = peers::merged(read->parts, 100.0, 40);
  std::size_t triangles = 0;
  for (const peers::Part& part : parts) {
    EXPECT_LE(part.corners.size(), 40u);
    for (const auto& t : part.triangles)
      for (unsigned corner : t) EXPECT_LT(corner, part.corners.size());
    triangles += part.triangles.size();
  }
  EXPECT_EQ(triangles, 10u * 10u * 12u + 2u);
  EXPECT_LT(parts.size(), 30u);
}

TEST(Charts, ABarForEveryValueAndNoneForWhatIsMissing) {
  BarChart chart;
  chart.title = "A < B";
  chart.groups = {"one", "two"};
  chart.series = {{"x", {1, NAN}}, {"y", {2, 300}}};
  const std::string text = svg(chart);
  std::size_t bars = 0;
  for (auto at = text.find("height=\"14.0\""); at != std::string::npos; at = text.find("height=\"14.0\"", at + 1))
    ++bars;
  EXPECT_EQ(bars, 3u);
  EXPECT_NE(text.find("A &lt; B"), std::string::npos);
  EXPECT_EQ(text.find("nan"), std::string::npos);
}

TEST(Charts, LogarithmicAxesLeaveOutWhatHasNoLogarithm) {
  LineChart chart;
  chart.x.logarithmic = chart.y.logarithmic = true;
  chart.series = {{"x", {{10, 1}, {100, 0}, {1000, 100}}}};
  const std::string text = svg(chart);
  std::size_t dots = 0;
  for (auto at = text.find("<circle"); at != std::string::npos; at = text.find("<circle", at + 1)) ++dots;
  EXPECT_EQ(dots, 2u);
  EXPECT_EQ(text.find("inf"), std::string::npos);
}

TEST(Charts, NumbersAreShort) {
  EXPECT_EQ(shortNumber(0), "0");
  EXPECT_EQ(shortNumber(1234.5), "1234");
  EXPECT_EQ(shortNumber(84.46), "84.5");
  EXPECT_EQ(shortNumber(9.996), "10.0");
  EXPECT_EQ(shortNumber(0.3149), "0.31");
  EXPECT_EQ(shortNumber(2.5e6), "2.5M");
}

}  // namespace
}  // namespace umbrage::benchmarks

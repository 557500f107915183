#include "umbrage/study/receivers.hpp"

#include <gtest/gtest.h>

namespace umbrage::study {
namespace {

// The surface of a raster: corners at the middles of cells whose places, like a map's, no double holds exactly.
struct Slope {
  static constexpr int kColumns = 41, kRows = 29;
  static constexpr double kCell = 0.1, kWest = 147720.3, kNorth = 6398779.7;
  [[nodiscard]] static double height(int column, int row) { return column % 7 == 3 ? 30.0 : 0.25 * row; }
  [[nodiscard]] static scene::Scene scene() {
    mesh::Mesh m;
    for (int row = 0; row < kRows; ++row)
      for (int column = 0; column < kColumns; ++column)
        m.positions.emplace_back(kWest + (column + 0.5) * kCell, kNorth - (row + 0.5) * kCell, height(column, row));
    const auto corner = [](int column, int row) { return static_cast<std::uint32_t>(row * kColumns + column); };
    for (int row = 1; row < kRows; ++row)
      for (int column = 1; column < kColumns; ++column) {
        m.triangles.push_back({corner(column - 1, row - 1), corner(column - 1, row), corner(column, row)});
        m.triangles.push_back({corner(column - 1, row - 1), corner(column, row), corner(column, row - 1)});
      }
    scene::Scene scene;
    scene.up = scene::UpAxis::z;
    scene.materials.emplace_back();
    scene.meshes.push_back(std::make_shared<const mesh::Mesh>(std::move(m)));
    scene.instances.push_back({"terrain", 0, Mat4(1.0), true});
    return scene;
  }
  [[nodiscard]] static PlanExtent extent() { return {kWest, kNorth - kRows * kCell, kWest + kColumns * kCell, kNorth}; }
};

TEST(Receivers, stepsOfARastersCellsAreItsCells) {
  const auto set = rasterReceivers(Slope::scene(), Slope::extent(), Slope::kCell, 0.01);
  ASSERT_TRUE(set) << set.error().text();
  ASSERT_EQ(set->lattice.columns, Slope::kColumns);
  ASSERT_EQ(set->lattice.rows, Slope::kRows);
  EXPECT_EQ(set->lattice.west, Slope::kWest);
  EXPECT_EQ(set->lattice.north, Slope::kNorth);
  // No middle falls through a gap between triangles, not at the border either.
  ASSERT_EQ(set->receivers.size(), std::size_t(Slope::kColumns * Slope::kRows));
  for (int row = 0; row < Slope::kRows; ++row)
    for (int column = 0; column < Slope::kColumns; ++column) {
      const Receiver& r = set->receivers[std::size_t(row * Slope::kColumns + column)];
      // Slopes of 300 to 1 make of a rounded place (1e-9) a height within a millionth.
      EXPECT_NEAR(r.position.z, Slope::height(column, row) + 0.01, 1e-6) << column << ' ' << row;
      EXPECT_EQ(r.normal, Vec3(0, 0, 1));
    }
  EXPECT_EQ(set->described, "grid of 0.1 on the raster's surface, 0.01 above it, facing up");
}

TEST(Receivers, otherStepsBeginAtTheRastersCornerOrAtWholeSteps) {
  const auto cut = rasterReceivers(Slope::scene(), Slope::extent(), 1.0, 0.0);
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->lattice.columns, 5);  // 4.1 m
  EXPECT_EQ(cut->lattice.rows, 3);     // 2.9 m
  EXPECT_EQ(cut->lattice.west, Slope::kWest);
  const auto whole = rasterReceivers(Slope::scene(), std::nullopt, 1.0, 0.0);
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->lattice.west, 147720.0);
  EXPECT_EQ(whole->lattice.north, 6398780.0);
}

TEST(Receivers, aGridThatMissesTheSurfaceIsNoGrid) {
  for (const auto& none : {rasterReceivers(Slope::scene(), Slope::extent(), 50.0, 0.0),
                           groundReceivers(Slope::scene(), {"terrain"}, 1000.0, 0.0)}) {
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().code, ErrorCode::usage);
    EXPECT_NE(none.error().message.find("take smaller steps"), std::string::npos);
  }
}

TEST(Receivers, aRasterWithoutHeightsHasNoGround) {
  const auto none = rasterReceivers({}, std::nullopt, 1.0, 0.0);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::input);
}

TEST(Receivers, whereSurfacesMeetTheHighestCounts) {
  scene::Scene scene = Slope::scene();
  mesh::Mesh roof;
  roof.positions = {{147720, 6398770, 50}, {147730, 6398770, 50}, {147730, 6398790, 50}, {147720, 6398790, 50}};
  roof.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.meshes.push_back(std::make_shared<const mesh::Mesh>(std::move(roof)));
  scene.instances.push_back({"roof", 1, Mat4(1.0), true});
  const auto set = groundReceivers(scene, {"*"}, 1.0, 0.5);
  ASSERT_TRUE(set);
  for (const Receiver& r : set->receivers) EXPECT_EQ(r.position.z, 50.5);
  EXPECT_EQ(groundReceivers(scene, {"nobody"}, 1.0, 0.5).error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace umbrage::study

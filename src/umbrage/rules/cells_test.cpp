#include "umbrage/rules/cells.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "umbrage/outline/combine.hpp"
#include "umbrage/rules/targets.hpp"
#include "umbrage/rules/test_boxes.hpp"

namespace umbrage::rules {
namespace {

using namespace testing_boxes;

outline::Region triangle() {
  outline::Region region;
  region.polygons.push_back({{{0, 0}, {23.7, 3.1}, {5.3, 17.9}}, {}});
  region.area = outline::areaOf(region.polygons[0]);
  return region;
}

std::vector<CellMiddle> middlesOf(const outline::Region& region, double step) {
  const auto targets = areaTargets({{"a", region}}, sceneOf({}), step, 0.0);
  std::vector<CellMiddle> middles;
  for (const Target& t : targets->targets) middles.push_back({Vec2(t.receiver.position), false});
  return middles;
}

TEST(Cells, squaresOfAGrid) {
  const CellMiddle middles[] = {{{0.5, 0.5}, true}, {{1.5, 0.5}, true}, {{2.5, 0.5}, false}, {{0.5, 1.5}, true}};
  EXPECT_NEAR(cellsOf(middles, 1.0).area, 3.0, 1e-8);
  EXPECT_TRUE(cellsOf({}, 1.0).polygons.empty());
}

TEST(Cells, whatIsWantedAndWhatIsNotAreTheRegion) {
  rc::check([] {
    const outline::Region region = triangle();
    std::vector<CellMiddle> wanted = middlesOf(region, 1.9);
    RC_ASSERT(wanted.size() > 40u);
    for (CellMiddle& middle : wanted) middle.wanted = *rc::gen::arbitrary<bool>();
    std::vector<CellMiddle> others = wanted;
    for (CellMiddle& middle : others) middle.wanted = !middle.wanted;
    const outline::Region a = cellsWithin(region, wanted, 1.9), b = cellsWithin(region, others, 1.9);
    RC_ASSERT(std::abs(a.area + b.area - region.area) < 1e-5);
    RC_ASSERT(outline::common(a, b).area < 1e-5);
    RC_ASSERT(outline::without(a, region).area < 1e-5);
    for (const CellMiddle& middle : wanted) RC_ASSERT(outline::covers(a, middle.at) == middle.wanted);
  });
}

TEST(Cells, aRegionSmallerThanACell) {
  const outline::Region region = rectangle({0, 0}, {0.4, 7.0});
  std::vector<CellMiddle> middles = middlesOf(region, 20.0);
  ASSERT_EQ(middles.size(), 1u);
  EXPECT_TRUE(cellsWithin(region, middles, 20.0).polygons.empty());
  middles[0].wanted = true;
  EXPECT_NEAR(cellsWithin(region, middles, 20.0).area, 2.8, 1e-9);
}

}  // namespace
}  // namespace umbrage::rules

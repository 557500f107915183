#include "umbrage/rules/targets.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "umbrage/geo/projection.hpp"
#include "umbrage/outline/combine.hpp"
#include "umbrage/rules/rule_file.hpp"
#include "umbrage/rules/test_boxes.hpp"
#include "umbrage/rules/verify.hpp"

namespace umbrage::rules {
namespace {

using namespace testing_boxes;
using testing::HasSubstr;

const auto kDay = std::chrono::year(2026) / 1 / 1;

TEST(Targets, areasAreSharedOutByTheirSize) {
  const auto set = areaTargets({{"a", rectangle({0, 0}, {10, 7})}, {"tiny", rectangle({20.1, 20.1}, {20.2, 20.2})}},
                               sceneOf({}), 2.0, 1.0);
  ASSERT_TRUE(set);
  double sum[2] = {0, 0};
  for (const Target& t : set->targets) {
    sum[t.group] += t.weight;
    EXPECT_TRUE(outline::covers(t.group == 0 ? rectangle({0, 0}, {10, 7}) : rectangle({20.1, 20.1}, {20.2, 20.2}),
                                Vec2(t.receiver.position)));
    EXPECT_EQ(t.receiver.position.z, 1.0);
  }
  EXPECT_NEAR(sum[0], 70.0, 1e-9);
  EXPECT_NEAR(sum[1], 0.01, 1e-9);
  EXPECT_FALSE(areaTargets({{"a", rectangle({0, 0}, {1e6, 1e6})}}, sceneOf({}), 0.01, 0.0));
  EXPECT_FALSE(areaTargets({}, sceneOf({}), 1.0, 0.0));
}

TEST(Targets, linesAroundASite) {
  const Rule rule = *findRule("japan-4-2.5");
  const outline::Region site = rectangle({-10, -10}, {10, 10});
  const auto set = siteTargets({"site", site}, rule, sceneOf({}), {4.0, 0.5, 2.0, 30.0});
  ASSERT_TRUE(set);
  std::size_t five = 0, ten = 0, grid = 0;
  for (const Target& t : set->targets) {
    const double distance = outline::distanceTo(site, Vec2(t.receiver.position));
    EXPECT_NEAR(distance, t.fromSite, 1e-3);
    (t.weight > 0.0 ? grid : t.fromSite == 5.0 ? five : ten) += 1;
    EXPECT_TRUE(t.weight == 0.0 || (distance > 5.0 && distance <= 30.0));
  }
  EXPECT_GE(five, static_cast<std::size_t>((80 + 2 * M_PI * 5) / 0.5 * 0.99));
  EXPECT_GE(ten, static_cast<std::size_t>((80 + 2 * M_PI * 10) / 0.5 * 0.99));
  EXPECT_NEAR(double(grid) * 4.0, 400 + 80 * 30 + M_PI * 900 - (400 + 80 * 5 + M_PI * 25), 60.0);
  EXPECT_FALSE(siteTargets({"site", {}}, rule, sceneOf({}), {4.0, 0.5, 2.0, 30.0}));
  EXPECT_FALSE(siteTargets({"site", site}, *findRule("korea"), sceneOf({}), {4.0, 0.5, 2.0, 30.0}));
}

// What passes on all that a longer reach looks at passes where a lower scene is looked at.
TEST(Targets, aShorterReachHasSomeOfTheSamePoints) {
  const outline::Region site = rectangle({-10, -10}, {10, 11});
  const auto pointsWithin = [&](double reach) {
    std::set<std::pair<double, double>> points;
    const auto set = siteTargets({"site", site}, *findRule("japan-4-2.5"), sceneOf({}), {4.0, 0.25, 1.0, reach});
    for (const Target& t : set->targets) points.insert({t.receiver.position.x, t.receiver.position.y});
    return points;
  };
  const auto all = pointsWithin(60.0);
  for (const double reach : {20.0, 30.3, 41.75, 59.5})
    for (const auto& p : pointsWithin(reach))
      ASSERT_TRUE(all.contains(p)) << reach << ' ' << p.first << ' ' << p.second;
}

TEST(Targets, onlyWhatStandsOnTheSiteCasts) {
  const auto scene = castersOnSite(sceneOf({{{0, 0, 0}, {4, 4, 9}, "ours"}, {{50, 0, 0}, {54, 4, 9}, "theirs"}}),
                                   {"site", rectangle({-10, -10}, {10, 10})});
  ASSERT_TRUE(scene);
  EXPECT_TRUE(scene->instances[0].casts);
  EXPECT_FALSE(scene->instances[1].casts);
  EXPECT_FALSE(castersOnSite(sceneOf({{{50, 0, 0}, {54, 4, 9}}}), {"site", rectangle({-10, -10}, {10, 10})}));
}

// Beyond the reach no point has as much shadow as the rule's least threshold.
TEST(Targets, shadowsEndWithinTheirReach) {
  const sun::Place tokyo = place(35.68, 139.7);
  const scene::Scene house = sceneOf({{{-20, -6, 0}, {20, 6, 24}}});
  const VerifyRequest request{tokyo, *sun::parseZone("Asia/Tokyo"), kDay, Sensitivity::never};
  const auto reach = shadowReach(20.0, *findRule("japan-4-2.5"), request);
  EXPECT_GT(reach, 20.0);
  EXPECT_LT(reach, 20.0 * 12.0);
  TargetSet beyond{{}, {"site"}, 0.0, "beyond"};
  for (double x = -150; x <= 150; x += 5)
    for (const double y : {reach + 6.5, reach + 20.0})
      beyond.targets.push_back({{{x, y, 4.0}, {0, 0, 1}}, 1.0, 0, y - 6.0});
  const auto v = verify(house, nullptr, *findRule("japan-4-2.5"), beyond, request);
  ASSERT_TRUE(v);
  EXPECT_TRUE(v->passes);
}

// A rule about sun around a site: shadow matters while the rest of the day is less than it wants.
Rule sunAround(double hours, std::optional<double> to) {
  Rule rule = *findRule("japan-4-2.5");
  rule.requirements.erase(rule.requirements.begin());
  Requirement& r = rule.requirements[0];
  r.band = Band{5.0, to};
  r.anyOf[0].statistic = Statistic::sun, r.anyOf[0].comparison = Comparison::atLeast;
  r.anyOf[0].threshold = std::chrono::milliseconds(std::llround(hours * 3.6e6));
  return rule;
}

// How far from a long wall, 20 m over the plane, the last receiver fails.
double lastFailing(const Rule& rule, const VerifyRequest& request, double within) {
  const scene::Scene wall = sceneOf({{{-5000, -1, 0}, {5000, 0, 24}}});
  TargetSet line{{}, {"site"}, 0.0, "north of it"};
  for (double y = 5.5; y < within; ++y) line.targets.push_back({{{0, y, 4.0}, {0, 0, 1}}, 1.0, 0, y});
  const auto v = verify(wall, nullptr, rule, line, request);
  EXPECT_TRUE(v) << (v ? "" : v.error().text());
  double last = 0.0;
  for (const ReceiverResult& r : v->findings[0].receivers)
    if (!r.passes) last = std::max(last, line.targets[r.target].fromSite);
  return last;
}

TEST(Targets, shadowReachesWhereSunIsAskedForToo) {
  const VerifyRequest request{place(35.68, 139.7), *sun::parseZone("Asia/Tokyo"), kDay, Sensitivity::never};
  double before = 0.0;
  for (const double hours : {1.0, 4.0, 7.0}) {
    Rule rule = sunAround(hours, std::nullopt);
    const double reach = shadowReach(20.0, rule, request), last = lastFailing(rule, request, 1.5 * reach + 20.0);
    EXPECT_GT(last, before) << hours;  // the more is asked for, the farther
    EXPECT_LE(last, reach) << hours;
    EXPECT_GT(last, 0.4 * reach) << hours;  // of a wall shadows are shorter than of the corner of a tower
    before = last;
    rule.requirements[0].anyOf[0].statistic = Statistic::longestSun;
    EXPECT_LE(lastFailing(rule, request, 1.5 * reach + 20.0), shadowReach(20.0, rule, request)) << hours;
    EXPECT_GE(shadowReach(20.0, rule, request), reach) << hours;
  }
  // A moment in the middle of the day breaks a run of five of its eight hours.
  Rule run = sunAround(5.0, std::nullopt);
  run.requirements[0].anyOf[0].statistic = Statistic::longestSun;
  EXPECT_GT(shadowReach(20.0, run, request), shadowReach(20.0, sunAround(5.0, std::nullopt), request) * 0.999);
  EXPECT_EQ(shadowReach(20.0, sunAround(7.0, 30.0), request), 30.0);
  EXPECT_EQ(shadowReach(20.0, sunAround(9.0, std::nullopt), request), 0.0);  // no receiver has so much
  Rule share = sunAround(1.0, 70.0);
  share.requirements[0].share = 0.5;
  EXPECT_EQ(shadowReach(20.0, share, request), 70.0);  // all of the band is the whole
}

TEST(Targets, bandsThatBeginAtTheSite) {
  const outline::Region site = rectangle({-10, -10}, {10, 10});
  Rule rule = *findRule("japan-4-2.5");
  rule.requirements[0].band = Band{0.0, 10.0}, rule.requirements[1].band.reset();
  const auto set = siteTargets({"site", site}, rule, sceneOf({}), {4.0, 0.5, 2.0, 30.0});
  ASSERT_TRUE(set) << set.error().text();
  double nearest = 1e9, area = 0.0;
  for (const Target& t : set->targets) nearest = std::min(nearest, t.fromSite), area += t.weight;
  EXPECT_LE(nearest, 1.0);
  EXPECT_NEAR(area, 80.0 * 30 + M_PI * 900, 60.0);
}

TEST(Targets, partsMayReachBeyondTheSite) {
  const Area site{"site", rectangle({-10, -10}, {10, 10})};
  EXPECT_EQ(overhang(sceneOf({{{-4, -4, 0}, {4, 4, 9}}}), site), 0.0);
  EXPECT_NEAR(overhang(sceneOf({{{-4, -4, 0}, {13, 14, 9}}, {{50, 0, 0}, {90, 4, 9}}}), site), 5.0, 1e-9);
}

// Before any memory is used.
TEST(Targets, tooManyPointsAreRefused) {
  const outline::Region site = rectangle({-10, -10}, {10, 10});
  const auto refused = [](const Result<TargetSet>& set, const char* says) {
    ASSERT_FALSE(set);
    EXPECT_EQ(set.error().code, ErrorCode::usage);
    EXPECT_THAT(set.error().message, HasSubstr(says));
  };
  const Rule japan = *findRule("japan-4-2.5");
  refused(siteTargets({"site", site}, japan, sceneOf({}), {4.0, 1e-9, 4e-9, 30.0}), "take larger steps (--grid)");
  refused(siteTargets({"site", site}, japan, sceneOf({}), {4.0, 0.25, 1.0, 1e6}), "--min-altitude");
  refused(areaTargets(std::vector<Area>(20, {"a", rectangle({0, 0}, {1000, 1000})}), sceneOf({}), 1.0, 0.0), "--grid");
  refused(areaTargets({{"a", rectangle({0, 0}, {1e-9, 1e6})}}, sceneOf({}), 1e-3, 0.0), "--grid");
}

// The grid's rows go through a polygon of many corners as outline::covers says of each cell.
TEST(Targets, middlesLieWithinZigzags) {
  outline::Ring ring;
  for (int i = 0; i <= 400; ++i) ring.push_back({i % 2 == 0 ? 0.0 : 37.0 + i % 7, 0.25 * i});
  for (int i = 400; i >= 0; --i) ring.push_back({i % 2 == 0 ? 3.1 : 41.0 + i % 7, 0.25 * i + 0.05});
  outline::Region zigzag;
  zigzag.polygons.push_back({ring, {{{5, 20}, {5, 30}, {9, 30}, {9, 20}}}});
  zigzag.area = 1.0;
  const auto set = areaTargets({{"zigzag", zigzag}}, sceneOf({}), 0.4, 0.0);
  ASSERT_TRUE(set);
  std::set<std::pair<double, double>> found;
  for (const Target& t : set->targets) {
    EXPECT_TRUE(outline::covers(zigzag, Vec2(t.receiver.position)));
    found.insert({t.receiver.position.x, t.receiver.position.y});
  }
  EXPECT_EQ(found.size(), set->targets.size());
  std::size_t expected = 0;
  const Vec2 low(0.0, 0.0), high(47.0, 100.05);
  const Vec2 count = glm::ceil((high - low) / 0.4 - 1e-9);
  for (int j = 0; j < int(count.y); ++j)
    for (int i = 0; i < int(count.x); ++i)
      expected += outline::covers(zigzag, 0.5 * (low + high) + 0.4 * (Vec2(i + 0.5, j + 0.5) - 0.5 * count)) ? 1 : 0;
  EXPECT_NEAR(double(found.size()), double(expected), 2.0);
  EXPECT_GT(expected, 1000u);
}

class AreaFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("umbrage_areas_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  [[nodiscard]] Result<std::vector<Area>> read(const std::string& text, const scene::Scene& scene) const {
    std::ofstream(folder_ / "a.geojson") << text;
    return readAreas(folder_ / "a.geojson", scene);
  }
  std::filesystem::path folder_;
};

TEST_F(AreaFiles, polygonsHolesAndNames) {
  const auto areas = read(R"({"type":"FeatureCollection","crs":null,"features":[
    {"type":"Feature","properties":{"name":"park"},"geometry":{"type":"Polygon","coordinates":[[[0,0],[0,10],[10,10],[10,0],[0,0]],[[2,2],[4,2],[4,4],[2,4],[2,2]]]}},
    {"type":"Feature","id":7,"properties":null,"geometry":{"type":"MultiPolygon","coordinates":[[[[20,0],[30,0],[30,10],[20,0]]],[[[40,0],[50,0],[50,10],[40,0]]]]}},
    {"type":"Feature","properties":{},"geometry":{"type":"Point","coordinates":[1,2]}}]})",
                          sceneOf({}));
  ASSERT_TRUE(areas) << areas.error().text();
  ASSERT_EQ(areas->size(), 2u);
  EXPECT_EQ((*areas)[0].name, "park");
  EXPECT_NEAR((*areas)[0].region.area, 96.0, 1e-6);
  EXPECT_EQ((*areas)[1].name, "7");
  EXPECT_NEAR((*areas)[1].region.area, 100.0, 1e-6);
}

TEST_F(AreaFiles, degreesAreProjectedToTheScene) {
  scene::Scene scene = sceneOf({});
  scene.crs = geo::localCrs({16.37, 48.2});
  // A hundredth of a degree of latitude is 1112 m, of longitude there 743 m.
  const auto areas =
      read(R"({"type":"Polygon","coordinates":[[[16.37,48.2],[16.38,48.2],[16.38,48.21],[16.37,48.21],[16.37,48.2]]]})",
           scene);
  ASSERT_TRUE(areas) << areas.error().text();
  EXPECT_NEAR((*areas)[0].region.area, 1112.0 * 743.0, 4000.0);
  EXPECT_LT(glm::length((*areas)[0].region.polygons[0].outer[0]), 1400.0);
}

TEST_F(AreaFiles, refusals) {
  const auto refused = [&](const std::string& text, const char* says) {
    const auto areas = read(text, sceneOf({}));
    ASSERT_FALSE(areas) << says;
    EXPECT_EQ(areas.error().code, ErrorCode::input);
    EXPECT_THAT(areas.error().text(), HasSubstr(says));
  };
  refused(R"({"type":"Polygon","coordinates":[[[16,48],[17,48],[17,49],[16,48]]]})", "no reference system");
  refused(R"({"type":"Polygon","crs":null,"coordinates":[[[16,48],["x",48],[17,49],[16,48]]]})",
          "feature 1 is no polygon");
  refused(R"({"type":"FeatureCollection","crs":null,"features":[]})", "has no polygon");
  refused(R"({"type":"FeatureCollection","crs":null})", "has no polygon");
  refused(R"({"type":"Polygon","crs":null,"coordinates":[[[0,0],[1,1]]]})", "feature 1 is no polygon");
  refused("PK", "is not JSON");
  EXPECT_FALSE(readAreas(folder_ / "nothing.geojson", sceneOf({})));
}

}  // namespace
}  // namespace umbrage::rules

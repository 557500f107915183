#include "umbrage/rules/inverse.hpp"

#include <gmock/gmock.h>

#include "umbrage/rules/rule_file.hpp"
#include "umbrage/rules/test_boxes.hpp"

namespace umbrage::rules {
namespace {

using namespace testing_boxes;
using testing::HasSubstr;

const auto kDay = std::chrono::year(2026) / 1 / 1;

// The same volume built anew from its columns, of which one is raised.
scene::Scene rebuilt(const scene::Scene& context, const InverseEnvelope& found, std::size_t raise, double factor) {
  scene::Scene scene = context;
  for (std::size_t i = 0; i < found.columns.size(); ++i) {
    const outline::Ring& ring = found.columns[i].plan.polygons.at(0).outer;
    Vec2 low = ring[0], high = ring[0];
    for (const Vec2& p : ring) low = glm::min(low, p), high = glm::max(high, p);
    const double height = found.columns[i].height * (i == raise ? factor : 1.0);
    if (height <= 0.0) continue;
    scene.instances.push_back({"column", static_cast<std::uint32_t>(scene.meshes.size())});
    scene.meshes.push_back(std::make_shared<const mesh::Mesh>(meshOf({{low.x, low.y, 0.0}, {high.x, high.y, height}})));
  }
  return scene;
}

// It passes as it is, and fails with any one column raised by a hundredth (and at least a centimetre).
void expectTight(const scene::Scene& context, const scene::Scene* baseline, const Rule& rule, const TargetSet& targets,
                 const VerifyRequest& request, const InverseEnvelope& found, bool others = true) {
  EXPECT_TRUE(found.verdict.passes);
  scene::Scene stands = context;
  if (!others)
    for (scene::Instance& i : stands.instances) i.casts = false;
  const auto passes = [&](std::size_t raise, double factor) {
    const auto v = verify(rebuilt(stands, found, raise, factor), baseline, rule, targets, request);
    EXPECT_TRUE(v);
    return v && v->passes;
  };
  EXPECT_TRUE(passes(found.columns.size(), 1.0));
  for (std::size_t i = 0; i < found.columns.size(); ++i) {
    const Column& c = found.columns[i];
    if (!c.bounded) continue;
    EXPECT_FALSE(passes(i, std::max(1.0 + kRaise, 1.0 + kRaiseLeast / c.height))) << i << ' ' << c.height;
  }
}

TEST(InverseEnvelope, leavesWindowsTheirSun) {
  // Two windows of a house in the north of a site of 24 m by 12 m.
  const VerifyRequest request{place(39.9, 116.4), *sun::parseZone("Asia/Shanghai"), kDay, Sensitivity::never};
  study::ReceiverSet windows;
  windows.receivers = {{{-6, 0, 1.5}, {0, -1, 0}}, {{10, 0, 1.5}, {0, -1, 0}}};
  const scene::Scene house = sceneOf({{{-20, 0, 0}, {20, 10, 18}, "house"}});
  const Area site{"site", rectangle({-12, -26}, {12, -14})};
  InverseOptions options;
  options.cell = 6.0, options.most = 80.0;
  const auto found =
      inverseEnvelope(house, nullptr, *findRule("china-dahan-2"), pointTargets(windows), site, request, options);
  ASSERT_TRUE(found) << found.error().text();
  ASSERT_EQ(found->columns.size(), 8u);
  double volume = 0.0;
  for (const Column& c : found->columns) {
    EXPECT_NEAR(c.plan.area, 36.0, 1e-6);
    EXPECT_GT(c.height, 2.0);
    EXPECT_LE(c.height, options.most);
    volume += 36.0 * c.height;
  }
  EXPECT_NEAR(found->volume, volume, 1e-6 * volume);
  EXPECT_EQ(found->scene.instances.size(), 9u);
  expectTight(house, nullptr, *findRule("china-dahan-2"), pointTargets(windows), request, *found);
}

TEST(InverseEnvelope, staysWithinJapansLines) {
  const VerifyRequest request{place(35.68, 139.7), *sun::parseZone("Asia/Tokyo"), kDay, Sensitivity::never};
  const Area site{"site", rectangle({-12, -12}, {12, 12})};
  const Rule rule = *findRule("japan-3-2");
  // A neighbour, whose own shadow is no matter of the rule's.
  const scene::Scene context = sceneOf({{{30, -10, 0}, {60, 10, 40}, "neighbour"}});
  const auto targets = siteTargets(site, rule, context, {4.0, 3.0, 12.0, 60.0});
  ASSERT_TRUE(targets);
  InverseOptions options;
  options.cell = 8.0, options.most = 60.0;
  const auto found = inverseEnvelope(context, nullptr, rule, *targets, site, request, options);
  ASSERT_TRUE(found) << found.error().text();
  ASSERT_EQ(found->columns.size(), 9u);
  double lowest = 1e9;
  for (const Column& c : found->columns) lowest = std::min(lowest, c.height);
  EXPECT_GT(lowest, 4.0);  // what does not reach the plane has no shadow on it
  expectTight(context, nullptr, rule, *targets, request, *found, false);
}

TEST(InverseEnvelope, addsNoShadowToAPark) {
  const VerifyRequest request{place(40.71, -74.0), *sun::parseZone("America/New_York"), kDay, Sensitivity::never};
  const scene::Scene stands = sceneOf({{{-40, -10, 0}, {-14, 2, 15}, "old"}});
  const auto park = areaTargets({{"park", rectangle({-20, 30}, {10, 50})}}, stands, 5.0, 0.0);
  ASSERT_TRUE(park);
  const Area site{"site", rectangle({-10, -10}, {10, 0})};
  InverseOptions options;
  options.cell = 5.0, options.most = 100.0;
  const auto found = inverseEnvelope(stands, &stands, *findRule("nyc-ceqr"), *park, site, request, options);
  ASSERT_TRUE(found) << found.error().text();
  expectTight(stands, &stands, *findRule("nyc-ceqr"), *park, request, *found);
}

TEST(InverseEnvelope, whatDoesNotMatterGrowsToTheTop) {
  const VerifyRequest request{place(39.9, 116.4), *sun::parseZone("Asia/Shanghai"), kDay, Sensitivity::never};
  study::ReceiverSet windows;
  windows.receivers = {{{0, 0, 1.5}, {0, -1, 0}}};
  // North of the window, where the sun never stands; on a site that is no rectangle.
  outline::Region triangle;
  triangle.polygons.push_back({{{0, 10}, {12, 10}, {0, 22}}, {}});
  triangle.area = 72.0;
  InverseOptions options;
  options.cell = 4.0, options.most = 50.0;
  const auto found = inverseEnvelope(sceneOf({}), nullptr, *findRule("china-dahan-2"), pointTargets(windows),
                                     {"site", triangle}, request, options);
  ASSERT_TRUE(found) << found.error().text();
  EXPECT_EQ(found->columns.size(), 6u);
  double area = 0.0;
  for (const Column& c : found->columns) {
    EXPECT_EQ(c.height, 50.0);
    EXPECT_FALSE(c.bounded);
    area += c.plan.area;
  }
  EXPECT_NEAR(area, 72.0, 1e-6);
  EXPECT_NEAR(found->volume, 3600.0, 1e-3);
}

// Corners in feet are not whole cells of metres to the last digit.
TEST(InverseEnvelope, feetAreCutAsMetresAre) {
  const VerifyRequest request{place(39.9, 116.4), *sun::parseZone("Asia/Shanghai"), kDay, Sensitivity::never};
  study::ReceiverSet windows;
  windows.receivers = {{{0, 0, 1.5}, {0, -1, 0}}};
  InverseOptions options;
  options.cell = 5.0, options.most = 10.0;
  for (const double foot : {1.0, 0.3048, 1200.0 / 3937.0}) {
    scene::Scene scene = sceneOf({});
    scene.metresPerUnit = foot;
    // North of the window; to ten digits, as files have them.
    const auto rounded = [&](double metres) { return std::round(metres / foot * 1e7) / 1e7; };
    const Area site{"site", rectangle({rounded(-15), rounded(20)}, {rounded(15), rounded(45)})};
    const auto found =
        inverseEnvelope(scene, nullptr, *findRule("china-dahan-2"), pointTargets(windows), site, request, options);
    ASSERT_TRUE(found) << found.error().text();
    EXPECT_EQ(found->columns.size(), 30u) << foot;
    EXPECT_NEAR(found->volume, 7500.0, 0.1) << foot;
  }
}

TEST(InverseEnvelope, refusals) {
  const VerifyRequest request{place(39.9, 116.4), *sun::parseZone("Asia/Shanghai"), kDay, Sensitivity::never};
  study::ReceiverSet windows;
  windows.receivers = {{{0, 0, 1.5}, {0, 1, 0}}};
  const Area site{"site", rectangle({-10, -30}, {10, -20})};
  const auto refused = [&](const char* preset, const InverseOptions& options, const Area& on, const char* says) {
    const auto found =
        inverseEnvelope(sceneOf({}), nullptr, *findRule(preset), pointTargets(windows), on, request, options);
    ASSERT_FALSE(found) << says;
    EXPECT_EQ(found.error().code, ErrorCode::usage);
    EXPECT_THAT(found.error().message, HasSubstr(says));
  };
  refused("china-dahan-2", {}, site, "fails already");  // it looks to the north
  refused("china-dahan-2", {0.1}, site, "take larger ones");
  refused("china-dahan-2", {1.0}, {"site", {}}, "no area");
  refused("china-dahan-2", {1.0, 0.0}, site, "no height");
  refused("vancouver", {}, site, "--baseline");
}

}  // namespace
}  // namespace umbrage::rules

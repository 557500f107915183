#include "umbrage/rules/net_new.hpp"

#include <gtest/gtest.h>

#include "umbrage/outline/combine.hpp"
#include "umbrage/rules/rule_file.hpp"
#include "umbrage/rules/test_boxes.hpp"
#include "umbrage/study/sun_light.hpp"

namespace umbrage::rules {
namespace {

using namespace testing_boxes;

const sun::Place kNewYork = place(40.71, -74.0);
const sun::Zone kZone{sun::Zone::Kind::fixed, "-05:00", std::chrono::minutes(-300)};
const auto kDate = std::chrono::year(2026) / 3 / 21;
sun::Instant clock(std::chrono::milliseconds time) { return at(kZone, kNewYork, kDate, time); }
double seconds(std::chrono::milliseconds t) { return std::abs(double(t.count()) / 1000.0); }

const Block kOld{{-40, -10, 0}, {-10, 10, 12}, "old"};
const Block kTower{{-8, -6, 0}, {8, 6, 60}, "tower"};
const Block kSlab{{14, 20, 0}, {40, 32, 40}, "slab"};

Vec2 slopeAt(sun::Instant t) { return outline::shadowSlope(sun::sunPosition(kNewYork, t)); }

// The shadow of a box on its own ground.
double shadowOf(const Block& b, const Vec2& slope) {
  const Vec3 size = b.max - b.min;
  return size.x * size.y + size.z * (size.x * std::abs(slope.y) + size.y * std::abs(slope.x));
}

TEST(NetNew, areaOfTwoKnownBoxes) {
  // The tower grows from 20 m to 60 m: what it adds is the difference of two closed forms.
  Block low = kTower;
  low.max.z = 20;
  NetNewOptions options;
  options.times = {{clock(9h), clock(15h)}};
  for (const auto time : {9h, 10h, 11h, 12h, 13h, 14h}) options.moments.push_back(clock(time));
  const auto news = netNew(sceneOf({kOld, kTower}), sceneOf({kOld, low}), kNewYork, options);
  ASSERT_TRUE(news);
  EXPECT_EQ(news->added, std::vector<std::string>{"tower"});
  ASSERT_EQ(news->moments.size(), 6u);
  std::size_t alone = 0;
  for (const NewShadow& moment : news->moments) {
    const Vec2 slope = slopeAt(moment.at);
    // In the morning the shadows fall away from the old house; in the afternoon too, which stands in the west.
    const auto rest =
        outline::newShadow(outline::castersOf(sceneOf({kTower})), outline::castersOf(sceneOf({low})), slope);
    const double expected = shadowOf(kTower, slope) - shadowOf(low, slope);
    EXPECT_NEAR(rest.area / expected, 1.0, 1e-6);
    if (slope.x < 0.0) continue;  // towards the old house, which has a shadow there already
    ++alone;
    EXPECT_NEAR(moment.region.area / expected, 1.0, 1e-6);
    ASSERT_EQ(moment.byBuilding.size(), 1u);
    EXPECT_NEAR(moment.byBuilding[0].region.area, moment.region.area, 1e-9 * expected);
  }
  EXPECT_GE(alone, 2u);
}

// The moments at which a box's shadow lies on a rectangle, by two convex polygons and the axes that part them: closed forms of each moment.
bool shades(const Block& b, const Vec2& min, const Vec2& max, const Vec2& slope) {
  std::vector<Vec2> shadow;
  for (int i = 0; i < 8; ++i) {
    const Vec3 p((i & 1) != 0 ? b.max.x : b.min.x, (i & 2) != 0 ? b.max.y : b.min.y, (i & 4) != 0 ? b.max.z : b.min.z);
    shadow.push_back(Vec2(p) + p.z * slope);
  }
  const Vec2 park[] = {min, {max.x, min.y}, max, {min.x, max.y}};
  for (const Vec2& axis : {Vec2(1, 0), Vec2(0, 1), Vec2(-slope.y, slope.x)}) {
    double a0 = 1e300, a1 = -1e300, b0 = 1e300, b1 = -1e300;
    for (const Vec2& p : shadow) a0 = std::min(a0, glm::dot(p, axis)), a1 = std::max(a1, glm::dot(p, axis));
    for (const Vec2& p : park) b0 = std::min(b0, glm::dot(p, axis)), b1 = std::max(b1, glm::dot(p, axis));
    if (a1 <= b0 || b1 <= a0) return false;
  }
  return true;
}

detail::Spans visitsByHand(const Block& b, const Vec2& min, const Vec2& max, const study::TimeSpan& span) {
  const Look look(kNewYork, span, 0.0, 5s);
  return look.when([&](const Vec3& s) { return shades(b, min, max, -Vec2(s) / s.z); });
}

TEST(NetNew, entersAndLeavesWithinASecond) {
  const Vec2 min(-30, 45), max(-20, 65);
  NetNewOptions options;
  options.times = {{clock(7h + 30min), clock(16h + 30min)}};
  options.areas = {{"park", rectangle(min, max)}, {"far", rectangle({0, -300}, {10, -290})}};
  const auto news = netNew(sceneOf({kTower, kSlab}), sceneOf({}), kNewYork, options);
  ASSERT_TRUE(news);
  ASSERT_EQ(news->areas.size(), 2u);
  EXPECT_TRUE(news->areas[1].all.empty());
  EXPECT_EQ(news->areas[1].areaHours, 0.0);
  const AreaNews& park = news->areas[0];
  EXPECT_NEAR(park.size, 200.0, 1e-9);
  detail::Spans any;
  std::size_t found = 0;
  for (const Block& block : {kTower, kSlab}) {
    const detail::Spans expected = visitsByHand(block, min, max, options.times[0]);
    for (const study::TimeSpan& span : expected) any.push_back(span);
    std::vector<study::TimeSpan> spans;
    for (const Visit& v : park.visits)
      if (v.building == block.name) spans.push_back(v.span);
    ASSERT_EQ(spans.size(), expected.size()) << block.name;
    found += spans.size();
    for (std::size_t i = 0; i < spans.size(); ++i) {
      EXPECT_LT(seconds(spans[i].from - expected[i].from), 1.0) << block.name;
      EXPECT_LT(seconds(spans[i].to - expected[i].to), 1.0) << block.name;
    }
  }
  EXPECT_GE(found, 2u);
  EXPECT_EQ(park.visits.size(), found);
  any = detail::joined(any);
  ASSERT_EQ(park.all.size(), any.size());
  for (std::size_t i = 0; i < any.size(); ++i) EXPECT_LT(seconds(park.all[i].span.from - any[i].from), 1.0);
}

TEST(NetNew, areaHoursAreTheIntegral) {
  const Vec2 min(-30, 60), max(-10, 80);
  const outline::Region park = rectangle(min, max);
  NetNewOptions options;
  options.times = {{clock(8h), clock(12h)}, {clock(13h), clock(16h)}};
  options.areas = {{"park", park}};
  const auto news = netNew(sceneOf({kOld, kTower, kSlab}), sceneOf({kOld}), kNewYork, options);
  ASSERT_TRUE(news);
  // By the points of a fine grid, each counted moment by moment.
  double sum = 0.0;
  const Look morning(kNewYork, options.times[0], 0.0, 20s), afternoon(kNewYork, options.times[1], 0.0, 20s);
  for (double x = min.x + 0.25; x < max.x; x += 0.5)
    for (double y = min.y + 0.05; y < max.y; y += 0.1) {
      const study::Receiver r{{x, y, 0.0}, {0, 0, 1}};
      const auto isNew = [&](const Vec3& s) { return lit({kOld}, r, s) && hidden({kTower, kSlab}, r, s); };
      sum += 0.05 * (detail::hoursOf(detail::total(morning.when(isNew))) +
                     detail::hoursOf(detail::total(afternoon.when(isNew))));
    }
  EXPECT_GT(sum, 50.0);
  EXPECT_NEAR(news->areas[0].areaHours / sum, 1.0,
              5e-3);  // the grid's own error: the shadow is a strip of 50 rows at most
}

// The shadow of a box cut to a rectangle, side by side of the rectangle.
double shadeOn(const Block& b, const Vec2& min, const Vec2& max, const Vec2& slope) {
  // The corners of the hull of ground plan and roof: of each corner that of the two which lies farther out in some direction.
  std::vector<Vec2> points;
  for (int i = 0; i < 8; ++i) {
    const Vec3 p((i & 1) != 0 ? b.max.x : b.min.x, (i & 2) != 0 ? b.max.y : b.min.y, (i & 4) != 0 ? b.max.z : b.min.z);
    points.push_back(Vec2(p) + p.z * slope);
  }
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& c) { return a.x != c.x ? a.x < c.x : a.y < c.y; });
  outline::Ring hull;
  for (const int pass : {0, 1}) {
    const std::size_t base = hull.size();
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Vec2 p = pass == 0 ? points[k] : points[points.size() - 1 - k];
      const auto left = [&] {
        const Vec2 u = hull.back() - hull[hull.size() - 2], v = p - hull.back();
        return u.x * v.y - u.y * v.x > 0.0;
      };
      while (hull.size() >= base + 2 && !left()) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
  }
  for (int side = 0; side < 4; ++side) {
    const auto inside = [&](const Vec2& p) {
      return side == 0 ? p.x - min.x : side == 1 ? max.x - p.x : side == 2 ? p.y - min.y : max.y - p.y;
    };
    outline::Ring cut;
    for (std::size_t k = 0; k < hull.size(); ++k) {
      const Vec2 a = hull[k], c = hull[(k + 1) % hull.size()];
      const double da = inside(a), dc = inside(c);
      if (da >= 0.0) cut.push_back(a);
      if ((da >= 0.0) != (dc >= 0.0)) cut.push_back(a + (c - a) * (da / (da - dc)));
    }
    hull = cut;
    if (hull.size() < 3) return 0.0;
  }
  return outline::areaOf(hull);
}

TEST(NetNew, areaHoursOfOneBoxAreThoseOfItsClosedForm) {
  const Vec2 min(-30, 40), max(-10, 80);
  NetNewOptions options;
  options.times = {{clock(8h), clock(16h)}};
  options.areas = {{"park", rectangle(min, max)}};
  const auto news = netNew(sceneOf({kTower}), sceneOf({}), kNewYork, options);
  ASSERT_TRUE(news);
  const Look look(kNewYork, options.times[0], 0.0, 1s);
  double sum = 0.0, most = 0.0;
  for (const Vec3& s : look.suns) {
    const double area = shadeOn(kTower, min, max, -Vec2(s) / s.z);
    sum += area / 3600.0, most = std::max(most, area);
  }
  EXPECT_GT(sum, 50.0);
  EXPECT_NEAR(news->areas[0].areaHours / sum, 1.0, 1e-5);
  ASSERT_EQ(news->areas[0].visits.size(), 1u);
  EXPECT_NEAR(news->areas[0].visits[0].most / most, 1.0, 5e-3);  // looked at every 30 s
}

TEST(NetNew, whatStandsAlreadyCountsForNothing) {
  NetNewOptions options;
  options.times = {{clock(8h), clock(16h)}};
  options.areas = {{"park", rectangle({-30, 60}, {-10, 80})}};
  const auto same = netNew(sceneOf({kTower}), sceneOf({kTower}), kNewYork, options);
  ASSERT_FALSE(same);
  EXPECT_EQ(same.error().code, ErrorCode::usage);
  // A twin within what stands adds nothing, to the last square millimetre.
  Block twin = kTower;
  twin.name = "twin";
  const auto news = netNew(sceneOf({kTower, twin}), sceneOf({kTower}), kNewYork, options);
  ASSERT_TRUE(news);
  EXPECT_EQ(news->areas[0].areaHours, 0.0);
  EXPECT_TRUE(news->areas[0].all.empty());
}

TEST(NetNew, onPointsItIsWhoseBuildingItIs) {
  study::ReceiverSet points;
  points.receivers = {{{-25, 70, 0}, {0, 0, 1}}, {{20, 45, 0}, {0, 0, 1}}, {{0, -100, 0}, {0, 0, 1}}};
  const std::vector<study::TimeSpan> times{{clock(8h), clock(16h)}};
  const auto news = newOnPoints(sceneOf({kOld, kTower, kSlab}), sceneOf({kOld}), kNewYork, points, times);
  ASSERT_TRUE(news);
  ASSERT_EQ(news->size(), 3u);
  EXPECT_TRUE((*news)[2].all.empty());
  const Look look(kNewYork, times[0], 0.0, 20s);
  std::size_t found = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (const Block& block : {kTower, kSlab}) {
      const auto expected = look.when([&](const Vec3& s) {
        return lit({kOld}, points.receivers[i], s) && hidden({block}, points.receivers[i], s);
      });
      std::vector<study::TimeSpan> spans;
      for (const Visit& v : (*news)[i].visits)
        if (v.building == block.name) spans.push_back(v.span);
      ASSERT_EQ(spans.size(), expected.size()) << i << block.name;
      for (std::size_t k = 0; k < spans.size(); ++k, ++found) {
        EXPECT_LT(seconds(spans[k].from - expected[k].from), 1.0);
        EXPECT_LT(seconds(spans[k].to - expected[k].to), 1.0);
      }
    }
  EXPECT_GE(found, 2u);
}

// Of one building alone its visits are all there are.
TEST(NetNew, visitsOfOneBuildingAreAll) {
  NetNewOptions options;
  options.times = {{clock(8h), clock(16h)}};
  options.areas = {{"park", rectangle({-30, 30}, {-10, 50})}};
  const auto news = netNew(sceneOf({kOld, kTower}), sceneOf({kOld}), kNewYork, options);
  ASSERT_TRUE(news);
  const AreaNews& park = news->areas.at(0);
  ASSERT_FALSE(park.all.empty());
  ASSERT_EQ(park.visits.size(), park.all.size());
  for (std::size_t i = 0; i < park.all.size(); ++i) {
    EXPECT_EQ(park.visits[i].building, "tower");
    EXPECT_EQ(park.visits[i].span, park.all[i].span);
    EXPECT_EQ(park.visits[i].most, park.all[i].most);
  }
}

TEST(NetNew, daysThatAreToldOf) {
  const VerifyRequest request{kNewYork, kZone, kDate, Sensitivity::never};
  const auto park = areaTargets({{"park", rectangle({-30, 60}, {-10, 80})}}, sceneOf({}), 10.0, 0.0);
  const scene::Scene before = sceneOf({kOld}), after = sceneOf({kOld, kTower});
  const auto city = verify(after, &before, *findRule("nyc-ceqr"), *park, request);
  ASSERT_TRUE(city);
  EXPECT_EQ(newsDates(*city, request).size(), 4u);
  const auto boston = verify(after, &before, *findRule("vancouver"), *park, request);
  ASSERT_TRUE(boston);
  EXPECT_EQ(newsDates(*boston, request).size(), 1u);
}

// Of several requirements and measures the days are those of the one that decides.
TEST(NetNew, daysAreThoseOfWhatDecides) {
  const VerifyRequest request{kNewYork, kZone, kDate, Sensitivity::never};
  const auto park = areaTargets({{"park", rectangle({-30, 60}, {-10, 80})}}, sceneOf({}), 10.0, 0.0);
  const scene::Scene before = sceneOf({kOld}), after = sceneOf({kOld, kTower});
  Rule rule = *findRule("nyc-ceqr");
  const auto ofDay = [&](std::chrono::month_day day, Statistic statistic, Comparison comparison, auto threshold) {
    Measure m = rule.requirements[0].anyOf[0];
    m.days = {Days::Kind::dates, {day}, {}};
    m.statistic = statistic, m.comparison = comparison, m.threshold = threshold;
    return m;
  };
  using std::chrono::June, std::chrono::December;
  Requirement easy = rule.requirements[0], hard = rule.requirements[0];
  easy.name = "sun in June", hard.name = "no new shadow in December, or sun all day";
  easy.anyOf = {ofDay(June / 21, Statistic::sun, Comparison::atLeast, 1h)};
  hard.anyOf = {ofDay(December / 21, Statistic::sun, Comparison::atLeast, 23h),
                ofDay(December / 22, Statistic::newShadow, Comparison::atMost, 0h)};
  rule.requirements = {easy, hard};
  const auto v = verify(after, &before, rule, *park, request);
  ASSERT_TRUE(v);
  ASSERT_TRUE(v->findings[0].passes);
  ASSERT_FALSE(v->findings[1].passes);
  const Deciding deciding = decidingOf(*v);
  EXPECT_EQ(deciding.finding, 1u);
  EXPECT_EQ(deciding.measure, 1u);
  EXPECT_EQ(deciding.date, std::chrono::year(2026) / 12 / 22);
  EXPECT_EQ(newsDates(*v, request), std::vector{std::chrono::year_month_day(std::chrono::year(2026) / 12 / 22)});
  // Where all hold, the one with the least to spare.
  rule.requirements = {easy, easy};
  rule.requirements[1].anyOf[0].threshold = 2h;
  const auto passes = verify(after, &before, rule, *park, request);
  ASSERT_TRUE(passes && passes->passes);
  EXPECT_EQ(decidingOf(*passes).finding, 1u);
}

// Of shares over a part of the year no day is told of that the rule does not look at.
TEST(NetNew, daysOfSharesAreTheRulesOwn) {
  const VerifyRequest request{kNewYork, kZone, kDate, Sensitivity::never};
  const auto park = areaTargets({{"park", rectangle({-30, 60}, {-10, 80})}}, sceneOf({}), 20.0, 0.0);
  const scene::Scene before = sceneOf({kOld}), after = sceneOf({kOld, kTower});
  Rule rule = *findRule("san-francisco-1");
  Days& days = rule.requirements[0].anyOf[0].days;
  days.dates = {std::chrono::February / 1, std::chrono::July / 1}, days.every = 10;
  const auto v = verify(after, &before, rule, *park, request);
  ASSERT_TRUE(v);
  const auto dates = newsDates(*v, request);
  EXPECT_EQ(decidingOf(*v).date, std::nullopt);
  EXPECT_GE(dates.size(), 2u);
  for (const auto& date : dates) {
    EXPECT_GE(date, std::chrono::year(2026) / 2 / 1);
    EXPECT_LE(date, std::chrono::year(2026) / 7 / 1);
  }
}

}  // namespace
}  // namespace umbrage::rules

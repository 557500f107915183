#include "umbrage/rules/verify.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "umbrage/outline/combine.hpp"
#include "umbrage/rules/rule_file.hpp"
#include "umbrage/rules/test_boxes.hpp"

namespace umbrage::rules {
namespace {

using namespace testing_boxes;
using testing::HasSubstr;

const sun::Place kBeijing = place(39.9, 116.4);
const auto kDay = std::chrono::year(2026) / 1 / 1;
const sun::Zone kSolar{sun::Zone::Kind::solar, "solar", {}};

TargetSet window() {
  study::ReceiverSet set;
  set.receivers = {{{0.0, 0.0, 1.5}, {0.0, -1.0, 0.0}}};
  return pointTargets(set);
}
std::vector<Block> tower(double height) { return {{{-60, -20, 0}, {9, -12, height}, "tower"}}; }

Verdict verdictOf(const Rule& rule, double height, const VerifyRequest& request) {
  const auto v = verify(sceneOf(tower(height)), nullptr, rule, window(), request);
  EXPECT_TRUE(v) << (v ? "" : v.error().text());
  return v ? *v : Verdict{};
}

// Hours of sun from 8 to 16 by a clock, counted moment by moment.
double counted(double height, const sun::Zone& clock, const study::SunModel& model) {
  const auto date = std::chrono::year(2026) / 1 / 20;
  const Look look(kBeijing, {at(clock, kBeijing, date, 8h), at(clock, kBeijing, date, 16h)}, 0.0, 20s, model);
  return detail::hoursOf(
      detail::total(look.when([&](const Vec3& s) { return lit(tower(height), window().targets[0].receiver, s); })));
}

TEST(Verify, switchesSayWhatOtherConventionsWould) {
  VerifyRequest request{kBeijing, *sun::parseZone("+08:00"), kDay, Sensitivity::always};
  const double height = 14.0;
  const Verdict v = verdictOf(*findRule("china-dahan-2"), height, request);
  ASSERT_EQ(v.switches.size(), 4u);
  const auto noon = at(kSolar, kBeijing, std::chrono::year(2026) / 1 / 20, 12h);
  const std::tuple<const char*, sun::Zone, study::SunModel> expected[] = {
      {"clock", request.zone, {}},
      {"refraction", kSolar, {sun::Refraction::standard}},
      {"limb", kSolar, {sun::Refraction::none, study::SunPoint::upperLimb}},
      {"declination", kSolar, {sun::Refraction::none, study::SunPoint::centre, study::declinationAt(noon)}}};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& [name, clock, model] = expected[i];
    EXPECT_EQ(v.switches[i].name, name);
    const double margin = counted(height, clock, model) - 2.0;
    EXPECT_NEAR(v.switches[i].margin, margin, 1.5 / 3600) << name;
    EXPECT_EQ(v.switches[i].passes, margin >= 0.0) << name;
  }
  EXPECT_THAT(v.switches[0].instead, HasSubstr("+08:00"));
  EXPECT_EQ(v.switches[0].taken, "true solar time");
  EXPECT_NEAR(v.findings[0].margin, counted(height, kSolar, {}) - 2.0, 1.5 / 3600);
}

TEST(Verify, aVerdictTurnsWithTheClock) {
  // Near the threshold a clock of 25 minutes' difference decides.
  VerifyRequest request{kBeijing, *sun::parseZone("+08:00"), kDay};
  double low = 3.0, high = 60.0;
  for (int i = 0; i < 40; ++i) (counted(0.5 * (low + high), kSolar, {}) > 2.0 ? low : high) = 0.5 * (low + high);
  const Verdict passes = verdictOf(*findRule("china-dahan-2"), low * 0.9999, request);
  const Verdict fails = verdictOf(*findRule("china-dahan-2"), low * 1.0001, request);
  EXPECT_TRUE(passes.passes && passes.nearThreshold);
  EXPECT_TRUE(!fails.passes && fails.nearThreshold);
  ASSERT_EQ(passes.switches.size(), 4u);
  const double legal = counted(low, request.zone, {}) - 2.0;
  EXPECT_EQ(passes.switches[0].passes, legal > 0.0);
  // Far from it nobody asks.
  EXPECT_TRUE(verdictOf(*findRule("china-dahan-2"), 0.3 * low, request).switches.empty());
}

TEST(Verify, requestsThatMakeNoSenseAreRefused) {
  const auto refused = [&](const Rule& rule, const VerifyRequest& request, const TargetSet& targets, const char* says) {
    const auto v = verify(sceneOf(tower(9)), nullptr, rule, targets, request);
    ASSERT_FALSE(v) << says;
    EXPECT_EQ(v.error().code, ErrorCode::usage);
    EXPECT_THAT(v.error().message, HasSubstr(says));
  };
  const VerifyRequest beijing{kBeijing, kSolar, kDay};
  refused(*findRule("nsw"), beijing, window(), "southern hemisphere");
  refused(*findRule("china-dahan-2"), {place(-33, 150), kSolar, kDay}, window(), "northern hemisphere");
  refused(*findRule("vancouver"), beijing, window(), "--baseline");
  refused(*findRule("en17037-high"), beijing, window(), "--country");
  refused(*findRule("china-dahan-2"), beijing, {}, "no receivers");
  const TargetSet onlyPoints = window();
  refused(*findRule("japan-3-2"), beijing, onlyPoints, "no receiver lies where");
}

TEST(Verify, aMomentThatClocksLeaveOutIsNoFault) {
  Rule rule = *findRule("china-dahan-2");
  Measure& m = rule.requirements[0].anyOf[0];
  m.days = {Days::Kind::dates, {std::chrono::March / 29}, {}};
  m.window = {Clock::zone, 2h + 30min, 12h, {}, {}};
  const VerifyRequest vienna{place(48.2, 16.37), *sun::parseZone("Europe/Vienna"), kDay};
  const auto v = verify(sceneOf(tower(9)), nullptr, rule, window(), vienna);
  ASSERT_TRUE(v) << v.error().text();
  ASSERT_EQ(v->warnings.size(), 1u);
  EXPECT_THAT(v->warnings[0], HasSubstr("clocks were put forward from 02:00 to 03:00"));
}

// Of two days one has more sun, and one is nearer to what it was before: it is the latter that suits.
// Hours are those of the clock, also in windows of the sun's: in September its 8 hours last 7 s less, in December 10 s more.
TEST(Verify, whatTheSunItselfDoesNotGiveIsToldOf) {
  Rule rule = *findRule("china-dahan-2");
  Measure& m = rule.requirements[0].anyOf[0];
  m.threshold = 8h, m.days = {Days::Kind::longitudes, {}, {Angle::degrees(180)}};
  const VerifyRequest request{kBeijing, *sun::parseZone("+08:00"), kDay, Sensitivity::never};
  const Verdict september = verdictOf(rule, 0.1, request);
  EXPECT_FALSE(september.passes);
  ASSERT_EQ(september.warnings.size(), 1u);
  EXPECT_EQ(september.warnings[0], "no receiver can have what '" + rule.requirements[0].name +
                                       "' asks for: on 2026-09-23 the sun counts for 7:59:53 by the clock");
  // Under open sky it is there in December; of several days one that cannot hold is enough, of a best one it is not.
  m.days.longitudes = {Angle::degrees(270)};
  EXPECT_TRUE(verdictOf(rule, 0.1, request).warnings.empty());
  m.days.longitudes = {Angle::degrees(180), Angle::degrees(270)};
  EXPECT_EQ(verdictOf(rule, 0.1, request).warnings.size(), 1u);
  m.days.best = true;
  EXPECT_TRUE(verdictOf(rule, 0.1, request).warnings.empty());
  m.threshold = 8h + 5min;  // by no day: the longest one is named
  EXPECT_THAT(verdictOf(rule, 0.1, request).warnings, testing::ElementsAre(HasSubstr("on 2026-12-2")));
  // Another measure may hold.
  m.days.best = false;
  rule.requirements[0].anyOf.push_back(m);
  rule.requirements[0].anyOf[1].threshold = 2h;
  EXPECT_TRUE(verdictOf(rule, 0.1, request).warnings.empty());
  // Nor does the sun rise that high.
  rule.requirements[0].anyOf.pop_back();
  rule.requirements[0].anyOf[0].threshold = 2h;
  rule.requirements[0].anyOf[0].leastAltitude = Angle::degrees(80);
  EXPECT_THAT(verdictOf(rule, 0.1, request).warnings, testing::ElementsAre(HasSubstr("counts for 0:00:00 by")));
}

TEST(Verify, theBestDayIsThatOfTheWholeRule) {
  const sun::Place london = place(51.5, -0.1);
  Rule rule = *findRule("bre209");
  Requirement& r = rule.requirements[0];
  r.anyOf[0].days = {Days::Kind::dates, {std::chrono::January / 10, std::chrono::June / 21}, {}};
  r.anyOf[0].threshold = 4h;
  r.share = 0.9, r.former = 0.95;
  const auto garden = areaTargets({{"garden", rectangle({-10, 0}, {10, 24})}}, sceneOf({}), 2.0, 0.0);
  ASSERT_TRUE(garden);
  // A wall that keeps the garden dark in winter, and a roof that is new and shades some of it in summer.
  const std::vector<Block> old = {{{-400, -6, 0}, {400, -2, 12}}};
  std::vector<Block> now = old;
  now.push_back({{-14, -1, 1}, {14, 6, 1.5}, "roof"});
  const scene::Scene before = sceneOf(old), after = sceneOf(now);
  const auto on = [&](std::vector<std::chrono::month_day> dates, bool best) {
    Rule one = rule;
    one.requirements[0].anyOf[0].days.dates = std::move(dates), one.requirements[0].anyOf[0].days.best = best;
    const auto v = verify(after, &before, one, *garden, {london, kSolar, kDay, Sensitivity::never});
    EXPECT_TRUE(v) << (v ? "" : v.error().text());
    return v->findings.at(0);
  };
  const Finding winter = on({std::chrono::January / 10}, false), summer = on({std::chrono::June / 21}, false);
  ASSERT_GT(summer.share, winter.share);
  ASSERT_FALSE(summer.passes) << summer.share << ' ' << *summer.formerShare;
  ASSERT_TRUE(winter.passes) << winter.share << ' ' << *winter.formerShare;
  const Finding best = on({std::chrono::January / 10, std::chrono::June / 21}, true);
  EXPECT_TRUE(best.passes);
  EXPECT_EQ(best.receivers.at(*best.deciding).date, std::chrono::year(2026) / 1 / 10);
  EXPECT_EQ(best.formerShare, winter.formerShare);
  EXPECT_EQ(best.share, winter.share);
}

// Where nothing had enough before, nothing has to have now, and no receiver has anything to spare.
TEST(Verify, whatWasNeverThereIsNotMissed) {
  const scene::Scene wall = sceneOf({{{-400, -6, 0}, {400, -2, 60}}});
  const auto garden = areaTargets({{"garden", rectangle({-10, 0}, {10, 24})}}, wall, 2.0, 0.0);
  const auto v = verify(wall, &wall, *findRule("bre209"), *garden, {place(51.5, -0.1), kSolar, kDay});
  ASSERT_TRUE(v);
  const Finding& f = v->findings.at(0);
  EXPECT_TRUE(f.passes);
  EXPECT_EQ(f.share, 0.0);
  EXPECT_EQ(f.wanted, 0.0);
  EXPECT_EQ(f.margin, std::numeric_limits<double>::infinity());
  EXPECT_FALSE(v->nearThreshold);
}

TEST(Verify, nothingButSkyAndNoSunAtAll) {
  const scene::Scene empty = sceneOf({});
  const auto open = verify(empty, nullptr, *findRule("china-dahan-2"), window(), {kBeijing, kSolar, kDay});
  ASSERT_TRUE(open);
  EXPECT_TRUE(open->passes);
  // Eight hours of the true sun are six seconds longer than those of a clock in January.
  EXPECT_NEAR(open->findings[0].receivers[0].value, 8.0 + 5.9 / 3600, 0.5 / 3600);
  EXPECT_EQ(open->findings[0].receivers[0].spans.size(), 1u);
  // In the polar night there is none.
  const auto night = verify(empty, nullptr, *findRule("china-winter-1"), window(), {place(72, 20), kSolar, kDay});
  ASSERT_TRUE(night);
  EXPECT_FALSE(night->passes);
  EXPECT_EQ(night->findings[0].receivers[0].value, 0.0);
}

TEST(Verify, ledgerStatesTheConventions) {
  const auto v =
      verify(sceneOf(tower(9)), nullptr, *findRule("din5034-1"), window(), {place(52.5, 13.4), kSolar, kDay});
  ASSERT_TRUE(v);
  std::string text;
  for (const auto& line : v->ledger) text += line.subject + ": " + line.text + "\n";
  for (const char* part : {"din5034-1", "DIN 5034-1:2011", "52.5000 N", "2026-03-21", "centre of the disc", "geometric",
                           "declination moving", "from 6 degrees up", "1 unit of the file", "Made by"})
    EXPECT_THAT(text, HasSubstr(part));
}

TEST(Verify, sameWhateverTheAxesAndUnits) {
  // The same town with Y up, in feet, turned by its north, and far from the origin.
  const VerifyRequest request{kBeijing, kSolar, kDay, Sensitivity::never};
  const Verdict plain = verdictOf(*findRule("china-dahan-2"), 14.0, request);
  scene::Scene other;
  other.materials.push_back({});
  other.up = scene::UpAxis::y;
  other.metresPerUnit = 0.3048;
  other.northOffset = Angle::degrees(30);
  const Vec3 east = scene::eastVector(other.up, other.northOffset),
             north = scene::northVector(other.up, other.northOffset);
  const auto moved = [&](const Vec3& p) {
    return (p.x * east + p.y * north + p.z * Vec3(0, 1, 0)) / 0.3048 + Vec3(2048.0, 0.0, -4096.0);
  };
  mesh::Mesh m = meshOf(tower(14.0)[0]);
  for (Vec3& p : m.positions) p = moved(p);
  other.instances.push_back({"tower", 0});
  other.meshes.push_back(std::make_shared<const mesh::Mesh>(std::move(m)));
  study::ReceiverSet set;
  set.receivers = {{moved({0, 0, 1.5}), -north}};
  const auto v = verify(other, nullptr, *findRule("china-dahan-2"), pointTargets(set), request);
  ASSERT_TRUE(v);
  EXPECT_NEAR(v->findings[0].receivers[0].value, plain.findings[0].receivers[0].value, 2.0 / 3600);
}

// A strip along a park's border that reaches no middle of a cell of a metre.
struct Strip {
  scene::Scene before = sceneOf({{{-30, 10, 0}, {30, 22, 15}, "house"}});
  std::vector<Area> areas{{"park", rectangle({-30, -20}, {30, 0})}};
  VerifyRequest request{place(49.25, -123.1), *sun::parseZone("America/Vancouver"), kDay};
  [[nodiscard]] Verdict verdictOf(const Rule& rule, double wall, double step = 1.0) const {
    const auto now = sceneOf({{{-30, 10, 0}, {30, 22, 15}, "house"}, {{-300, -40, 0}, {300, -25, wall}, "wall"}});
    const auto targets = areaTargets(areas, now, step, 0.0);
    const auto v = verify(now, &before, rule, *targets, request);
    EXPECT_TRUE(v) << (v ? "" : v.error().text());
    return v ? *v : Verdict{};
  }
};

TEST(NewOutlines, noNewShadowMeansNone) {
  const Strip strip;
  const Verdict v = strip.verdictOf(*findRule("vancouver"), 4.68);
  const Finding& f = v.findings.at(0);
  EXPECT_EQ(f.share, 1.0);  // no middle sees it
  EXPECT_FALSE(v.passes);
  ASSERT_TRUE(f.outlines);
  // The shadow of a long wall is its height times cot of the height of the sun, towards the north: by hand, day by day.
  double all = 0.0, most = 0.0;
  std::size_t days = 0;
  for (const auto& date : datesOf(v.rule.requirements[0].anyOf[0], strip.request)) {
    double sum = 0.0;
    const auto ten = at(strip.request.zone, strip.request.place, date, 10h);
    constexpr auto kStep = 10s;
    for (sun::Instant t = ten; t < ten + 6h; t += kStep) {
      const auto p = sun::sunPosition(strip.request.place, t + kStep / 2);
      const double north = -std::cos(p.azimuth.radians()) / std::tan(p.elevation.radians()) * 4.68;
      sum += 60.0 * std::max(0.0, north - 5.0) * detail::hoursOf(kStep);
    }
    all += sum, most = std::max(most, sum), days += sum > 0.0 ? 1 : 0;
  }
  EXPECT_EQ(f.outlines->days, days);
  EXPECT_NEAR(f.outlines->areaHours, all, 1e-3 * all);
  EXPECT_NEAR(f.outlines->areaHoursThen, most, 1e-3 * most);
  EXPECT_LT(f.margin, 0.0);
  EXPECT_EQ(decidingOf(v).date, f.outlines->date);
  // As much as touches the border passes, however coarse the grid; any more does not.
  EXPECT_TRUE(strip.verdictOf(*findRule("vancouver"), 4.0).passes);
  EXPECT_FALSE(strip.verdictOf(*findRule("vancouver"), 4.68, 20.0).passes);
}

TEST(NewOutlines, ofSharesOfAYearTheyAreTheShare) {
  const Strip strip;
  Rule rule = *findRule("san-francisco-0");
  rule.requirements[0].anyOf[0].days = findRule("vancouver")->requirements[0].anyOf[0].days;
  rule.requirements[0].anyOf[0].window = findRule("vancouver")->requirements[0].anyOf[0].window;
  const Finding f = strip.verdictOf(rule, 4.68).findings.at(0);
  EXPECT_FALSE(f.passes);
  ASSERT_TRUE(f.outlines);
  EXPECT_EQ(f.newAreaHours, f.outlines->areaHours);
  EXPECT_NEAR(*f.newShare, f.newAreaHours / (1200.0 * 6.0 * 28.0), 1e-6);
  // A limit above none is one of the middles, as before.
  rule.requirements[0].mostNew = 0.001;
  EXPECT_FALSE(strip.verdictOf(rule, 4.68).findings.at(0).outlines);
}

TEST(NewOutlines, eachAreaByItself) {
  Strip strip;
  strip.areas = {{"south", rectangle({-30, -20}, {30, -10})}, {"north", rectangle({-30, -10}, {30, 0})}};
  const Verdict v = strip.verdictOf(*findRule("vancouver"), 4.68);
  ASSERT_EQ(v.findings.size(), 2u);
  EXPECT_FALSE(v.findings[0].passes);
  EXPECT_TRUE(v.findings[1].passes);
}

// A tower's foot and a park's border are one line that both files have rounded; the shadow falls to the other side.
TEST(NewOutlines, whatTouchesTheBorderCastsNothingOnIt) {
  const auto turned = [](const Vec2& p, double angle) {
    const Vec2 q(p.x * std::cos(angle) - p.y * std::sin(angle), p.x * std::sin(angle) + p.y * std::cos(angle));
    return Vec2(std::round(q.x * 1e6), std::round(q.y * 1e6)) / 1e6;
  };
  const auto passes = [&](double angle, double depth) {
    scene::Scene now = sceneOf({{{-17, -depth, 0}, {13, 12, 40}, "tower"}});
    mesh::Mesh m = *now.meshes[0];
    for (Vec3& p : m.positions) p = Vec3(turned(Vec2(p), angle), p.z);
    now.meshes[0] = std::make_shared<const mesh::Mesh>(m);
    outline::Region park;
    outline::Ring ring;
    for (const Vec2& p : {Vec2(-30, -20), Vec2(30, -20), Vec2(30, 0), Vec2(-30, 0)}) ring.push_back(turned(p, angle));
    park.polygons.push_back({ring, {}}), park.area = 1200.0;
    const auto targets = areaTargets({{"park", park}}, now, 1.0, 0.0);
    const scene::Scene before = sceneOf({{{-30, 40, 0}, {30, 52, 15}, "house"}});
    const auto v = verify(now, &before, *findRule("vancouver"), *targets, Strip().request);
    EXPECT_TRUE(v);
    return v && v->passes;
  };
  for (const double angle : {0.0, 0.1, -0.15, 0.2}) {
    EXPECT_TRUE(passes(angle, 0.0)) << angle;
    EXPECT_FALSE(passes(angle, 0.01)) << angle;  // it stands a centimetre within
  }
}

TEST(NewOutlines, whatStoodBeforeIsNotNewByAnotherName) {
  const Strip strip;
  const auto targets = areaTargets(strip.areas, strip.before, 1.0, 0.0);
  const scene::Scene before = sceneOf({{{-300, -40, 0}, {300, -25, 9}, "wall"}});
  const scene::Scene now =
      sceneOf({{{-300, -40, 0}, {17.3, -25, 9}, "left"}, {{17.3, -40, 0}, {300, -25, 9}, "right"}});
  const auto v = verify(now, &before, *findRule("vancouver"), *targets, strip.request);
  ASSERT_TRUE(v);
  EXPECT_TRUE(v->passes);
  // Nothing added at all.
  const auto same = verify(before, &before, *findRule("vancouver"), *targets, strip.request);
  ASSERT_TRUE(same);
  EXPECT_TRUE(same->passes);
}

}  // namespace
}  // namespace umbrage::rules

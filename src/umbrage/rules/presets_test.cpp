// Every preset on three scenes: one that passes, one that fails, and one at the border, whose height was found by counting the moments at
// which a box hides the sun, day by day and window by window, as written out here by hand.
#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "umbrage/rules/rule_file.hpp"
#include "umbrage/rules/test_boxes.hpp"
#include "umbrage/rules/verify.hpp"

namespace umbrage::rules {
namespace {

using namespace testing_boxes;
using std::chrono::milliseconds;
using std::chrono::year_month_day;
using std::chrono::operator""y;

year_month_day day(unsigned month, unsigned d, int year = 2026) {
  return std::chrono::year(year) / std::chrono::month(month) / std::chrono::day(d);
}
const sun::Zone kSolar{sun::Zone::Kind::solar, "solar", {}};
sun::Zone zone(const char* name) { return *sun::parseZone(name); }

double hours(milliseconds t) { return double(t.count()) / 3.6e6; }

// What one day says of one receiver, on the passing side above 0. `blocks` stand now, `former` stood before.
using Margin = std::function<double(const Look&, const std::vector<Block>& blocks, const study::Receiver&)>;

Margin sunAtLeast(double wanted) {
  return [=](const Look& look, const auto& blocks, const auto& r) {
    return hours(detail::total(look.when([&](const Vec3& s) { return lit(blocks, r, s); }))) - wanted;
  };
}
Margin runAtLeast(double wanted) {
  return [=](const Look& look, const auto& blocks, const auto& r) {
    return hours(detail::longest(look.when([&](const Vec3& s) { return lit(blocks, r, s); }))) - wanted;
  };
}
Margin shadowBelow(double limit) {
  return [=](const Look& look, const auto& blocks, const auto& r) {
    return limit - hours(detail::total(look.when([&](const Vec3& s) { return !lit(blocks, r, s); })));
  };
}

// One preset at one place: the looks of all its days, written out.
struct Setting {
  std::string preset;
  sun::Place place;
  sun::Zone zone;
  std::vector<Look> looks;
  Margin margin;
  bool best = false;  // the best of the looks, not the worst
  double share = 1.0;
  bool firstOnly = false;  // the second requirement is looked at elsewhere
  double altitude = -1.0;  // given to the rule
};

double ofReceiver(const Setting& s, const std::vector<Block>& blocks, const study::Receiver& r) {
  double worst = 1e9, best = -1e9;
  for (const Look& look : s.looks) {
    const double m = s.margin(look, blocks, r);
    worst = std::min(worst, m), best = std::max(best, m);
  }
  return s.best ? best : worst;
}

// The margin of the receiver that decides, by shares.
double truth(const Setting& s, const TargetSet& targets, const std::vector<Block>& blocks) {
  std::vector<double> margins;
  for (const Target& t : targets.targets) margins.push_back(ofReceiver(s, blocks, t.receiver));
  std::sort(margins.rbegin(), margins.rend());
  const auto wanted = static_cast<std::size_t>(std::ceil(s.share * double(margins.size()) - 1e-9));
  return margins[wanted - 1];
}

Rule ruleOf(const Setting& s) {
  auto rule = findRule(s.preset);
  EXPECT_TRUE(rule) << s.preset;
  return s.altitude >= 0.0 ? withLeastAltitude(*rule, Angle::degrees(s.altitude)) : *rule;
}

using Obstacle = std::function<std::vector<Block>(double height)>;

// The height at which the margin is 0.
double borderOf(const Setting& s, const TargetSet& targets, const Obstacle& obstacle, double low, double high) {
  EXPECT_GT(truth(s, targets, obstacle(low)), 0.0) << s.preset;
  EXPECT_LT(truth(s, targets, obstacle(high)), 0.0) << s.preset;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (truth(s, targets, obstacle(middle)) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// Those that have three scenes below. Each is named by its test, too.
const std::set<std::string> kHeld = {"japan-3-2",
                                     "japan-4-2.5",
                                     "japan-5-3",
                                     "japan-hokkaido-2-1.5",
                                     "japan-hokkaido-3-2",
                                     "japan-hokkaido-4-2.5",
                                     "china-dahan-2",
                                     "china-dahan-3",
                                     "china-winter-1",
                                     "korea",
                                     "en17037-minimum",
                                     "en17037-medium",
                                     "en17037-high",
                                     "bre209",
                                     "din5034-1",
                                     "din5034-1-winter",
                                     "tno-light",
                                     "tno-strict",
                                     "poland",
                                     "poland-centre",
                                     "poland-children",
                                     "nsw",
                                     "nsw-regional",
                                     "montreal-parks",
                                     "montreal-streets",
                                     "montreal-vibrant-streets",
                                     "vancouver",
                                     "boston-parks",
                                     "boston-midtown",
                                     "san-francisco-0",
                                     "san-francisco-0.1",
                                     "san-francisco-1",
                                     "nyc-ceqr"};

// One for all verdicts of a test: most of their time is the sun's.
std::shared_ptr<SunDays> sunDays() {
  static const auto days = makeSunDays();
  return days;
}
VerifyRequest requestOf(const Setting& s) {
  VerifyRequest request{s.place, s.zone, day(6, 1), Sensitivity::never};
  request.days = sunDays();
  return request;
}

Verdict verdictOf(const Setting& s, const TargetSet& targets, const std::vector<Block>& blocks,
                  Sensitivity sensitivity) {
  VerifyRequest request = requestOf(s);
  request.sensitivity = sensitivity;
  auto verdict = verify(sceneOf(blocks), nullptr, ruleOf(s), targets, request);
  EXPECT_TRUE(verdict) << s.preset << (verdict ? "" : verdict.error().text());
  return verdict ? *verdict : Verdict{};
}

double leastMargin(const Setting& s, const Verdict& v) {
  if (s.firstOnly) return v.findings.front().margin;
  double least = 1e9;
  for (const Finding& f : v.findings) least = std::min(least, f.margin);
  return least;
}

constexpr double kSecond = 1.0 / 3600.0;

// Passes well below the border, fails well above it, and stands within a second of the truth at it.
void expectThree(const Setting& s, const TargetSet& targets, const Obstacle& obstacle, double low, double high) {
  EXPECT_TRUE(kHeld.contains(s.preset));
  const double border = borderOf(s, targets, obstacle, low, high);
  for (const double share : {0.97}) {
    const Verdict v = verdictOf(s, targets, obstacle(border * share), Sensitivity::never);
    EXPECT_TRUE(v.passes) << s.preset << ' ' << share << ' ' << leastMargin(s, v);
    EXPECT_NEAR(leastMargin(s, v), truth(s, targets, obstacle(border * share)), 1.5 * kSecond) << s.preset;
  }
  for (const double share : {1.03}) {
    const Verdict v = verdictOf(s, targets, obstacle(border * share), Sensitivity::never);
    EXPECT_FALSE(v.passes) << s.preset << ' ' << share << ' ' << leastMargin(s, v);
    EXPECT_NEAR(leastMargin(s, v), truth(s, targets, obstacle(border * share)), 1.5 * kSecond) << s.preset;
  }
  const Verdict v = verdictOf(s, targets, obstacle(border), Sensitivity::never);
  EXPECT_NEAR(leastMargin(s, v), 0.0, 1.5 * kSecond) << s.preset;
  EXPECT_TRUE(v.nearThreshold) << s.preset;
}

TargetSet points(const std::vector<study::Receiver>& receivers) {
  study::ReceiverSet set;
  set.receivers = receivers;
  set.described = "points";
  return pointTargets(set);
}

// A window that looks at the noon sun, and a broad block before it, off to one side, so that hours are lost from one end.
Obstacle southOf(double from, double to, double distance = 12.0) {
  return [=](double height) { return std::vector<Block>{{{from, -distance - 8.0, 0.0}, {to, -distance, height}}}; };
}
Obstacle northOf(double from, double to, double distance = 12.0) {
  return [=](double height) { return std::vector<Block>{{{from, distance, 0.0}, {to, distance + 8.0, height}}}; };
}
const study::Receiver kSouthWindow{{0.0, 0.0, 1.5}, {0.0, -1.0, 0.0}};
const study::Receiver kNorthWindow{{0.0, 0.0, 1.5}, {0.0, 1.0, 0.0}};

Look look(const Setting& s, year_month_day date, const sun::Zone& clock, milliseconds from, milliseconds to,
          double altitude = 0.0, milliseconds step = 20s) {
  return Look(s.place, {at(clock, s.place, date, from), at(clock, s.place, date, to)}, altitude, step);
}

TEST(Presets, China) {
  for (const auto& [name, wanted, winter] :
       {std::tuple("china-dahan-2", 2.0, false), std::tuple("china-dahan-3", 3.0, false),
        std::tuple("china-winter-1", 1.0, true)}) {
    Setting s{name, place(39.9, 116.4), zone("Asia/Shanghai"), {}, sunAtLeast(wanted)};
    // Dahan falls on 20 January 2026, the solstice on 22 December by Chinese time.
    s.looks.push_back(winter ? look(s, day(12, 22), kSolar, 9h, 15h) : look(s, day(1, 20), kSolar, 8h, 16h));
    expectThree(s, points({kSouthWindow}), southOf(-60.0, 25.0), 3.0, 60.0);
  }
}

TEST(Presets, Korea) {
  Setting s{"korea", place(37.57, 126.98), zone("Asia/Seoul"), {}, {}};
  s.looks.push_back(look(s, day(12, 22), kSolar, 8h, 16h));
  const Look inner = look(s, day(12, 22), kSolar, 9h, 15h);
  s.margin = [inner](const Look& whole, const auto& blocks, const auto& r) {
    return std::max(sunAtLeast(4.0)(whole, blocks, r), runAtLeast(2.0)(inner, blocks, r));
  };
  expectThree(s, points({kSouthWindow}), southOf(-60.0, 9.0), 3.0, 60.0);
  // A tower in the middle cuts the day in two: 2 h without break are lost before 4 h in all, or the other way round.
  expectThree(
      s, points({kSouthWindow}),
      [](double width) {
        return std::vector<Block>{{{-width, -20, 0}, {width, -12, 80}}};
      },
      0.1, 60.0);
}

TEST(Presets, En17037) {
  for (const auto& [name, wanted] :
       {std::pair("en17037-minimum", 1.5), std::pair("en17037-medium", 3.0), std::pair("en17037-high", 4.0)}) {
    Setting s{name, place(52.5, 13.4), zone("Europe/Berlin"), {}, sunAtLeast(wanted), true, 1.0, false, 11.0};
    for (std::chrono::sys_days d = day(2, 1); d <= std::chrono::sys_days(day(3, 21)); d += std::chrono::days(1))
      s.looks.push_back(look(s, d, kSolar, 0h, 24h, 11.0, 60s));
    expectThree(s, points({kSouthWindow}), southOf(-60.0, 25.0), 3.0, 60.0);
    const auto country = withCountry(*findRule(name), "DE");
    ASSERT_TRUE(country);
    EXPECT_DOUBLE_EQ(country->requirements[0].anyOf[0].leastAltitude->degrees(), 11.0);
  }
}

TEST(Presets, Bre209) {
  Setting s{"bre209", place(51.5, -0.1), zone("Europe/London"), {}, sunAtLeast(2.0), false, 0.5};
  s.looks.push_back(look(s, day(3, 21), kSolar, 0h, 24h));
  const auto garden = areaTargets({{"garden", rectangle({-10, 0}, {10, 12})}}, sceneOf({}), 4.0, 0.0);
  ASSERT_TRUE(garden);
  ASSERT_EQ(garden->targets.size(), 15u);
  expectThree(s, *garden, southOf(-60.0, 60.0, 2.0), 1.0, 60.0);
}

TEST(Presets, Bre209AgainstWhatWasThere) {
  const sun::Place london = place(51.5, -0.1);
  const Look look(london, {at(kSolar, london, day(3, 21), 0h), at(kSolar, london, day(3, 21), 24h)}, 0.0);
  const auto garden = areaTargets({{"garden", rectangle({-10, 0}, {10, 24})}}, sceneOf({}), 2.0, 0.0);
  ASSERT_TRUE(garden);
  const auto shareOf = [&](const std::vector<Block>& blocks) {
    double passing = 0.0;
    for (const Target& t : garden->targets) passing += sunAtLeast(2.0)(look, blocks, t.receiver) >= 0.0 ? 1.0 : 0.0;
    return passing / double(garden->targets.size());
  };
  double stands = 10.0;
  while (shareOf(southOf(-400, 400, 2.0)(stands)) > 0.45) stands += 2.0;
  const std::vector<Block> before = southOf(-400, 400, 2.0)(stands);
  const double former = shareOf(before);
  ASSERT_GT(former, 0.1);
  bool passed = false, failed = false;
  for (const double more : {1.0, 1.02, 1.05, 1.1, 1.2, 1.4}) {
    const double height = more * stands;
    const std::vector<Block> now = southOf(-400, 400, 2.0)(height);
    const auto v =
        verify(sceneOf(now), nullptr, *findRule("bre209"), *garden, {london, kSolar, day(3, 21), Sensitivity::never});
    ASSERT_TRUE(v);
    EXPECT_FALSE(v->passes);
    EXPECT_EQ(v->warnings.size(), 1u);
    const scene::Scene stood = sceneOf(before);
    const auto against =
        verify(sceneOf(now), &stood, *findRule("bre209"), *garden, {london, kSolar, day(3, 21), Sensitivity::never});
    ASSERT_TRUE(against);
    EXPECT_NEAR(*against->findings[0].formerShare, former, 1e-9);
    EXPECT_EQ(against->passes, shareOf(now) >= 0.8 * former - 1e-12) << height;
    (against->passes ? passed : failed) = true;
  }
  EXPECT_TRUE(passed && failed);
}

TEST(Presets, Din5034) {
  for (const auto& [name, wanted, date] :
       {std::tuple("din5034-1", 4.0, day(3, 21)), std::tuple("din5034-1-winter", 1.0, day(1, 17))}) {
    Setting s{name, place(52.5, 13.4), zone("Europe/Berlin"), {}, sunAtLeast(wanted)};
    s.looks.push_back(look(s, date, kSolar, 0h, 24h, 6.0));
    expectThree(s, points({kSouthWindow}), southOf(-60.0, 8.0), 3.0, 80.0);
  }
}

TEST(Presets, Tno) {
  for (const auto& [name, wanted, from, to] : {std::tuple("tno-light", 2.0, day(2, 19), day(10, 21)),
                                               std::tuple("tno-strict", 3.0, day(1, 21), day(11, 22))}) {
    Setting s{name, place(52.37, 4.9), zone("Europe/Amsterdam"), {}, sunAtLeast(wanted)};
    // The first and the last day have the lowest sun; were another one worse, the verdicts, which look at all, would differ from the truth.
    for (std::chrono::sys_days d = from; d < std::chrono::sys_days(to); d += std::chrono::days(10))
      s.looks.push_back(look(s, d, kSolar, 0h, 24h, 10.0, 120s));
    s.looks.push_back(look(s, to, kSolar, 0h, 24h, 10.0, 120s));
    expectThree(s, points({kSouthWindow}), southOf(-60.0, 8.0), 1.6, 80.0);
  }
}

TEST(Presets, Poland) {
  for (const auto& [name, wanted, from, to] :
       {std::tuple("poland", 3.0, 7h, 17h), std::tuple("poland-centre", 1.5, 7h, 17h),
        std::tuple("poland-children", 3.0, 8h, 16h)}) {
    Setting s{name, place(52.23, 21.01), zone("Europe/Warsaw"), {}, sunAtLeast(wanted)};
    // The equinoxes of 2026 are on 20 March and, by Polish time, 23 September.
    s.looks.push_back(look(s, day(3, 20), kSolar, from, to));
    s.looks.push_back(look(s, day(9, 23), kSolar, from, to));
    expectThree(s, points({kSouthWindow}), southOf(-60.0, 25.0), 3.0, 80.0);
  }
}

TEST(Presets, NewSouthWales) {
  for (const auto& [name, wanted] : {std::pair("nsw", 2.0), std::pair("nsw-regional", 3.0)}) {
    Setting s{name, place(-33.87, 151.2), zone("Australia/Sydney"), {}, sunAtLeast(wanted), false, 0.7};
    s.firstOnly = true;
    // Ten flats above each other: seven must have it, and eight must have some.
    s.looks.push_back(look(s, day(6, 21), *sun::parseZone("+10:00"), 9h, 15h));
    std::vector<study::Receiver> flats;
    for (int i = 0; i < 10; ++i) flats.push_back({{0.0, 0.0, 1.5 + 3.0 * i}, {0.0, 1.0, 0.0}});
    expectThree(s, points(flats), northOf(-6.0, 60.0), 3.0, 80.0);
  }
}

TEST(Presets, NewSouthWalesWithoutAnySun) {
  // Seven of ten flats have all the sun there is, but of the others two have none: more than 15 %.
  const sun::Place sydney = place(-33.87, 151.2);
  std::vector<study::Receiver> flats(7, kNorthWindow);
  flats.insert(flats.end(), 3, study::Receiver{{0.0, 0.0, 1.5}, {0.0, -1.0, 0.0}});
  const auto v = verify(sceneOf(northOf(100, 110)(1)), nullptr, *findRule("nsw"), points(flats),
                        {sydney, zone("Australia/Sydney"), day(1, 1), Sensitivity::never});
  ASSERT_TRUE(v);
  EXPECT_TRUE(v->findings[0].passes);
  EXPECT_FALSE(v->findings[1].passes);
  EXPECT_FALSE(v->passes);
  EXPECT_NEAR(v->findings[1].share, 0.7, 1e-12);
}

TEST(Presets, Montreal) {
  for (const auto& [name, wanted, share, from, to] :
       {std::tuple("montreal-parks", 8.0, 0.5, 8h, 18h), std::tuple("montreal-streets", 1.5, 1.0, 12h, 15h),
        std::tuple("montreal-vibrant-streets", 2.5, 1.0, 12h, 15h)}) {
    Setting s{name, place(45.5, -73.57), zone("America/Toronto"), {}, runAtLeast(wanted), false, share};
    s.looks.push_back(look(s, day(3, 20), s.zone, from, to));
    s.looks.push_back(look(s, day(9, 22), s.zone, from, to));
    const auto area = areaTargets({{"park", rectangle({-6, 2}, {6, 10})}}, sceneOf({}), 4.0, 0.0);
    ASSERT_TRUE(area);
    // Before the park a wall that grows from the west and takes the end of the afternoon; before the street a block that takes all of the noon.
    if (share < 1.0)
      expectThree(
          s, *area,
          [](double w) {
            return std::vector<Block>{{{-60, -10, 0}, {-60 + w, -2, 120}}};
          },
          0.5, 70.0);
    else
      expectThree(s, *area, southOf(-60.0, 2.0, 2.0), 0.5, 200.0);
  }
}

// Japan's rule: a box in the middle of a site of 20 m.
TEST(Presets, Japan) {
  for (const auto& [name, near, far, hokkaido] :
       {std::tuple("japan-3-2", 3.0, 2.0, false), std::tuple("japan-4-2.5", 4.0, 2.5, false),
        std::tuple("japan-5-3", 5.0, 3.0, false), std::tuple("japan-hokkaido-2-1.5", 2.0, 1.5, true),
        std::tuple("japan-hokkaido-3-2", 3.0, 2.0, true), std::tuple("japan-hokkaido-4-2.5", 4.0, 2.5, true)}) {
    Setting s{name, hokkaido ? place(43.06, 141.35) : place(35.68, 139.7), zone("Asia/Tokyo"), {}, {}};
    s.looks.push_back(look(s, day(12, 22), kSolar, hokkaido ? 9h : 8h, hokkaido ? 15h : 16h, 0.0, 60s));
    const Area site{"site", rectangle({-10, -10}, {10, 10})};
    const Obstacle house = [](double h) { return std::vector<Block>{{{-8, -6, 0}, {8, 6, h}}}; };
    SiteGrid grid{4.0, 1.0, 5.0, 60.0};
    const auto targets = siteTargets(site, *findRule(name), sceneOf(house(10)), grid);
    ASSERT_TRUE(targets);
    // By the distance from the square: within 10 m the larger number of hours, beyond it the smaller; on the line both.
    s.margin = [near, far](const Look& l, const auto& blocks, const study::Receiver& r) {
      const double dx = std::max(0.0, std::abs(r.position.x) - 10.0), dy = std::max(0.0, std::abs(r.position.y) - 10.0);
      const double distance = std::hypot(dx, dy);
      const double within = distance <= 10.001 ? shadowBelow(near)(l, blocks, r) : 1e9;
      return std::min(within, distance >= 9.999 ? shadowBelow(far)(l, blocks, r) : 1e9);
    };
    expectThree(s, *targets, house, 4.5, 120.0);
  }
}

// New shadow: what stands now hides the middle of the morning already; the proposal stands beside it.
struct NewCase {
  Setting setting;
  double limit = 0.0;  // hours
};

double mostNew(const NewCase& c, const std::vector<Block>& before, const std::vector<Block>& after,
               const study::Receiver& r) {
  double most = 0.0;
  for (const Look& l : c.setting.looks)
    most = std::max(
        most, hours(detail::total(l.when([&](const Vec3& s) { return lit(before, r, s) && !lit(after, r, s); }))));
  return most;
}

void expectThreeNew(const NewCase& c, const Obstacle& proposal) {
  const Setting& s = c.setting;
  EXPECT_TRUE(kHeld.contains(s.preset));
  const std::vector<Block> before{{{-30, -30, 0}, {-12, -20, 15}, "old"}};
  const auto after = [&](double h) {
    auto all = before;
    for (Block b : proposal(h)) b.name = "new", all.push_back(b);
    return all;
  };
  const auto one = areaTargets({{"park", rectangle({-1, 0}, {1, 2})}}, sceneOf({}), 2.0, 0.0);
  ASSERT_TRUE(one);
  const study::Receiver r = one->targets[0].receiver;
  ASSERT_EQ(one->targets.size(), 1u);
  // "None" begins where a minute of it is there; the border of a limit is where it is used up.
  const double wanted = c.limit > 0.0 ? c.limit : 1.0 / 60.0;
  double low = 0.5, high = 200.0;
  ASSERT_LT(mostNew(c, before, after(low), r), wanted) << s.preset;
  ASSERT_GT(mostNew(c, before, after(high), r), wanted) << s.preset;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    (mostNew(c, before, after(middle), r) < wanted ? low : high) = middle;
  }
  const scene::Scene stood = sceneOf(before);
  const auto verdictAt = [&](double h) {
    const auto v = verify(sceneOf(after(h)), &stood, *findRule(s.preset), *one, requestOf(s));
    EXPECT_TRUE(v) << s.preset;
    return v ? *v : Verdict{};
  };
  EXPECT_TRUE(verdictAt(0.9 * low).passes) << s.preset << ' ' << low;
  EXPECT_FALSE(verdictAt(1.1 * low).passes) << s.preset;
  const Verdict border = verdictAt(low);
  ASSERT_EQ(border.findings.size(), 1u);
  EXPECT_NEAR(border.findings[0].receivers[0].value, wanted, 2.0 * kSecond) << s.preset;
  EXPECT_EQ(border.passes, false || (c.limit > 0.0 && border.findings[0].receivers[0].value < wanted));
  EXPECT_TRUE(border.nearThreshold) << s.preset;
  // What stands now takes no part in it.
  const auto same = verify(stood, &stood, *findRule(s.preset), *one, requestOf(s));
  ASSERT_TRUE(same);
  EXPECT_TRUE(same->passes);
  EXPECT_FALSE(same->nearThreshold);
}

// From so long after sunrise to so long before sunset, the centre of the sun 0.833 degrees below the horizon, found by halving.
study::TimeSpan daylight(const sun::Place& p, year_month_day date, milliseconds after, milliseconds before) {
  const sun::Instant noon = at(kSolar, p, date, 12h);
  const auto edge = [&](sun::Instant night) {
    sun::Instant a = night, b = noon;
    for (int i = 0; i < 40; ++i) {
      const sun::Instant m = a + (b - a) / 2;
      (sun::sunPosition(p, m).elevation.degrees() > -0.833 ? b : a) = m;
    }
    return b;
  };
  return {edge(noon - 11h) + after, edge(noon + 11h) - before};
}

TEST(Presets, NewYork) {
  NewCase c{{"nyc-ceqr", place(40.71, -74.0), zone("America/New_York"), {}, {}}};
  for (const auto date : {day(3, 21), day(5, 6), day(6, 21), day(12, 21)})
    c.setting.looks.emplace_back(c.setting.place, daylight(c.setting.place, date, 90min, 90min), 0.0, 20s);
  expectThreeNew(c, southOf(-8.0, 8.0));
}

TEST(Presets, Vancouver) {
  NewCase c{{"vancouver", place(49.25, -123.1), zone("America/Vancouver"), {}, {}}};
  for (std::chrono::sys_days d = day(3, 20); d < std::chrono::sys_days(day(9, 22)); d += std::chrono::days(7))
    c.setting.looks.push_back(look(c.setting, d, c.setting.zone, 10h, 16h));
  c.setting.looks.push_back(look(c.setting, day(9, 22), c.setting.zone, 10h, 16h));
  expectThreeNew(c, southOf(-8.0, 8.0));
}

TEST(Presets, Boston) {
  NewCase c{{"boston-parks", place(42.355, -71.065), zone("America/New_York"), {}, {}}};
  // At noon the sun is lowest in December: all days about the solstice, and some of the others, as above.
  for (std::chrono::sys_days d = day(1, 1); d <= std::chrono::sys_days(day(12, 31));
       d += std::chrono::days(d < std::chrono::sys_days(day(12, 12)) ? 15 : 1)) {
    study::TimeSpan span = daylight(c.setting.place, d, 60min, 60min);
    span.from = std::max(span.from, at(c.setting.zone, c.setting.place, d, 7h));
    c.setting.looks.emplace_back(c.setting.place, span, 0.0, 15s);
  }
  expectThreeNew(c, southOf(-8.0, 8.0));
  NewCase midtown{{"boston-midtown", place(42.355, -71.065), zone("America/New_York"), {}, {}}, 2.0};
  for (std::chrono::sys_days d = day(3, 21); d < std::chrono::sys_days(day(10, 21)); d += std::chrono::days(10))
    midtown.setting.looks.push_back(look(midtown.setting, d, midtown.setting.zone, 8h, 14h + 30min, 0.0, 120s));
  midtown.setting.looks.push_back(look(midtown.setting, day(10, 21), midtown.setting.zone, 8h, 14h + 30min, 0.0, 120s));
  expectThreeNew(midtown, southOf(-8.0, 8.0));
}

TEST(Presets, SanFrancisco) {
  const sun::Place sf = place(37.77, -122.42);
  std::vector<Look> looks;
  double whole = 0.0;
  for (std::chrono::sys_days d = day(1, 1); d <= std::chrono::sys_days(day(12, 31)); d += std::chrono::days(1)) {
    looks.emplace_back(sf, daylight(sf, d, 60min, 60min), 0.0, 30s);
    whole += hours(detail::total(looks.back().when([](const Vec3&) { return true; })));
  }
  // The city's constant for a year of such days.
  EXPECT_NEAR(whole, 3721.4, 15.0);
  const auto park = areaTargets({{"park", rectangle({-4, -4}, {4, 4})}}, sceneOf({}), 4.0, 0.0);
  ASSERT_TRUE(park);
  ASSERT_EQ(park->targets.size(), 4u);
  const std::vector<Block> before{{{-30, -30, 0}, {-12, -20, 15}, "old"}};
  const auto after = [&](double h) {
    auto all = before;
    all.push_back({{-8, -20, 0}, {8, -12, h}, "new"});
    return all;
  };
  const auto newShare = [&](double h) {
    double sum = 0.0;
    const std::vector<Block> now = after(h);
    for (const Target& t : park->targets)
      for (const Look& l : looks)
        sum += hours(detail::total(
            l.when([&](const Vec3& s) { return lit(before, t.receiver, s) && !lit(now, t.receiver, s); })));
    return sum / (whole * 4.0);
  };
  const scene::Scene stood = sceneOf(before);
  for (const auto& [name, limit] :
       {std::pair("san-francisco-0", 0.0), std::pair("san-francisco-0.1", 0.001), std::pair("san-francisco-1", 0.01)}) {
    EXPECT_TRUE(kHeld.contains(name));
    const double wanted = std::max(limit, 1e-5);
    double low = 1.0, high = 40.0;
    for (int i = 0; i < 12; ++i) {
      const double middle = 0.5 * (low + high);
      (newShare(middle) < wanted ? low : high) = middle;
    }
    const auto verdictAt = [&](double h) {
      return *verify(sceneOf(after(h)), &stood, *findRule(name), *park,
                     requestOf({"", sf, zone("America/Los_Angeles"), {}, {}}));
    };
    const Verdict border = verdictAt(low);
    EXPECT_NEAR(*border.findings[0].newShare, newShare(low), 2e-6) << name;
    EXPECT_NEAR(border.findings[0].newAreaHours, newShare(low) * whole * 64.0, 2e-6 * whole * 64.0) << name;
    EXPECT_TRUE(verdictAt(0.8 * low).passes) << name << ' ' << low;
    EXPECT_FALSE(verdictAt(1.1 * low).passes) << name;
    EXPECT_EQ(border.nearThreshold, limit > 0.0) << name;
  }
}

TEST(Presets, AllHaveThreeScenes) {
  std::set<std::string> names;
  for (const Rule& rule : presets()) names.insert(rule.name);
  EXPECT_EQ(names, kHeld);
}

}  // namespace
}  // namespace umbrage::rules

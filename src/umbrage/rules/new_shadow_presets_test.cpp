// Every preset of new shadow on three scenes, as in presets_test.
#include "rules/presets.hpp"

namespace umbrage::rules {
namespace {

using namespace testing_boxes;
using namespace testing_presets;
using std::chrono::milliseconds;
using std::chrono::year_month_day;

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
  auto one = areaTargets({{"park", rectangle({-1, 0}, {1, 2})}}, sceneOf({}), 2.0, 0.0);
  ASSERT_TRUE(one);
  one->areas.clear();  // the hours of one point are held against the limit, not the outlines around it
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
    const auto v = verify(sceneOf(after(h)), &stood, ruleOf(s), *one, requestOf(s));
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
  const auto same = verify(stood, &stood, ruleOf(s), *one, requestOf(s));
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
  const auto days = season(day(3, 20), day(9, 22), 7);
  EXPECT_EQ(seasonOf(c.setting), days);
  for (const auto d : days) c.setting.looks.push_back(look(c.setting, d, c.setting.zone, 10h, 16h));
  expectThreeNew(c, southOf(-8.0, 8.0));
}

TEST(Presets, Boston) {
  NewCase c{{"boston-parks", place(42.355, -71.065), zone("America/New_York"), {}, {}}};
  c.setting.every = 10;
  EXPECT_EQ(seasonOf(c.setting), season(day(1, 1), day(12, 31), 1));
  for (const auto d : season(day(1, 1), day(12, 31), c.setting.every)) {
    study::TimeSpan span = daylight(c.setting.place, d, 60min, 60min);
    span.from = std::max(span.from, at(c.setting.zone, c.setting.place, d, 7h));
    c.setting.looks.emplace_back(c.setting.place, span, 0.0, 15s);
  }
  expectThreeNew(c, southOf(-8.0, 8.0));
}

TEST(Presets, BostonMidtown) {
  NewCase midtown{{"boston-midtown", place(42.355, -71.065), zone("America/New_York"), {}, {}}, 2.0};
  midtown.setting.every = 5;
  EXPECT_EQ(seasonOf(midtown.setting), season(day(3, 21), day(10, 21), 1));
  for (const auto d : season(day(3, 21), day(10, 21), 2 * midtown.setting.every))
    midtown.setting.looks.push_back(look(midtown.setting, d, midtown.setting.zone, 8h, 14h + 30min, 0.0, 120s));
  expectThreeNew(midtown, southOf(-8.0, 8.0));
  NewCase garden{{"boston-garden-midtown", place(42.355, -71.065), zone("America/New_York"), {}, {}}};
  // At noon the sun is lowest on the last day, so each of the last ones is looked at.
  for (std::chrono::sys_days d = day(3, 21); d <= std::chrono::sys_days(day(10, 21));
       d += std::chrono::days(d < std::chrono::sys_days(day(10, 12)) ? 15 : 1)) {
    study::TimeSpan span = daylight(garden.setting.place, d, 60min, 60min);
    span.from = at(garden.setting.zone, garden.setting.place, d, 10h);
    garden.setting.looks.emplace_back(garden.setting.place, span, 0.0, 15s);
  }
  expectThreeNew(garden, southOf(-8.0, 8.0));
}

// The shares of new shadow in a park of four points, counted: the sun of each look, and whether what stood before lets it through.
class CountedShare {
 public:
  CountedShare(const std::vector<Look>& looks, const TargetSet& park, std::vector<Block> before)
      : looks_(looks), park_(park), before_(std::move(before)) {
    for (const Look& l : looks_) whole_ += hours(detail::total(l.when([](const Vec3&) { return true; })));
  }
  [[nodiscard]] double whole() const { return whole_; }
  [[nodiscard]] std::vector<Block> after(double height) const {
    auto all = before_;
    all.push_back({{-8, -20, 0}, {8, -12, height}, "new"});
    return all;
  }
  [[nodiscard]] double at(double height) const {
    const std::vector<Block> now = after(height);
    double sum = 0.0;
    for (const Target& t : park_.targets)
      for (const Look& l : looks_)
        sum += hours(detail::total(
            l.when([&](const Vec3& s) { return lit(before_, t.receiver, s) && !lit(now, t.receiver, s); })));
    return sum / (whole_ * double(park_.targets.size()));
  }
  // The height at which the share is so much.
  [[nodiscard]] double heightOf(double share) const {
    double low = 1.0, high = 40.0;
    for (int i = 0; i < 12; ++i) {
      const double middle = 0.5 * (low + high);
      (at(middle) < share ? low : high) = middle;
    }
    return low;
  }

 private:
  const std::vector<Look>& looks_;
  const TargetSet& park_;
  std::vector<Block> before_;
  double whole_ = 0.0;
};

TEST(Presets, SanFrancisco) {
  const sun::Place sf = place(37.77, -122.42);
  Setting s{"san-francisco-0", sf, zone("America/Los_Angeles"), {}, {}};
  s.every = 13;
  std::vector<Look> looks;
  for (const auto d : season(day(1, 1), day(12, 31), s.every))
    looks.emplace_back(sf, daylight(sf, d, 60min, 60min), 0.0, 30s);
  auto park = areaTargets({{"park", rectangle({-4, -4}, {4, 4})}}, sceneOf({}), 4.0, 0.0);
  ASSERT_TRUE(park);
  park->areas.clear();  // four points are the truth here, not the outlines around them
  ASSERT_EQ(park->targets.size(), 4u);
  const std::vector<Block> before{{{-30, -30, 0}, {-12, -20, 15}, "old"}};
  const CountedShare truth(looks, *park, before);
  // The city's constant for a year of such days; the last one is the first one's again.
  const double last = hours(detail::total(looks.back().when([](const Vec3&) { return true; })));
  EXPECT_NEAR((truth.whole() - last) / double(looks.size() - 1) * 365.0, 3721.4, 15.0);
  const scene::Scene stood = sceneOf(before);
  for (const auto& [name, limit] :
       {std::pair("san-francisco-0", 0.0), std::pair("san-francisco-0.1", 0.001), std::pair("san-francisco-1", 0.01)}) {
    EXPECT_TRUE(kHeld.contains(name));
    s.preset = name;
    EXPECT_EQ(seasonOf(s), season(day(1, 1), day(12, 31), 1));
    const double low = truth.heightOf(std::max(limit, 1e-5)), share = truth.at(low);
    const auto verdictAt = [&](double h) {
      return *verify(sceneOf(truth.after(h)), &stood, ruleOf(s), *park, requestOf(s));
    };
    const Verdict border = verdictAt(low);
    EXPECT_NEAR(*border.findings[0].newShare, share, 2e-6) << name;
    EXPECT_NEAR(border.findings[0].newAreaHours, share * truth.whole() * 64.0, 2e-6 * truth.whole() * 64.0) << name;
    EXPECT_TRUE(verdictAt(0.8 * low).passes) << name << ' ' << low;
    EXPECT_FALSE(verdictAt(1.1 * low).passes) << name;
    EXPECT_EQ(border.nearThreshold, limit > 0.0) << name;
  }
}

}  // namespace
}  // namespace umbrage::rules

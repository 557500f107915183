#pragma once

// What the tests of presets share: a setting of looks written out by hand, the truth by counting, and three scenes around the border.
#include <gtest/gtest.h>

#include <set>

#include "umbrage/rules/rule_file.hpp"
#include "umbrage/rules/test_boxes.hpp"
#include "umbrage/rules/verify.hpp"

namespace umbrage::rules::testing_presets {

using namespace testing_boxes;
using std::chrono::milliseconds;
using std::chrono::year_month_day;
using std::chrono::operator""y;

inline year_month_day day(unsigned month, unsigned d, int year = 2026) {
  return std::chrono::year(year) / std::chrono::month(month) / std::chrono::day(d);
}
inline const sun::Zone kSolar{sun::Zone::Kind::solar, "solar", {}};
inline sun::Zone zone(const char* name) { return *sun::parseZone(name); }

inline double hours(milliseconds t) { return double(t.count()) / 3.6e6; }

// What one day says of one receiver, on the passing side above 0. `blocks` stand now, `former` stood before.
using Margin = std::function<double(const Look&, const std::vector<Block>& blocks, const study::Receiver&)>;

inline Margin sunAtLeast(double wanted) {
  return [=](const Look& look, const auto& blocks, const auto& r) {
    return hours(detail::total(look.when([&](const Vec3& s) { return lit(blocks, r, s); }))) - wanted;
  };
}
inline Margin runAtLeast(double wanted) {
  return [=](const Look& look, const auto& blocks, const auto& r) {
    return hours(detail::longest(look.when([&](const Vec3& s) { return lit(blocks, r, s); }))) - wanted;
  };
}
inline Margin shadowBelow(double limit) {
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
  int every = 1;  // of rules that look at all days of a season: only every so many, by the rule and by the truth
};

// Every so many days of a season, and its last.
inline std::vector<year_month_day> season(year_month_day first, year_month_day last, int every) {
  std::vector<year_month_day> dates;
  for (std::chrono::sys_days d = first; d < std::chrono::sys_days(last); d += std::chrono::days(every))
    dates.emplace_back(d);
  dates.push_back(last);
  return dates;
}

inline double ofReceiver(const Setting& s, const std::vector<Block>& blocks, const study::Receiver& r) {
  double worst = 1e9, best = -1e9;
  for (const Look& look : s.looks) {
    const double m = s.margin(look, blocks, r);
    worst = std::min(worst, m), best = std::max(best, m);
  }
  return s.best ? best : worst;
}

// The margin of the receiver that decides, by shares.
inline double truth(const Setting& s, const TargetSet& targets, const std::vector<Block>& blocks) {
  std::vector<double> margins;
  for (const Target& t : targets.targets) margins.push_back(ofReceiver(s, blocks, t.receiver));
  std::sort(margins.rbegin(), margins.rend());
  const auto wanted = static_cast<std::size_t>(std::ceil(s.share * double(margins.size()) - 1e-9));
  return margins[wanted - 1];
}

// A day of the sun costs 12 ms, which is most of what these tests take: rules of seasons are held on some of their days, and that they look at
// all of them is told by seasonOf.
inline Rule ruleOf(const Setting& s) {
  auto rule = findRule(s.preset);
  EXPECT_TRUE(rule) << s.preset;
  for (Requirement& r : rule->requirements)
    for (Measure& m : r.anyOf)
      if (s.every > 1) m.days.every = s.every;
  return s.altitude >= 0.0 ? withLeastAltitude(*rule, Angle::degrees(s.altitude)) : *rule;
}

using Obstacle = std::function<std::vector<Block>(double height)>;

// The height at which the margin is 0.
inline double borderOf(const Setting& s, const TargetSet& targets, const Obstacle& obstacle, double low, double high) {
  EXPECT_GT(truth(s, targets, obstacle(low)), 0.0) << s.preset;
  EXPECT_LT(truth(s, targets, obstacle(high)), 0.0) << s.preset;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (truth(s, targets, obstacle(middle)) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// Those that have three scenes below. Each is named by its test, too.
inline const std::set<std::string> kHeld = {"japan-3-2",
                                            "japan-4-2.5",
                                            "japan-5-3",
                                            "japan-hokkaido-2-1.5",
                                            "japan-hokkaido-3-2",
                                            "japan-hokkaido-4-2.5",
                                            "china-dahan-1",
                                            "china-dahan-2",
                                            "china-dahan-3",
                                            "china-winter-1",
                                            "china-winter-2",
                                            "korea",
                                            "en17037-minimum",
                                            "en17037-medium",
                                            "en17037-high",
                                            "bre209",
                                            "din5034-1",
                                            "din5034-1-winter",
                                            "tno-light",
                                            "tno-strict",
                                            "the-hague",
                                            "poland",
                                            "poland-centre",
                                            "poland-children",
                                            "poland-centre-children",
                                            "nsw",
                                            "nsw-regional",
                                            "montreal-parks",
                                            "montreal-streets",
                                            "montreal-vibrant-streets",
                                            "vancouver",
                                            "boston-parks",
                                            "boston-midtown",
                                            "boston-garden-midtown",
                                            "san-francisco-0",
                                            "san-francisco-0.1",
                                            "san-francisco-1",
                                            "nyc-ceqr"};

// One for all verdicts of a test: most of their time is the sun's.
inline std::shared_ptr<SunDays> sunDays() {
  static const auto days = makeSunDays();
  return days;
}
inline VerifyRequest requestOf(const Setting& s) {
  VerifyRequest request{s.place, s.zone, day(6, 1), Sensitivity::never};
  request.days = sunDays();
  return request;
}

inline Verdict verdictOf(const Setting& s, const TargetSet& targets, const std::vector<Block>& blocks,
                         Sensitivity sensitivity) {
  VerifyRequest request = requestOf(s);
  request.sensitivity = sensitivity;
  auto verdict = verify(sceneOf(blocks), nullptr, ruleOf(s), targets, request);
  EXPECT_TRUE(verdict) << s.preset << (verdict ? "" : verdict.error().text());
  return verdict ? *verdict : Verdict{};
}

// All days that a preset looks at, as it comes.
inline std::vector<year_month_day> seasonOf(const Setting& s) {
  const auto rule = findRule(s.preset);
  EXPECT_TRUE(rule) << s.preset;
  return datesOf(rule->requirements.at(0).anyOf.at(0), requestOf(s));
}

inline double leastMargin(const Setting& s, const Verdict& v) {
  if (s.firstOnly) return v.findings.front().margin;
  double least = 1e9;
  for (const Finding& f : v.findings) least = std::min(least, f.margin);
  return least;
}

inline constexpr double kSecond = 1.0 / 3600.0;

// Passes well below the border, fails well above it, and stands within a second of the truth at it.
inline void expectThree(const Setting& s, const TargetSet& targets, const Obstacle& obstacle, double low, double high) {
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

inline TargetSet points(const std::vector<study::Receiver>& receivers) {
  study::ReceiverSet set;
  set.receivers = receivers;
  set.described = "points";
  return pointTargets(set);
}

// A window that looks at the noon sun, and a broad block before it, off to one side, so that hours are lost from one end.
inline Obstacle southOf(double from, double to, double distance = 12.0) {
  return [=](double height) { return std::vector<Block>{{{from, -distance - 8.0, 0.0}, {to, -distance, height}}}; };
}
inline Obstacle northOf(double from, double to, double distance = 12.0) {
  return [=](double height) { return std::vector<Block>{{{from, distance, 0.0}, {to, distance + 8.0, height}}}; };
}
inline const study::Receiver kSouthWindow{{0.0, 0.0, 1.5}, {0.0, -1.0, 0.0}};
inline const study::Receiver kNorthWindow{{0.0, 0.0, 1.5}, {0.0, 1.0, 0.0}};

inline Look look(const Setting& s, year_month_day date, const sun::Zone& clock, milliseconds from, milliseconds to,
                 double altitude = 0.0, milliseconds step = 20s) {
  return Look(s.place, {at(clock, s.place, date, from), at(clock, s.place, date, to)}, altitude, step);
}

}  // namespace umbrage::rules::testing_presets

#include "umbrage/study/period.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

namespace umbrage::study {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

Period period(const char* from, const char* to, std::chrono::milliseconds step, const char* date = "2026-09-18",
              const char* zone = "Europe/Vienna") {
  return {*sun::makePlace(48.2, 16.37), *sun::parseZone(zone), *sun::parseDate(date),
          *sun::parseTime(from),        *sun::parseTime(to),   step};
}

std::vector<std::string> labels(const PeriodSteps& steps) {
  std::vector<std::string> all;
  for (const auto& step : steps.steps) all.push_back(step.label);
  return all;
}

std::chrono::milliseconds total(const PeriodSteps& steps) {
  return std::accumulate(steps.steps.begin(), steps.steps.end(), 0ms,
                         [](auto sum, const auto& s) { return sum + s.share; });
}

TEST(Steps, HaveTheEndWhereItFallsOnAStep) {
  const auto steps = stepsOf(period("12:00", "15:00", 30min));
  ASSERT_TRUE(steps);
  EXPECT_THAT(labels(*steps), testing::ElementsAre("12:00", "12:30", "13:00", "13:30", "14:00", "14:30", "15:00"));
  EXPECT_EQ(steps->steps.front().share, 15min);
  EXPECT_EQ(steps->steps[1].share, 30min);
  EXPECT_EQ(steps->steps.back().share, 15min);
  EXPECT_EQ(total(*steps), 3h);
  EXPECT_EQ(steps->offset, "UTC+02:00 (CEST)");
}

TEST(Steps, EndBeforeTheEndWhereItDoesNot) {
  const auto steps = stepsOf(period("12:00", "15:00", 40min));
  EXPECT_THAT(labels(*steps), testing::ElementsAre("12:00", "12:40", "13:20", "14:00", "14:40"));
  EXPECT_EQ(steps->steps.back().share, 40min);
  EXPECT_EQ(total(*steps), 3h);
}

TEST(Steps, OneAloneStandsForAll) {
  const auto steps = stepsOf(period("12:00", "12:10", 1h));
  ASSERT_EQ(steps->steps.size(), 1u);
  EXPECT_EQ(steps->steps[0].share, 10min);
}

TEST(Steps, CoverADayWithItsNight) {
  const auto steps = stepsOf(period("00:00", "24:00", 1h));
  EXPECT_EQ(steps->steps.size(), 25u);
  EXPECT_EQ(steps->steps.back().label, "00:00");
  EXPECT_FALSE(steps->steps.front().sunIsUp());
  EXPECT_TRUE(steps->steps[12].sunIsUp());
}

TEST(Steps, RefuseWhatMakesNoSense) {
  for (const auto& p :
       {period("15:00", "12:00", 30min), period("12:00", "12:00", 30min), period("12:00", "13:00", 0min),
        period("12:00", "13:00", -5min), period("00:00", "24:00", 1s), period("02:30", "12:00", 1h, "2026-03-29")}) {
    const auto steps = stepsOf(p);
    ASSERT_FALSE(steps);
    EXPECT_EQ(steps.error().code, ErrorCode::usage);
  }
}

// Clocks jump from 02:00 to 03:00: a night of 23 hours, seen in elapsed hours.
TEST(Steps, FollowElapsedTimeAsClocksArePutForward) {
  const auto steps = stepsOf(period("00:00", "24:00", 1h, "2026-03-29"));
  EXPECT_EQ(steps->steps.size(), 24u);
  EXPECT_EQ(total(*steps), 23h);
  EXPECT_THAT(labels(*steps), testing::Contains("03:00 CEST"));
  EXPECT_THAT(labels(*steps), testing::Not(testing::Contains(HasSubstr("02:"))));
  EXPECT_EQ(steps->offset, "UTC+01:00 (CET), then UTC+02:00 (CEST)");
}

TEST(Steps, TellTheHoursApartAsClocksArePutBack) {
  const auto steps = stepsOf(period("01:00", "04:00", 30min, "2026-10-25"));
  EXPECT_EQ(total(*steps), 4h);
  EXPECT_THAT(labels(*steps), testing::IsSupersetOf({"02:30 CEST", "02:30 CET"}));
  EXPECT_EQ(stepsOf(period("02:30", "04:00", 30min, "2026-10-25"))->warnings.size(), 1u);
}

TEST(Steps, OfSolarTimeAreEvenOnTheSundial) {
  const auto steps = stepsOf(period("09:00", "15:00", 1h, "2026-12-22", "solar"));
  ASSERT_EQ(steps->steps.size(), 7u);
  for (int i = 0; i < 7; ++i)
    EXPECT_NEAR(sun::hourAngle(*sun::makePlace(48.2, 16.37), steps->steps[i].instant).degrees(), 15.0 * (i - 3), 1e-5);
  EXPECT_EQ(steps->steps[0].label, "09:00");
  EXPECT_NEAR(steps->steps[3].sun.azimuth.degrees(), 180.0, 1e-3);
}

}  // namespace
}  // namespace umbrage::study

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "umbrage/sun/zone.hpp"

namespace umbrage::sun {
namespace {

using namespace std::chrono_literals;
using std::chrono::sys_days;
using testing::HasSubstr;

const Place kVienna{Angle::degrees(48.2), Angle::degrees(16.37)};

Instant instantAt(const char* zone, const char* date, const char* time, const Place& place = kVienna) {
  return instantOf(*parseZone(zone), place, {*parseDate(date), *parseTime(time)})->instant;
}
Instant utc(const char* date, const char* time) { return sys_days(*parseDate(date)) + *parseTime(time); }

TEST(Zones, AreNamedFixedOrSolar) {
  EXPECT_EQ(parseZone("Europe/Vienna")->kind, Zone::Kind::named);
  EXPECT_EQ(parseZone("-03:30")->offset, -(3h + 30min));
  EXPECT_EQ(parseZone("+05:45")->offset, 5h + 45min);
  EXPECT_EQ(parseZone("solar")->kind, Zone::Kind::solar);
  EXPECT_EQ(parseZone("Z")->offset, 0min);
}

TEST(Zones, RefuseWhatIsNoneAndSuggest) {
  for (const char* text :
       {"", "+1:00", "+01:60", "+0100", "-19:00", "Solar", "../../etc/passwd", "+ab:cd", "Mars/Olympus"}) {
    const auto zone = parseZone(text);
    ASSERT_FALSE(zone) << text;
    EXPECT_EQ(zone.error().code, ErrorCode::usage);
  }
  EXPECT_THAT(parseZone("vienna").error().message, HasSubstr("did you mean Europe/Vienna"));
}

TEST(Dates, AreStrict) {
  EXPECT_TRUE(parseDate("2024-02-29"));
  EXPECT_TRUE(parseDate("1900-01-01"));
  EXPECT_TRUE(parseDate("2100-12-31"));
  for (const char* text : {"2026-02-29", "2100-02-29", "2026-9-18", "18.09.2026", "2026-09-18 ", "2026-00-10",
                           "2026-13-01", "", "-026-09-18", "2026-09-31", "1899-12-31", "2101-01-01", "+026-09-18"})
    EXPECT_FALSE(parseDate(text)) << text;
  EXPECT_THAT(parseDate("1899-12-31").error().message, HasSubstr("1900 to 2100"));
}

TEST(Times, AreStrict) {
  EXPECT_EQ(*parseTime("09:30"), 9h + 30min);
  EXPECT_EQ(*parseTime("09:30:15"), 9h + 30min + 15s);
  EXPECT_EQ(*parseTime("24:00"), 24h);
  for (const char* text :
       {"9:30", "24:01", "24:00:01", "12:60", "12:30:60", "12.30", "noon", "", "12:30:", "-1:30", " 9:30"})
    EXPECT_FALSE(parseTime(text)) << text;
}

TEST(Places, HaveLimits) {
  EXPECT_TRUE(makePlace(-90, 180));
  EXPECT_NEAR(makePlace(0, 200)->longitude.degrees(), -160, 1e-12);
  EXPECT_FALSE(makePlace(90.1, 0));
  EXPECT_FALSE(makePlace(0, -181));
  EXPECT_FALSE(makePlace(std::nan(""), 0));
}

TEST(Versions, NameTheTimeZonesOnlyWhereTheyCount) {
  EXPECT_EQ(versions(*parseZone("solar")).find("tzdata"), std::string::npos);
  EXPECT_EQ(versions(*parseZone("+01:00")).find("ERFA "), 0U);
  EXPECT_NE(versions(*parseZone("Europe/Vienna")).find(", tzdata "), std::string::npos);
}

TEST(LocalTime, FollowsTheZoneInBothHemispheres) {
  EXPECT_EQ(instantAt("Europe/Vienna", "2026-09-18", "12:00"), utc("2026-09-18", "10:00"));
  EXPECT_EQ(instantAt("Europe/Vienna", "2026-01-18", "12:00"), utc("2026-01-18", "11:00"));
  EXPECT_EQ(instantAt("America/Santiago", "2026-01-18", "12:00"), utc("2026-01-18", "15:00"));
  EXPECT_EQ(instantAt("Asia/Kathmandu", "2026-01-18", "12:00"), utc("2026-01-18", "06:15"));
  EXPECT_EQ(instantAt("Pacific/Kiritimati", "2026-01-18", "12:00"), utc("2026-01-17", "22:00"));
  EXPECT_EQ(instantAt("+01:00", "2024-02-29", "00:30"), utc("2024-02-28", "23:30"));
  EXPECT_EQ(instantAt("UTC", "2026-01-18", "24:00"), utc("2026-01-19", "00:00"));
}

TEST(LocalTime, ExplainsTheHourThatIsLeftOut) {
  const auto gap = instantOf(*parseZone("Europe/Vienna"), kVienna, {*parseDate("2026-03-29"), 2h + 30min});
  ASSERT_FALSE(gap);
  EXPECT_EQ(gap.error().code, ErrorCode::usage);
  EXPECT_THAT(gap.error().message, HasSubstr("put forward from 02:00 to 03:00"));
  EXPECT_FALSE(instantOf(*parseZone("Pacific/Apia"), kVienna, {*parseDate("2011-12-30"), 12h}));
}

TEST(LocalTime, TakesTheFirstOfTwoAndSaysSo) {
  const auto twice = instantOf(*parseZone("Europe/Vienna"), kVienna, {*parseDate("2026-10-25"), 2h + 30min});
  ASSERT_TRUE(twice);
  EXPECT_EQ(twice->instant, utc("2026-10-25", "00:30"));
  ASSERT_TRUE(twice->warning);
  EXPECT_THAT(*twice->warning, HasSubstr("occurs twice"));
  EXPECT_FALSE(instantOf(*parseZone("Europe/Vienna"), kVienna, {*parseDate("2026-10-25"), 3h})->warning);
}

TEST(LocalTime, BordersAreTakenFromTheMomentClocksJumpTo) {
  const Zone vienna = *parseZone("Europe/Vienna");
  const auto nearest = [&](const char* date, std::chrono::milliseconds time, Twice twice) {
    return nearestInstantOf(vienna, kVienna, {*parseDate(date), time}, twice);
  };
  for (const char* year : {"2026-03-29", "2049-03-28"}) {  // the second beyond the table
    const Moment gap = nearest(year, 2h + 30min, Twice::first);
    EXPECT_EQ(gap.instant, utc(year, "01:00"));
    ASSERT_TRUE(gap.warning);
    EXPECT_THAT(*gap.warning, HasSubstr("put forward from 02:00 to 03:00"));
  }
  EXPECT_EQ(nearest("2026-10-25", 2h + 30min, Twice::first).instant, utc("2026-10-25", "00:30"));
  const Moment second = nearest("2026-10-25", 2h + 30min, Twice::second);
  EXPECT_EQ(second.instant, utc("2026-10-25", "01:30"));
  EXPECT_THAT(*second.warning, HasSubstr("taken as the second, CET"));
  EXPECT_EQ(nearest("2026-10-25", 12h, Twice::second).instant, utc("2026-10-25", "11:00"));
  EXPECT_FALSE(nearest("2026-10-25", 12h, Twice::second).warning);
  EXPECT_EQ(nearestInstantOf(*parseZone("+01:00"), kVienna, {*parseDate("2026-03-29"), 2h}, Twice::first).instant,
            utc("2026-03-29", "01:00"));
}

TEST(LocalTime, KeepsTheRulesAfterTheTableEnds) {
  EXPECT_EQ(instantAt("Europe/Vienna", "2050-07-01", "12:00"), utc("2050-07-01", "10:00"));
  EXPECT_EQ(instantAt("Europe/Vienna", "2050-01-01", "12:00"), utc("2050-01-01", "11:00"));
  EXPECT_EQ(instantAt("America/New_York", "2048-03-08", "12:00"),
            utc("2048-03-08", "16:00"));  // the second Sunday of March
  EXPECT_EQ(instantAt("America/New_York", "2048-03-07", "12:00"), utc("2048-03-07", "17:00"));
  EXPECT_EQ(instantAt("Australia/Sydney", "2100-01-15", "12:00"), utc("2100-01-15", "01:00"));
  EXPECT_EQ(instantAt("Europe/Vienna", "2048-02-29", "12:00"), utc("2048-02-29", "11:00"));
  const auto reading = clockAt(*parseZone("Europe/Vienna"), kVienna, utc("2050-07-01", "10:00"));
  EXPECT_EQ(reading.clock.time, 12h);
  EXPECT_EQ(reading.abbreviation, "CEST");
}

TEST(SolarTime, IsTwelveWhenTheSunIsHighest) {
  for (const double longitude : {-180.0, -75.0, 0.0, 16.37, 179.9}) {
    const Place place{Angle::degrees(48), Angle::degrees(longitude)};
    for (const char* date : {"2026-02-11", "2026-11-03", "2024-02-29"}) {
      const Instant noon = instantAt("solar", date, "12:00", place);
      EXPECT_NEAR(hourAngle(place, noon).degrees(), 0, 1e-5);
      EXPECT_NEAR(hourAngle(place, instantAt("solar", date, "15:00", place)).degrees(), 45, 1e-5);
      EXPECT_EQ(dateText(clockAt(*parseZone("solar"), place, noon).clock.date), date);
    }
  }
}

TEST(SolarTime, DiffersFromMeanTimeByTheEquationOfTime) {
  const Place greenwich{Angle::degrees(51.5), {}};
  const auto late = instantAt("solar", "2026-02-11", "12:00", greenwich) - utc("2026-02-11", "12:00");
  const auto early = utc("2026-11-03", "12:00") - instantAt("solar", "2026-11-03", "12:00", greenwich);
  EXPECT_LT(std::chrono::abs(late - (14min + 13s)), 10s);
  EXPECT_LT(std::chrono::abs(early - (16min + 26s)), 10s);
}

RC_GTEST_PROP(Clocks, ReadBackWhatWasAskedFor, ()) {
  static const std::vector<const char*> kZones{"Europe/Vienna", "solar", "-03:30", "Australia/Lord_Howe",
                                               "America/New_York"};
  const Zone zone = *parseZone(*rc::gen::elementOf(kZones));
  const Place place{{}, Angle::degrees(*rc::gen::inRange(-180, 181))};
  const auto date = std::chrono::year_month_day(sys_days(std::chrono::days(*rc::gen::inRange(-25567, 47846))));
  const ClockTime asked{date, std::chrono::minutes(*rc::gen::inRange(0, 1440))};
  const auto moment = instantOf(zone, place, asked);
  if (!moment) return;  // the hour that was left out
  const ClockTime read = clockAt(zone, place, moment->instant).clock;
  RC_ASSERT(std::chrono::abs((sys_days(read.date) + read.time) - (sys_days(asked.date) + asked.time)) <= 2ms);
}

TEST(Texts, AreShort) {
  EXPECT_EQ(timeText(9h + 5min), "09:05");
  EXPECT_EQ(timeText(9h + 5min + 7s), "09:05:07");
  EXPECT_EQ(timeText(24h), "24:00");
  EXPECT_EQ(offsetText(-(3h + 30min)), "-03:30");
  EXPECT_EQ(offsetText(ClockReading{{}, 2h, "CEST"}), "UTC+02:00 (CEST)");
  EXPECT_EQ(offsetText(ClockReading{{}, 5h + 30min, "+0530"}), "UTC+05:30");
  EXPECT_EQ(offsetText(ClockReading{{}, 1h, ""}), "UTC+01:00");
  EXPECT_EQ(dateText(*parseDate("2026-09-18")), "2026-09-18");
}

}  // namespace
}  // namespace umbrage::sun

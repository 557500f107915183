#include "umbrage/rules/detail/days.hpp"

#include <gtest/gtest.h>

#include "umbrage/rules/test_boxes.hpp"
#include "umbrage/sun/sun_path.hpp"

namespace umbrage::rules::detail {
namespace {

using namespace testing_boxes;
using std::chrono::operator""y;

const auto kDay = [](int y, unsigned m, unsigned d) {
  return std::chrono::year(y) / std::chrono::month(m) / std::chrono::day(d);
};
double hours(std::chrono::milliseconds t) { return hoursOf(t); }

TEST(Days, solarLongitudes) {
  // Almanacs: equinoxes and solstices of 2026 to the minute, and the solar term Dahan (2026-01-20 01:45 UTC).
  const std::tuple<double, sun::Instant> known[] = {{0.0, std::chrono::sys_days(kDay(2026, 3, 20)) + 14h + 46min},
                                                    {90.0, std::chrono::sys_days(kDay(2026, 6, 21)) + 8h + 25min},
                                                    {180.0, std::chrono::sys_days(kDay(2026, 9, 23)) + 5min},
                                                    {270.0, std::chrono::sys_days(kDay(2026, 12, 21)) + 20h + 50min},
                                                    {300.0, std::chrono::sys_days(kDay(2026, 1, 20)) + 1h + 45min},
                                                    {270.0, std::chrono::sys_days(kDay(2000, 12, 21)) + 13h + 37min},
                                                    {180.0, std::chrono::sys_days(kDay(2000, 9, 22)) + 17h + 28min},
                                                    {0.0, std::chrono::sys_days(kDay(2050, 3, 20)) + 10h + 19min}};
  for (const auto& [degrees, instant] : known) {
    const auto year = std::chrono::year_month_day(std::chrono::floor<std::chrono::days>(instant)).year();
    const auto off = instantOfLongitude(Angle::degrees(degrees), year) - instant;
    EXPECT_LT(std::abs(hours(off)), 1.0 / 3.0) << degrees << ' ' << int(year);
  }
  // The declination says the same without any series: 0 at the equinoxes, least at the solstice.
  EXPECT_NEAR(study::declinationAt(instantOfLongitude(Angle{}, 2033y)).degrees(), 0.0, 0.006);
  // The obliquity of 2033, 23.4350 degrees, less a nutation of 0.0025.
  EXPECT_NEAR(study::declinationAt(instantOfLongitude(Angle::degrees(270), 2033y)).degrees(), -23.4325, 0.0008);
}

TEST(Days, datesBelongToTheClock) {
  Days solstice{Days::Kind::longitudes, {}, {Angle::degrees(270)}};
  const Calendar tokyo{place(35.7, 139.7), *sun::parseZone("Asia/Tokyo"), kDay(2026, 1, 1)};
  EXPECT_EQ(datesOf(solstice, tokyo).front(), kDay(2026, 12, 22));
  const Calendar london{place(51.5, 0), *sun::parseZone("Europe/London"), kDay(2026, 1, 1)};
  EXPECT_EQ(datesOf(solstice, london).front(), kDay(2026, 12, 21));
}

TEST(Days, ranges) {
  const Calendar c{place(52, 5), *sun::parseZone("Europe/Amsterdam"), kDay(2026, 7, 7)};
  Days days{Days::Kind::range, {std::chrono::February / 19, std::chrono::October / 21}, {}};
  EXPECT_EQ(datesOf(days, c).size(), 245u);
  days.every = 7;
  EXPECT_EQ(datesOf(days, c).back(), kDay(2026, 10, 21));
  days = {Days::Kind::range, {std::chrono::November / 1, std::chrono::February / 29}, {}};
  EXPECT_EQ(datesOf(days, c).front(), kDay(2026, 11, 1));
  EXPECT_EQ(datesOf(days, c).back(), kDay(2027, 2, 28));
  EXPECT_EQ(datesOf({Days::Kind::given}, c).front(), kDay(2026, 7, 7));
}

TEST(Days, aTwentyNinthOfFebruaryThatIsNot) {
  const sun::Zone utc = *sun::parseZone("Z");
  const Calendar common{place(52, 5), utc, kDay(2026, 1, 1)}, leap{place(52, 5), utc, kDay(2024, 1, 1)};
  Days days{Days::Kind::dates, {std::chrono::February / 28, std::chrono::February / 29}, {}};
  EXPECT_EQ(datesOf(days, common), std::vector{kDay(2026, 2, 28)});  // counted once
  ASSERT_EQ(dateNotes(days, common).size(), 1u);
  EXPECT_EQ(dateNotes(days, common)[0], "2026 has no 29 February: the 28th is taken");
  EXPECT_EQ(datesOf(days, leap).size(), 2u);
  EXPECT_TRUE(dateNotes(days, leap).empty());
  // A range's last day may be in the next year.
  days = {Days::Kind::range, {std::chrono::November / 1, std::chrono::February / 29}, {}};
  EXPECT_EQ(dateNotes(days, leap).at(0), "2025 has no 29 February: the 28th is taken");
  EXPECT_TRUE(dateNotes(days, {place(52, 5), utc, kDay(2023, 1, 1)}).empty());
  EXPECT_TRUE(dateNotes({Days::Kind::given}, common).empty());
}

TEST(Windows, clocks) {
  const Calendar c{place(48.2, 16.37), *sun::parseZone("Europe/Vienna"), kDay(2026, 7, 1)};
  Window w{Clock::zone, 9h, 15h, {}, {}};
  const auto legal = *windowOn(w, kDay(2026, 7, 1), c, false);
  EXPECT_EQ(legal.from, std::chrono::sys_days(kDay(2026, 7, 1)) + 7h);
  w.clock = Clock::standard;
  EXPECT_EQ((*windowOn(w, kDay(2026, 7, 1), c, false)).from, std::chrono::sys_days(kDay(2026, 7, 1)) + 8h);
  w.clock = Clock::solar;
  const auto solar = *windowOn(w, kDay(2026, 7, 1), c, false);
  EXPECT_NEAR(sun::hourAngle(c.place, solar.from).degrees(), -45.0, 1e-4);
  // The other clock of the sun's is the legal one, and the other way round.
  EXPECT_EQ((*windowOn(w, kDay(2026, 7, 1), c, true)).from, legal.from);
  w.clock = Clock::zone;
  EXPECT_EQ((*windowOn(w, kDay(2026, 7, 1), c, true)).from, solar.from);
  // South of the equator daylight saving is in January.
  const Calendar sydney{place(-33.9, 151.2), *sun::parseZone("Australia/Sydney"), kDay(2026, 1, 10)};
  w.clock = Clock::standard;
  EXPECT_EQ((*windowOn(w, kDay(2026, 1, 10), sydney, false)).from, std::chrono::sys_days(kDay(2026, 1, 9)) + 23h);
}

// docs/verify.md names these figures.
TEST(Windows, eightHoursOfTheSunByTheClock) {
  const Calendar c{place(39.9, 116.4), *sun::parseZone("+08:00"), kDay(2026, 1, 1)};
  std::chrono::milliseconds least = 24h, most = 0h;
  for (int day = 0; day < 365; ++day) {
    const auto date = std::chrono::year_month_day(std::chrono::sys_days(kDay(2026, 1, 1)) + std::chrono::days(day));
    const auto length = windowOn({Clock::solar, 8h, 16h, {}, {}}, date, c, false)->length();
    least = std::min(least, length), most = std::max(most, length);
  }
  EXPECT_EQ(std::chrono::round<std::chrono::seconds>(least), 7h + 59min + 53s);
  EXPECT_EQ(std::chrono::round<std::chrono::seconds>(most), 8h + 10s);
}

TEST(Windows, clocksThatAreSetWithinAWindow) {
  const Calendar c{place(48.2, 16.37), *sun::parseZone("Europe/Vienna"), kDay(2026, 1, 1)};
  const auto of = [&](std::chrono::milliseconds from, std::chrono::milliseconds to, std::chrono::year_month_day date) {
    return windowOn({Clock::zone, from, to, {}, {}}, date, c, false);
  };
  const auto utc = [](std::chrono::year_month_day date, std::chrono::milliseconds time) {
    return sun::Instant(std::chrono::sys_days(date) + time);
  };
  // Put forward from 02:00 to 03:00, at 01:00 UTC.
  const auto march = kDay(2026, 3, 29);
  EXPECT_EQ(of(2h + 30min, 4h, march), (study::TimeSpan{utc(march, 1h), utc(march, 2h)}));
  EXPECT_EQ(of(1h, 2h + 30min, march), (study::TimeSpan{utc(march, 0h), utc(march, 1h)}));
  EXPECT_FALSE(of(2h + 10min, 2h + 50min, march));
  // Put back from 03:00 to 02:00, at 01:00 UTC: all of the two hours that show 02.
  const auto october = kDay(2026, 10, 25);
  EXPECT_EQ(of(2h, 2h + 30min, october), (study::TimeSpan{utc(october, 0h), utc(october, 1h + 30min)}));
  // A midnight that is left out ends the day before it.
  const Calendar cairo{place(30, 31.2), *sun::parseZone("Africa/Cairo"), kDay(2026, 1, 1)};
  EXPECT_EQ(windowOn({Clock::zone, 8h, {}, {}, {}}, kDay(2026, 4, 23), cairo, false)->to, utc(kDay(2026, 4, 23), 22h));
  EXPECT_EQ(windowNotes({Clock::zone, 2h + 30min, 4h, {}, {}}, march, c).size(), 1u);
  EXPECT_EQ(windowNotes({Clock::zone, 2h, 2h + 30min, {}, {}}, october, c).size(), 2u);
  EXPECT_TRUE(windowNotes({Clock::solar, 2h + 30min, 4h, {}, {}}, march, c).empty());
  EXPECT_TRUE(windowNotes({Clock::zone, 8h, {}, {}, {}}, kDay(2026, 4, 23), cairo).empty());  // nobody named it
}

TEST(Windows, sunriseAndSunset) {
  const Calendar c{place(40.71, -74.0), *sun::parseZone("America/New_York"), kDay(2026, 3, 21)};
  const Window w{Clock::solar, {}, {}, 90min, 90min};
  const auto span = *windowOn(w, kDay(2026, 3, 21), c, false);
  // The almanac of New York, 21 March 2026: 6:58 to 19:09 daylight time.
  EXPECT_NEAR(hours(span.from - sun::Instant(std::chrono::sys_days(kDay(2026, 3, 21)) + 12h + 28min)), 0.0, 1.0 / 60.0);
  EXPECT_NEAR(hours(span.to - sun::Instant(std::chrono::sys_days(kDay(2026, 3, 21)) + 21h + 39min)), 0.0, 1.0 / 60.0);
  // Nothing is left in the polar night, and of a window that passes its limits.
  const Calendar north{place(75, 20), *sun::parseZone("+01:00"), kDay(2026, 12, 21)};
  EXPECT_FALSE(windowOn(w, kDay(2026, 12, 21), north, false).has_value());
  EXPECT_FALSE(windowOn({Clock::solar, {}, {}, 720min, 0min}, kDay(2026, 12, 21), c, false).has_value());
  EXPECT_TRUE(windowOn({Clock::solar, {}, {}, 60min, 60min}, kDay(2026, 6, 21), north, false).has_value());
}

// On both sides of the date line, where clocks are farthest from the sun's, with and without daylight saving.
struct Clocked {
  const char* zone;
  double latitude, longitude;
};
const Clocked kClocked[] = {{"Pacific/Apia", -13.8, -171.8},
                            {"Pacific/Chatham", -43.9, -176.5},
                            {"Pacific/Kiritimati", 1.9, -157.4},
                            {"Pacific/Fiji", -17.0, -179.9},
                            {"Pacific/Fiji", -17.0, 179.9},
                            {"Pacific/Fiji", -17.0, 180.0},
                            {"Pacific/Fiji", -17.0, -180.0},
                            {"Pacific/Auckland", -36.8, 174.8},
                            {"America/Adak", 51.9, -176.6},
                            {"Asia/Anadyr", 64.7, 177.5},
                            {"Asia/Anadyr", 66.0, -170.0},
                            {"Pacific/Honolulu", 21.3, -157.9},
                            {"America/Los_Angeles", 34, -118.2},
                            {"America/St_Johns", 47.6, -52.7},
                            {"Europe/Madrid", 42.9, -9.2},
                            {"Europe/London", 51.5, 0},
                            {"Asia/Kolkata", 22.6, 88.4},
                            {"Asia/Urumqi", 43.8, 87.6},
                            {"Asia/Shanghai", 39.5, 76.0},
                            {"Australia/Sydney", -33.9, 151.2},
                            {"solar", -17.0, 179.9},
                            {"solar", -17.0, -179.9}};

TEST(Windows, aDateIsTheClocksAllAroundTheEarth) {
  for (const auto& [name, latitude, longitude] : kClocked)
    for (const auto date : {kDay(2026, 1, 1), kDay(2026, 3, 29), kDay(2026, 7, 1), kDay(2026, 11, 1)}) {
      const Calendar c{place(latitude, longitude), *sun::parseZone(name), date};
      const std::string told = std::string(name) + " " + std::to_string(longitude) + " " + sun::dateText(date);
      const auto clock = [&](sun::Instant t) { return sun::clockAt(c.zone, c.place, t).clock; };
      const auto solar = windowOn({Clock::solar, 9h, 15h, {}, {}}, date, c, false);
      ASSERT_TRUE(solar) << told;
      const sun::Instant noon = solar->from + solar->length() / 2;
      EXPECT_NEAR(sun::hourAngle(c.place, noon).degrees(), 0.0, 0.1) << told;
      EXPECT_EQ(clock(noon).date, date) << told;
      // What sunrise and sunset leave of the clock's own day is all of its sunlight but its first and last hour.
      const auto lit = windowOn({Clock::zone, 1h, 24h, 60min, 60min}, date, c, false);
      const auto day = sun::sunDay(c.place, c.zone, date, {Angle::degrees(-0.833)});
      ASSERT_TRUE(day) << told;
      if (day->kind == sun::SunDay::Kind::alwaysDown) continue;
      ASSERT_TRUE(lit) << told;
      const auto onDate = [&](sun::Instant t) { return clock(t).date == date && clock(t).time > 1h; };
      if (day->rise && onDate(*day->rise + 60min)) {
        EXPECT_EQ(lit->from, *day->rise + 60min) << told;
      }
      if (day->set && onDate(*day->set - 60min)) {
        EXPECT_EQ(lit->to, *day->set - 60min) << told;
      }
      // The other clock looks at the same day.
      const auto other = windowOn({Clock::zone, 9h, 15h, {}, {}}, date, c, true);
      ASSERT_TRUE(other) << told;
      if (c.zone.kind != sun::Zone::Kind::solar) {
        EXPECT_EQ(*other, *solar) << told;
      }
    }
}

TEST(Windows, everyLongitudeHasItsOwnNoon) {
  // Whole hours west and east, as ships have them, and the date line's own clocks on its other side.
  for (int longitude = -180; longitude <= 180; longitude += 5)
    for (const double latitude : {-60.0, 0.0, 60.0})
      for (const int off : {-24, 0, 24}) {
        const long hour = std::lround(longitude / 15.0) + off;
        if (std::abs(hour) > 14) continue;
        const sun::Zone zone{sun::Zone::Kind::fixed, std::to_string(hour), std::chrono::hours(hour)};
        const Calendar c{place(latitude, longitude), zone, kDay(2026, 2, 11)};
        const auto day = windowOn({Clock::solar, {}, {}, 0min, 0min}, kDay(2026, 2, 11), c, false);
        ASSERT_TRUE(day) << longitude << ' ' << hour;
        EXPECT_EQ(sun::clockAt(zone, c.place, day->from + day->length() / 2).clock.date, kDay(2026, 2, 11))
            << longitude << ' ' << hour;
      }
}

TEST(Counting, fromAnAltitudeUp) {
  const sun::Place berlin = place(52.5, 13.4);
  const sun::Instant midnight = at({sun::Zone::Kind::solar, "solar", {}}, berlin, kDay(2026, 1, 17), 0h);
  const auto course = study::SunCourse::make(berlin, {midnight, midnight + 24h});
  for (const double altitude : {0.5, 6.0, 11.0, 16.0}) {
    const Spans spans = countingTimes(course, Angle::degrees(altitude));
    ASSERT_EQ(spans.size(), 1u);
    EXPECT_NEAR(sun::sunPosition(berlin, spans[0].from).elevation.degrees(), altitude, 1e-4);
    EXPECT_NEAR(sun::sunPosition(berlin, spans[0].to).elevation.degrees(), altitude, 1e-4);
  }
  EXPECT_TRUE(countingTimes(course, Angle::degrees(17.0)).empty());  // it reaches 16.7
  EXPECT_EQ(countingTimes(course, std::nullopt), course.up());
  EXPECT_EQ(total(countingTimes(course, Angle::degrees(-0.0))), course.upTime());
}

TEST(SpansOfTime, setOperations) {
  const sun::Instant zero{};
  const auto span = [&](int a, int b) {
    return study::TimeSpan{zero + std::chrono::minutes(a), zero + std::chrono::minutes(b)};
  };
  const Spans a{span(0, 10), span(20, 30), span(40, 50)}, b{span(5, 25), span(28, 29), span(45, 60)};
  EXPECT_EQ(both(a, b), (Spans{span(5, 10), span(20, 25), span(28, 29), span(45, 50)}));
  EXPECT_EQ(without(a, b), (Spans{span(0, 5), span(25, 28), span(29, 30), span(40, 45)}));
  EXPECT_EQ(without(b, a), (Spans{span(10, 20), span(50, 60)}));
  EXPECT_EQ(joined({span(20, 30), span(0, 10), span(10, 12), span(25, 40), span(50, 50)}),
            (Spans{span(0, 12), span(20, 40)}));
  EXPECT_EQ(total(both(a, b)) + total(without(a, b)), total(a));
  EXPECT_EQ(longest(a), 10min);
  EXPECT_EQ(atLeast(b, 2min).size(), 2u);
  EXPECT_TRUE(both(a, {}).empty());
  EXPECT_EQ(without(a, {}), a);
}

}  // namespace
}  // namespace umbrage::rules::detail

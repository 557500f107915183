#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "umbrage/sun/sun_path.hpp"

namespace umbrage::sun {
namespace {

using namespace std::chrono_literals;
using std::chrono::sys_days;

constexpr double kPi = std::numbers::pi;

Place place(double latitude, double longitude) { return {Angle::degrees(latitude), Angle::degrees(longitude)}; }
Instant utc(int y, unsigned m, unsigned d, std::chrono::milliseconds time = 0ms) {
  return sys_days(std::chrono::year(y) / std::chrono::month(m) / std::chrono::day(d)) + time;
}
double separation(const SunPosition& a, const SunPosition& b) {
  return 2.0 * std::asin(0.5 * glm::length(eastNorthUp(a) - eastNorthUp(b))) * 180.0 / kPi;
}

// Vienna, 18 September 2026, geometric: the values the project checks itself by.
TEST(SunPosition, MeetsTheCheckValues) {
  struct Check {
    std::chrono::milliseconds time;
    double elevation, azimuth;
  };
  for (const Check& c :
       {Check{7h, 22.630, 114.483}, {10h, 42.406, 163.413}, {11h, 43.499, 183.900}, {15h, 19.036, 250.193}}) {
    const SunPosition s = sunPosition(place(48.2, 16.37), utc(2026, 9, 18, c.time));
    EXPECT_NEAR(s.elevation.degrees(), c.elevation, 0.001);
    EXPECT_NEAR(s.azimuth.degrees(), c.azimuth, 0.001);
  }
}

// An independent road: low-precision solar coordinates (Meeus, Astronomical Algorithms, chapter 25) and mean sidereal
// time.
SunPosition byMeeus(const Place& p, Instant instant) {
  const double jd = 2440587.5 + double(instant.time_since_epoch().count()) / 86400e3;
  const double t = (jd + 65.0 / 86400.0 - 2451545.0) / 36525.0;
  const double rad = kPi / 180.0;
  const double l0 = 280.46646 + 36000.76983 * t + 0.0003032 * t * t;
  const double m = (357.52911 + 35999.05029 * t - 0.0001537 * t * t) * rad;
  const double c = (1.914602 - 0.004817 * t) * std::sin(m) + (0.019993 - 0.000101 * t) * std::sin(2 * m) +
                   0.000289 * std::sin(3 * m);
  const double omega = (125.04 - 1934.136 * t) * rad;
  const double lambda = (l0 + c - 0.00569 - 0.00478 * std::sin(omega)) * rad;
  const double epsilon = (23.439291 - 0.0130042 * t + 0.00256 * std::cos(omega)) * rad;
  const double ra = std::atan2(std::cos(epsilon) * std::sin(lambda), std::cos(lambda));
  const double dec = std::asin(std::sin(epsilon) * std::sin(lambda));
  const double tu = (jd - 2451545.0) / 36525.0;
  const double gmst = 280.46061837 + 360.98564736629 * (jd - 2451545.0) + 0.000387933 * tu * tu;
  const double equinoxes = -0.00478 * std::sin(omega) * std::cos(epsilon);
  const double h = (gmst + equinoxes) * rad + p.longitude.radians() - ra;
  const double lat = p.latitude.radians();
  const double up = std::sin(lat) * std::sin(dec) + std::cos(lat) * std::cos(dec) * std::cos(h);
  const double north = std::cos(lat) * std::sin(dec) - std::sin(lat) * std::cos(dec) * std::cos(h);
  return {Angle::radians(std::asin(up)), Angle::radians(std::atan2(-std::cos(dec) * std::sin(h), north)).wrapped()};
}

TEST(SunPosition, AgreesWithAnIndependentFormulaFromPoleToPoleOverACentury) {
  double worst = 0.0;
  for (const double latitude : {-90.0, -66.5, -33.0, 0.0, 23.4, 48.2, 70.0, 89.9, 90.0})
    for (int year = 1950; year <= 2050; year += 5)
      for (int day = 0; day < 365; day += 23) {
        const Place p = place(latitude, std::remainder(37.0 * year + 11.0 * day, 360.0));
        const Instant t =
            utc(year, 1, 1, std::chrono::hours(24 * day) + std::chrono::minutes((day * 97 + year * 31) % 1440));
        worst = std::max(worst, separation(sunPosition(p, t), byMeeus(p, t)));
      }
  EXPECT_LT(worst, 0.02);
}

TEST(SunPosition, TheYearLimitsStillAgree) {
  for (const Instant t : {utc(1900, 1, 1, 10h), utc(2100, 12, 31, 10h)})
    EXPECT_LT(separation(sunPosition(place(45, 0), t), byMeeus(place(45, 0), t)), 0.03);
}

TEST(SunPosition, AtThePoleElevationIsDeclinationAndAzimuthTurnsEvenly) {
  const Instant t = utc(2026, 6, 21, 3h);
  const SunPosition a = sunPosition(place(90, 0), t), b = sunPosition(place(90, 0), t + 6h);
  EXPECT_NEAR(a.elevation.degrees(), 23.436, 0.01);
  // The true solar day is at most 30 s longer or shorter than 24 h.
  EXPECT_NEAR((b.azimuth - a.azimuth).wrapped().degrees(), 90.0, 30.0 / 240.0 / 4.0);
}

TEST(SunPosition, IsInTheSouthAtSolarNoonInTheNorthAndTheOtherWayRound) {
  for (const double latitude : {-89.0, -50.0, -24.0, 24.0, 48.2, 89.0}) {
    const Place p = place(latitude, 16.37);
    const Instant noon = instantOfHourAngle(p, utc(2026, 3, 10, 11h), {});
    EXPECT_NEAR(hourAngle(p, noon).degrees(), 0.0, 1e-5);
    const double wanted = latitude > 0 ? 180.0 : 0.0;
    EXPECT_NEAR(std::remainder(sunPosition(p, noon).azimuth.degrees() - wanted, 360.0), 0.0, 1e-3);
  }
}

TEST(Refraction, IsTheTextbooksAndKeepsTheOrderOfElevations) {
  EXPECT_NEAR(refractionAt(Angle::degrees(0)).degrees() * 60, 28.98, 0.05);
  EXPECT_NEAR(refractionAt(Angle::degrees(45)).degrees() * 60, 1.01, 0.02);
  EXPECT_NEAR(refractionAt(Angle::degrees(90)).degrees(), 0.0, 1e-4);
  double before = -90.1;
  for (double h = -90; h <= 90; h += 0.01) {
    const double apparent = h + refractionAt(Angle::degrees(h)).degrees();
    EXPECT_GT(apparent, before) << h;
    EXPECT_LT(apparent, before + 0.021 + (h < -89.98 ? 0.1 : 0.0)) << h;
    before = apparent;
  }
  const Place p = place(48.2, 16.37);
  const Instant t = utc(2026, 9, 18, 7h);
  EXPECT_GT(sunPosition(p, t, Refraction::standard).elevation, sunPosition(p, t).elevation);
}

TEST(Direction, IsAUnitVectorEastNorthUp) {
  const Vec3 west = eastNorthUp({Angle::degrees(0), Angle::degrees(270)});
  EXPECT_NEAR(west.x, -1, 1e-12);
  const Vec3 v = eastNorthUp({Angle::degrees(30), Angle::degrees(45)});
  EXPECT_NEAR(glm::length(v), 1, 1e-12);
  EXPECT_NEAR(v.z, 0.5, 1e-12);
  EXPECT_NEAR(v.x, v.y, 1e-12);
}

TEST(Direction, HasACompassName) {
  EXPECT_EQ(compassPoint(Angle::degrees(0)), "N");
  EXPECT_EQ(compassPoint(Angle::degrees(359)), "N");
  EXPECT_EQ(compassPoint(Angle::degrees(114.48)), "ESE");
  EXPECT_EQ(compassPoint(Angle::degrees(-90)), "W");
}

TEST(SunDay, RiseAndSetLieEvenlyAboutTheTransitAtTheSolstice) {
  const Place p = place(48.2, 16.37);
  const auto day = sunDay(p, *parseZone("Europe/Vienna"), std::chrono::year(2026) / 6 / 21);
  ASSERT_TRUE(day && day->rise && day->set);
  EXPECT_LT(std::chrono::abs((*day->set - day->transit) - (day->transit - *day->rise)), 20s);
  for (const Instant t : {*day->rise, *day->set}) EXPECT_NEAR(sunPosition(p, t).elevation.degrees(), 0, 1e-4);
}

TEST(SunDay, MeetsAnAlmanac) {
  // Greenwich, 2026-03-20: about 06:04 and 18:14 UTC, upper limb with refraction.
  const auto day =
      sunDay(place(51.4779, 0), *parseZone("+00:00"), std::chrono::year(2026) / 3 / 20, {Angle::degrees(-0.833)});
  ASSERT_TRUE(day && day->rise && day->set);
  EXPECT_LT(std::chrono::abs(*day->rise - utc(2026, 3, 20, 6h + 4min)), 2min);
  EXPECT_LT(std::chrono::abs(*day->set - utc(2026, 3, 20, 18h + 14min)), 2min);
}

TEST(SunDay, KnowsPolarDaysAndNights) {
  const Place tromso = place(69.65, 18.96);
  const Zone zone = *parseZone("Europe/Oslo");
  EXPECT_EQ(sunDay(tromso, zone, std::chrono::year(2026) / 6 / 21)->kind, SunDay::Kind::alwaysUp);
  EXPECT_EQ(sunDay(tromso, zone, std::chrono::year(2026) / 12 / 21)->kind, SunDay::Kind::alwaysDown);
  EXPECT_EQ(sunDay(tromso, zone, std::chrono::year(2026) / 3 / 21)->kind, SunDay::Kind::risesAndSets);
  EXPECT_FALSE(sunDay(tromso, zone, std::chrono::year(2026) / 6 / 21)->rise);
}

TEST(SunDay, BelongsToTheClocksDateEastAndWestOfTheDateLine) {
  for (const auto& [latitude, longitude, name] : {std::tuple(-13.8, -171.8, "Pacific/Apia"),
                                                  {21.3, -157.9, "Pacific/Honolulu"},
                                                  {1.9, -157.4, "Pacific/Kiritimati"},
                                                  {-36.8, 174.8, "Pacific/Auckland"}}) {
    const Place p = place(latitude, longitude);
    const Zone zone = *parseZone(name);
    const auto date = std::chrono::year(2026) / 2 / 28;
    EXPECT_EQ(clockAt(zone, p, sunDay(p, zone, date)->transit).clock.date, date) << name;
  }
}

TEST(SunPath, HasBothEndsWhereTheStepMeetsThem) {
  const Instant t = utc(2026, 9, 18, 10h);
  EXPECT_EQ(sunPath(place(48, 16), t, t + 3h, 30min).size(), 7u);
  EXPECT_EQ(sunPath(place(48, 16), t, t + 3h, 40min).size(), 5u);
  EXPECT_EQ(sunPath(place(48, 16), t, t, 40min).size(), 1u);
}

}  // namespace
}  // namespace umbrage::sun

#include "umbrage/sun/detail/apparent_sun.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "umbrage/sun/detail/julian_date.hpp"

namespace umbrage::sun::detail {
namespace {

using namespace std::chrono_literals;

Instant day(int y, unsigned m, unsigned d) {
  return std::chrono::sys_days(std::chrono::year(y) / std::chrono::month(m) / std::chrono::day(d));
}

Vec3 bySeries(Instant instant) {
  const JulianDate utc = julianDate(instant);
  return apparentSunBySeries(utc.day - 2451544.5, utc.fraction - 0.5 + ttMinusUtc(instant) / 86400.0);
}

// The series are summed at noon of a few days; between, nothing of them is lost.
TEST(ApparentSun, IsTheSeriesEverywhereBetween) {
  double worst = 0.0;
  for (const Instant first :
       {day(1900, 1, 1), day(1971, 12, 30), day(2016, 12, 29), day(2026, 6, 1), day(2100, 12, 20)})
    for (auto t = 0min; t < 8 * 24h; t += 37min)
      worst = std::max(worst, glm::length(apparentSun(first + t) - bySeries(first + t)));
  EXPECT_LT(worst, 1e-11);
}

// A leap second at the end of 2016 stops the clock, not the sun.
TEST(ApparentSun, PassesLeapSecondsSmoothly) {
  const Instant t = day(2017, 1, 1);
  const double before = glm::length(apparentSun(t - 1ms) - apparentSun(t - 1001ms));
  const double over = glm::length(apparentSun(t) - apparentSun(t - 1ms));
  EXPECT_NEAR(over, before, 0.01 * before);  // 1 s of the sun's motion, for 1 ms of the clock
}

TEST(ApparentSun, IsTheSameInEveryThreadAndAfterAnyOtherQuestion) {
  const Instant t = day(2026, 3, 20) + 12345678ms;
  const Vec3 here = apparentSun(t);
  for (int year = 1901; year < 2100; year += 2) (void)apparentSun(day(year, 7, 1));
  Vec3 there;
  std::thread([&] { there = apparentSun(t); }).join();
  EXPECT_EQ(here, apparentSun(t));
  EXPECT_EQ(here, there);
}

}  // namespace
}  // namespace umbrage::sun::detail

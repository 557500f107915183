#include "umbrage/sun/self_check.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace umbrage::sun {
namespace {

TEST(SelfCheck, TheSunIsErfasWhereverAndWheneverItIsAskedFor) {
  const SelfCheck check = selfCheck();
  EXPECT_EQ(check.direction.count, 5000u);
  EXPECT_GT(check.noon.count, 350u);
  EXPECT_TRUE(holds(check)) << check.direction.worst << " degrees, refraction " << check.refraction.worst << ", noon "
                            << check.noon.worst << " s, rise and set " << check.riseAndSet.worst << " s";
  EXPECT_LT(check.direction.mean(), check.direction.worst);
  EXPECT_NEAR(check.universalTime.worst, 0.9 / 240.0, 2e-5);
}

TEST(SelfCheck, DoesNotHoldWhereOneOfItsFiguresIsTooLarge) {
  SelfCheck check;
  EXPECT_TRUE(holds(check));
  for (Deviation SelfCheck::*figure :
       {&SelfCheck::direction, &SelfCheck::refraction, &SelfCheck::noon, &SelfCheck::riseAndSet}) {
    SelfCheck wrong = check;
    (wrong.*figure).worst = 0.5;
    EXPECT_FALSE(holds(wrong));
  }
}

// The other road is no echo of the first: a clock that is a second wrong shows.
TEST(SelfCheck, SeesASecond) {
  using namespace std::chrono_literals;
  const Place vienna{Angle::degrees(48.2), Angle::degrees(16.37)};
  const Instant noon = std::chrono::sys_days(std::chrono::year(2026) / 9 / 18) + 11h;
  const double right = sunPositionByObserver(vienna, noon).azimuth.degrees();
  EXPECT_NEAR(sunPosition(vienna, noon).azimuth.degrees(), right, 1e-4);
  EXPECT_GT(std::abs(sunPosition(vienna, noon + 1s).azimuth.degrees() - right), 0.003);
}

// Days that end with a leap second are longer for ERFA, not for a clock that counts 86,400 s.
TEST(SelfCheck, DaysWithALeapSecondAreNoException) {
  using namespace std::chrono_literals;
  const Place vienna{Angle::degrees(48.2), Angle::degrees(16.37)};
  for (const auto time : {1h, 12h, 23h}) {
    const Instant t = std::chrono::sys_days(std::chrono::year(2016) / 12 / 31) + time;
    EXPECT_NEAR(sunPosition(vienna, t).azimuth.degrees(), sunPositionByObserver(vienna, t).azimuth.degrees(), 2e-4);
  }
}

}  // namespace
}  // namespace umbrage::sun

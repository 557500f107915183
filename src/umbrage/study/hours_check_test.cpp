#include "umbrage/study/hours_check.hpp"

#include <gtest/gtest.h>

namespace umbrage::study {
namespace {

TEST(HoursCheck, ShadowsOfTrianglesChangeWhenErfaSays) {
  const auto check = checkHours();
  ASSERT_TRUE(check);
  EXPECT_EQ(check->triangles, 200u);
  EXPECT_GT(check->changes.count, 300u);
  EXPECT_GT(check->moments, 6000u);
  EXPECT_TRUE(holds(*check)) << check->wrong << " wrong, " << check->changes.worst << " s";
}

TEST(HoursCheck, DoesNotHoldWhereSomethingIsWrong) {
  HoursCheck late, wrong;
  late.changes.worst = 1.0;
  wrong.wrong = 1;
  EXPECT_TRUE(holds(HoursCheck{}));
  EXPECT_FALSE(holds(late));
  EXPECT_FALSE(holds(wrong));
}

}  // namespace
}  // namespace umbrage::study

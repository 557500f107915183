#include "approval/approval.hpp"

namespace umbrage::approval {
namespace {

TEST(Approval, TakesTheApprovedTextAndNoOther) {
  if (std::getenv("UMBRAGE_APPROVE")) GTEST_SKIP() << "texts are being approved";
  EXPECT_TRUE(approved("approval_example", "pass sides\n"));
  EXPECT_FALSE(approved("approval_example", "pass sides"));
  EXPECT_FALSE(approved("approval_no_such_file", ""));
}

}  // namespace
}  // namespace umbrage::approval

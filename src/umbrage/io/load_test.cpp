#include "umbrage/io/load.hpp"

#include <gtest/gtest.h>

namespace umbrage::io {
namespace {

TEST(Load, refusesWhatIsNotAFile) {
  EXPECT_EQ(loadScene("/nowhere.obj").error().code, ErrorCode::input);
  EXPECT_EQ(loadScene("/tmp").error().code, ErrorCode::input);
}

}  // namespace
}  // namespace umbrage::io

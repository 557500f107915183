#include <gtest/gtest.h>

#include "umbrage/image/compare.hpp"
#include "umbrage/image/image.hpp"

namespace umbrage::image {
namespace {

TEST(Image, StoresRowsFromTheTop) {
  GreyImage picture(3, 2);
  picture(2, 1) = 7;
  EXPECT_EQ(picture.pixels()[5], 7);
  EXPECT_TRUE(picture.contains(2, 1));
  EXPECT_FALSE(picture.contains(3, 1));
}

TEST(Compare, CountsPixelsAndFindsTheLargest) {
  RgbImage a(2, 1), b(2, 1);
  b(1, 0) = {10, 0, 200};
  const Difference d = compare(a, b);
  EXPECT_EQ(d.pixels, 1u);
  EXPECT_EQ(d.largest, 200);
  EXPECT_DOUBLE_EQ(d.mean, 35.0);
  EXPECT_EQ(compare(a, a).pixels, 0u);
  EXPECT_EQ(compare(RgbImage{}, RgbImage{}).mean, 0.0);
}

}  // namespace
}  // namespace umbrage::image

#include <gtest/gtest.h>

#include "umbrage/base/file.hpp"
#include "umbrage/png/png.hpp"

namespace umbrage::png {
namespace {

std::filesystem::path temporary(const char* name) { return std::filesystem::path(testing::TempDir()) / name; }

TEST(Png, ComesBackAsItWent) {
  image::RgbaImage picture(5, 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x) picture(x, y) = {std::uint8_t(50 * x), std::uint8_t(80 * y), 9, std::uint8_t(255 - x)};
  const auto path = temporary("umbrage_roundtrip.png");
  ASSERT_TRUE(write(path, picture));
  EXPECT_EQ(read(path).value(), picture);
}

TEST(Png, GreyIsReadAsEqualChannels) {
  image::GreyImage picture(2, 1);
  picture(1, 0) = 128;
  const auto path = temporary("umbrage_grey.png");
  ASSERT_TRUE(write(path, picture));
  EXPECT_EQ(read(path).value()(1, 0), (image::Rgba8{128, 128, 128, 255}));
}

TEST(Png, RemarksStandInTheFileAndChangeNoPixel) {
  image::RgbImage picture(3, 2);
  picture(2, 1) = {10, 20, 30};
  const auto path = temporary("umbrage_remarks.png");
  ASSERT_TRUE(write(path, picture, {{"Place", "48.2000 N \u00b0"}, {"Input", ""}}));
  const auto back = read(path);
  ASSERT_TRUE(back) << "the checksums of the chunks are right, or libpng would refuse the file";
  EXPECT_EQ((*back)(2, 1), (image::Rgba8{10, 20, 30, 255}));
  const auto bytes = readFile(path);
  ASSERT_TRUE(bytes);
  const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  EXPECT_NE(text.find(std::string_view("iTXtPlace\0\0\0\0\0"
                                       "48.2000 N \u00b0",
                                       26)),
            text.npos);
}

TEST(Png, BytesInMemoryAreReadTooUpToALimit) {
  const auto path = temporary("umbrage_memory.png");
  ASSERT_TRUE(write(path, image::GreyImage(6, 5, 77)));
  const auto bytes = readFile(path);
  ASSERT_TRUE(bytes);
  EXPECT_EQ(decode(*bytes).value()(5, 4), (image::Rgba8{77, 77, 77, 255}));
  EXPECT_TRUE(decode(*bytes, 30));
  EXPECT_FALSE(decode(*bytes, 29));
  EXPECT_FALSE(decode(std::span(*bytes).first(40)));
}

TEST(Png, BrokenFilesAndEmptyPicturesAreErrors) {
  const auto path = temporary("umbrage_broken.png");
  ASSERT_TRUE(writeFile(path, "not a png"));
  EXPECT_EQ(read(path).error().code, ErrorCode::input);
  EXPECT_FALSE(read(temporary("umbrage_absent.png")));
  EXPECT_FALSE(write(path, image::RgbImage{}));
}

}  // namespace
}  // namespace umbrage::png

#include <gif_lib.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>

#include "support/box_scene.hpp"
#include "support/brute_force_technique.hpp"
#include "umbrage/base/file.hpp"
#include "umbrage/image/compare.hpp"
#include "umbrage/png/png.hpp"
#include "umbrage/report/colours.hpp"
#include "umbrage/report/detail/hours_scale.hpp"
#include "umbrage/report/gif.hpp"
#include "umbrage/report/profile_pictures.hpp"
#include "umbrage/report/step_pictures.hpp"
#include "umbrage/report/write_profile.hpp"

namespace umbrage::report {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr int kWidth = 420, kHeight = 260;

double luminance(image::Rgb8 c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

// A box of 10 x 10 x 10 seen from straight above, north at the top, 0.125 units of ground a pixel.
struct Study {
  scene::Scene scene;
  study::Profile profile;
};

Study studyOf(const char* from, const char* to, std::chrono::milliseconds step, std::vector<std::string> casters = {},
              int width = kWidth, int height = kHeight) {
  Study s{scene::withGround(support::boxScene({{"West", {-9, -5, 0}, {-2, 5, 8}}, {"East", {2, -5, 0}, {9, 5, 8}}})),
          {}};
  s.scene.source = "boxes.glb";
  study::ProfileOptions o;
  o.period = {*sun::makePlace(48.2, 16.37), *sun::parseZone("solar"), *sun::parseDate("2026-09-18"),
              *sun::parseTime(from),        *sun::parseTime(to),      step};
  o.camera.eye = {0, 0, 100};
  o.camera.target = {0, 0, 0};
  o.camera.up = {0, 1, 0};
  o.camera.width = width;
  o.camera.height = height;
  o.camera.fovY = Angle::radians(2.0 * std::atan(16.25 / 100.0));
  o.casters = std::move(casters);
  support::BruteForceTechnique technique;
  auto profile = study::profile(s.scene, o, technique);
  EXPECT_TRUE(profile) << profile.error().text();
  s.profile = std::move(*profile);
  return s;
}

const Study& noonStudy() {
  static const Study s = studyOf("10:00", "14:00", 1h);
  return s;
}

std::size_t countColour(const image::RgbImage& picture, image::Rgb8 colour, int fromX, int toX) {
  std::size_t count = 0;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = fromX; x < toX; ++x) count += picture(x, y) == colour;
  return count;
}

TEST(Colours, KeepTheirOrderWithoutColourVision) {
  for (int i = 1; i <= 100; ++i) {
    EXPECT_GT(luminance(timeColour(i / 100.0)), luminance(timeColour((i - 1) / 100.0)) - 0.51) << i;
    EXPECT_LT(luminance(heatColour(i / 100.0)), luminance(heatColour((i - 1) / 100.0)) + 0.51) << i;
  }
  EXPECT_GT(luminance(timeColour(1)) - luminance(timeColour(0)), 80);
  EXPECT_GT(luminance(heatColour(0)) - luminance(heatColour(1)), 150);
}

TEST(Colours, AgreeWithTheColourSpaceTheyAreDefinedIn) {
  EXPECT_EQ(perceptual(1, 0, {}), (image::Rgb8{255, 255, 255}));
  EXPECT_EQ(perceptual(0, 0, {}), (image::Rgb8{0, 0, 0}));
  // sRGB red is OKLCh 0.628, 0.2577, 29.23 degrees.
  const auto red = perceptual(0.62796, 0.25768, Angle::degrees(29.234));
  EXPECT_NEAR(red.r, 255, 1);
  EXPECT_LE(red.g, 6);
  EXPECT_LE(red.b, 6);
}

TEST(Colours, OfSixtyStepsAndEightPartsAllDiffer) {
  std::set<std::tuple<int, int, int>> seen;
  for (int i = 0; i < 60; ++i) {
    const auto c = timeColour(i / 59.0);
    seen.insert({c.r, c.g, c.b});
  }
  EXPECT_EQ(seen.size(), 60u);
  seen.clear();
  for (std::size_t i = 0; i < 8; ++i) {
    const auto c = partColour(i);
    seen.insert({c.r, c.g, c.b});
  }
  EXPECT_EQ(seen.size(), 8u);
}

TEST(ShadowPicture, HasTheViewAtTheTopLeftAndEveryStepInTheLegend) {
  const auto picture = shadowPicture(noonStudy().scene, noonStudy().profile);
  EXPECT_GT(picture.width(), kWidth + 200);
  EXPECT_GE(picture.height(), kHeight);
  for (int i = 0; i < 5; ++i) EXPECT_GT(countColour(picture, timeColour(i / 4.0), kWidth, picture.width()), 100u) << i;
}

// Where no shadow ever falls the model is plain; in the shadow of all steps it is darkest.
TEST(ShadowPicture, DeepensWithTheNumberOfShadows) {
  const Study& s = noonStudy();
  const auto picture = shadowPicture(s.scene, s.profile);
  const auto plain = picture(5, kHeight / 2);
  const auto at = [&](double x, double y) {
    return picture(int(kWidth / 2 + x / 0.125), int(kHeight / 2 - y / 0.125));
  };
  EXPECT_EQ(plain, at(0, -14));                               // south of the boxes: always sunlit
  EXPECT_LT(luminance(at(5, 6)), luminance(at(5, 12)) - 10);  // at the north wall; far from it
  EXPECT_LT(luminance(at(5, 12)), luminance(plain) + 1);
}

TEST(ShadowPicture, OutlinesEachStepInItsColour) {
  const Study& s = noonStudy();
  const auto picture = shadowPicture(s.scene, s.profile);
  for (int i = 0; i < 5; ++i) {
    const auto colour = timeColour(i / 4.0);
    std::size_t near = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const auto c = picture(x, y);
        near += std::abs(c.r - colour.r) + std::abs(c.g - colour.g) + std::abs(c.b - colour.b) < 40;
      }
    EXPECT_GT(near, 40u) << i;
  }
}

TEST(ShadowPicture, StaysWithinItsPanelForManySteps) {
  const Study s = studyOf("06:00", "18:00", 12min, {}, 90, 60);
  ASSERT_EQ(s.profile.steps.size(), 61u);
  const auto picture = shadowPicture(s.scene, s.profile);
  EXPECT_LT(picture.height(), 700);
}

TEST(ShadowPicture, OfPartsShowsThemInTheirColours) {
  const Study s = studyOf("11:00", "13:00", 1h, {"West", "East"});
  const auto picture = shadowPicture(s.scene, s.profile);
  for (std::size_t part = 0; part < 2; ++part)
    for (const double t : {0.0, 0.5, 1.0})
      EXPECT_GT(countColour(picture, partColour(part, t), kWidth, picture.width()), 100u) << part << " " << t;
  // The roofs are tinted: hue as the part's.
  const auto west = picture(int(kWidth / 2 - 5.5 / 0.115), kHeight / 2),
             east = picture(int(kWidth / 2 + 5.5 / 0.115), kHeight / 2);
  EXPECT_GT(west.r, west.b + 20);
  EXPECT_GT(east.b, east.r + 20);
}

TEST(HoursPicture, GoesFromNoneToAllOnItsScale) {
  const Study& s = noonStudy();
  const auto picture = hoursPicture(s.scene, s.profile);
  EXPECT_GT(countColour(picture, heatColour(0), kWidth, picture.width()), 10u);
  EXPECT_GT(countColour(picture, heatColour(1), kWidth, picture.width()), 10u);
  const auto at = [&](double x, double y) {
    return picture(int(kWidth / 2 + x / 0.125), int(kHeight / 2 - y / 0.125));
  };
  EXPECT_GT(luminance(at(0, -14)), 200);  // always in the sun
  EXPECT_LT(luminance(at(5, 6)), 120);    // always in shadow
}

// Hours of a moment, a day or a year.
TEST(HoursScale, EndsSoonBehindTheMostAtARoundNumber) {
  for (double most = 0.01; most < 9000.0; most *= 1.003) {
    const detail::HoursScale scale = detail::scaleFor(most);
    EXPECT_GE(scale.top, most * (1.0 - 1e-6));
    EXPECT_LE(scale.top, 1.2 * most) << "little of the colours is left over; most just above 5, where the end is 6";
    const double steps = scale.top / scale.step;
    EXPECT_NEAR(steps, std::round(steps), 1e-9) << "the last label stands at the top";
    EXPECT_GE(steps, 3.99);
    EXPECT_LE(steps, 9.01);
    const double digits = scale.step / std::pow(10.0, std::floor(std::log10(scale.step)) - 1.0);
    EXPECT_NEAR(digits, std::round(digits), 1e-6) << "no more than two digits: " << scale.step;
  }
  EXPECT_EQ(detail::scaleFor(12.26).top, 12.5);
  EXPECT_EQ(detail::scaleFor(12.0).top, 12.0);
  EXPECT_EQ(detail::scaleFor(17.776).top, 18.0);
  EXPECT_EQ(detail::scaleFor(4431.0).top, 4500.0);
  EXPECT_EQ(detail::scaleFor(0.0).top, 1.0);
}

// One bad byte must not silence the rest of the legend.
TEST(ShadowPicture, SurvivesNamesThatAreNoText) {
  Study s = studyOf("11:00", "13:00", 1h, {}, 90, 60);
  const auto good = shadowPicture(s.scene, s.profile);
  s.scene.source = "\xff\xfe\xc3(\xed\xa0\x80\n\t\xf8";
  const auto bad = shadowPicture(s.scene, s.profile);
  EXPECT_EQ(bad.height(), good.height());
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(countColour(bad, timeColour(i / 2.0), 90, bad.width()),
              countColour(good, timeColour(i / 2.0), 90, good.width()));
}

TEST(Pictures, OfANightAreDrawnToo) {
  const Study s = studyOf("00:00", "03:00", 1h, {}, 90, 60);
  EXPECT_GT(shadowPicture(s.scene, s.profile).width(), 90);
  EXPECT_GT(hoursPicture(s.scene, s.profile).width(), 90);
  EXPECT_EQ(StepPictures(s.scene, s.profile).picture(0).width(), 90);
}

TEST(StepPictures, AreDarkerWhereTheShadowIs) {
  const Study& s = noonStudy();
  const auto noon = StepPictures(s.scene, s.profile).picture(2);
  EXPECT_EQ(noon.width(), kWidth);
  EXPECT_EQ(noon.height(), kHeight);
  const auto at = [&](double x, double y) { return noon(int(kWidth / 2 + x / 0.125), int(kHeight / 2 - y / 0.125)); };
  EXPECT_LT(luminance(at(5, 7)), 0.8 * luminance(at(0, -13)));
}

// ---- animations

class Files : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("umbrage_report_test_" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) + "_" +
               ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  [[nodiscard]] std::size_t fileCount() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  fs::path folder_;
};

struct DecodedGif {
  std::vector<image::RgbImage> frames;  // as shown, each drawn over the one before
  std::vector<int> hundredths;
  bool loops = false;
};

DecodedGif decode(const fs::path& path) {
  DecodedGif out;
  int error = 0;
  GifFileType* gif = DGifOpenFileName(path.c_str(), &error);
  if (gif == nullptr || DGifSlurp(gif) != GIF_OK) return out;
  image::RgbImage screen(gif->SWidth, gif->SHeight);
  for (int i = 0; i < gif->ImageCount; ++i) {
    const SavedImage& saved = gif->SavedImages[i];
    for (int y = 0; y < saved.ImageDesc.Height; ++y)
      for (int x = 0; x < saved.ImageDesc.Width; ++x) {
        const GifColorType c = gif->SColorMap->Colors[saved.RasterBits[y * saved.ImageDesc.Width + x]];
        screen(saved.ImageDesc.Left + x, saved.ImageDesc.Top + y) = {c.Red, c.Green, c.Blue};
      }
    out.frames.push_back(screen);
    GraphicsControlBlock control;
    out.hundredths.push_back(DGifSavedExtensionToGCB(gif, i, &control) == GIF_OK ? control.DelayTime : -1);
    for (int k = 0; k < saved.ExtensionBlockCount; ++k)
      out.loops = out.loops || saved.ExtensionBlocks[k].Function == APPLICATION_EXT_FUNC_CODE;
  }
  DGifCloseFile(gif, &error);
  return out;
}

TEST_F(Files, AnAnimationHasItsFramesItsPaceAndItsLoop) {
  const std::vector<image::Rgb8> colours{{200, 30, 30}, {30, 200, 30}, {30, 30, 200}, {30, 30, 200}};
  Animation a;
  a.frames = colours.size();
  a.delay = 250ms;
  a.frame = [&](std::size_t i) -> Result<image::RgbImage> {
    image::RgbImage p(33, 21, {240, 240, 240});
    for (int x = 0; x < 10; ++x) p(x + int(2 * i), 7) = colours[i];
    return p;
  };
  ASSERT_TRUE(writeGif(folder_ / "a.gif", a));
  const auto gif = decode(folder_ / "a.gif");
  ASSERT_EQ(gif.frames.size(), 4u);
  EXPECT_TRUE(gif.loops);
  EXPECT_THAT(gif.hundredths, testing::Each(25));
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(gif.frames[i], *a.frame(i)) << i;
}

TEST_F(Files, AnAnimationStopsAtAFrameThatFailsAndLeavesNothing) {
  Animation a;
  a.frames = 3;
  a.frame = [](std::size_t i) -> Result<image::RgbImage> {
    if (i == 1) return fail(ErrorCode::cancelled, "cancelled");
    return image::RgbImage(4, 4);
  };
  EXPECT_EQ(writeGif(folder_ / "a.gif", a).error().code, ErrorCode::cancelled);
  EXPECT_EQ(fileCount(), 0u);
}

TEST_F(Files, AProfileIsThreeFilesAndTheSameBytesAgain) {
  const Study& s = noonStudy();
  const auto written = writeProfile(s.profile, s.scene, folder_ / "p.png");
  ASSERT_TRUE(written) << written.error().text();
  EXPECT_THAT(*written, testing::ElementsAre(folder_ / "p.png", folder_ / "p-hours.png", folder_ / "p.gif"));
  EXPECT_EQ(fileCount(), 3u);
  ASSERT_TRUE(writeProfile(s.profile, s.scene, folder_ / "q.png"));
  EXPECT_EQ(*readFile(folder_ / "p.png"), *readFile(folder_ / "q.png"));
  EXPECT_EQ(*readFile(folder_ / "p-hours.png"), *readFile(folder_ / "q-hours.png"));
  EXPECT_EQ(*readFile(folder_ / "p.gif"), *readFile(folder_ / "q.gif"));

  const auto gif = decode(folder_ / "p.gif");
  ASSERT_EQ(gif.frames.size(), s.profile.steps.size());
  const StepPictures pictures(s.scene, s.profile);
  for (std::size_t i = 0; i < gif.frames.size(); ++i)
    EXPECT_LT(image::compare(gif.frames[i], pictures.picture(i)).mean, 1.0) << i;  // 256 colours for some thousand
}

TEST_F(Files, AProfileCancelledOrMisnamedLeavesNothing) {
  const Study& s = noonStudy();
  EXPECT_EQ(writeProfile(s.profile, s.scene, folder_ / "p.jpg").error().code, ErrorCode::usage);
  const auto cancelled =
      writeProfile(s.profile, s.scene, folder_ / "p.png", [](double f, std::string_view) { return f < 0.5; });
  EXPECT_EQ(cancelled.error().code, ErrorCode::cancelled);
  EXPECT_EQ(fileCount(), 0u);
  EXPECT_EQ(writeProfile(s.profile, s.scene, folder_ / "no" / "p.png").error().code, ErrorCode::output);
}

}  // namespace
}  // namespace umbrage::report

#include "parse.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "arguments.hpp"

namespace umbrage::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

template <class T>
std::string messageOf(const Result<T>& result) {
  if (result) return {};
  EXPECT_EQ(result.error().code, ErrorCode::usage);
  return result.error().message;
}

TEST(ParseNumber, TakesWholeFiniteWordsOnly) {
  EXPECT_EQ(parseNumber("-4.5e-1").value(), -0.45);
  EXPECT_EQ(parseNumber("+3").value(), 3.0);
  EXPECT_EQ(parseNumber(".5").value(), 0.5);
  EXPECT_EQ(parseNumber("1e-400").has_value(), false);
  for (const auto* word :
       {"", " 1", "1 ", "1,5", "0x10", "nan", "NaN", "inf", "-inf", "1e999", "+-1", "--1", "1.2.3", "-", "+", "."})
    EXPECT_FALSE(parseNumber(word)) << word;
  EXPECT_THAT(messageOf(parseNumber("91", -90, 90)), HasSubstr("'91' is not between -90 and 90"));
  EXPECT_EQ(parseNumber("90", -90, 90).value(), 90.0);
}

TEST(ParsePoint, TakesThreeNumbers) {
  EXPECT_EQ(parsePoint("-4,2,1").value(), Vec3(-4, 2, 1));
  for (const auto* word :
       {"", "1,2", "1,2,3,4", "1, 2,3", "1,2,", "a,b,c", "nan,0,0", "0,inf,0", "0,0,1e13", "--target"})
    EXPECT_FALSE(parsePoint(word)) << word;
  EXPECT_THAT(messageOf(parsePoint("1,2")), HasSubstr("x,y,z"));
}

TEST(ParseSize, KeepsToSensiblePictures) {
  const auto size = parseSize("640x360").value();
  EXPECT_EQ(size.width, 640);
  EXPECT_EQ(size.height, 360);
  EXPECT_TRUE(parseSize("1x1"));
  EXPECT_TRUE(parseSize("8192x8192"));
  for (const auto* word : {"", "640", "640x", "x360", "0x10", "10x0", "-1x5", "+1x5", "16385x1", "16384x16384", "1.5x2",
                           "4x4x4", "99999999999x1", "640X360", "640 x360"})
    EXPECT_FALSE(parseSize(word)) << word;
}

TEST(ParseColour, IsLinear) {
  EXPECT_EQ(parseColour("#ffffff").value(), Vec3(1.0));
  EXPECT_EQ(parseColour("#000000").value(), Vec3(0.0));
  const Vec3 colour = parseColour("#FF8000").value();
  EXPECT_EQ(colour.r, 1.0);
  // The middle sRGB code is about a fifth of full light (IEC 61966-2-1).
  EXPECT_NEAR(colour.g, std::pow((128.0 / 255.0 + 0.055) / 1.055, 2.4), 1e-9);
  for (const auto* word : {"", "#fff", "ffffff", "#fffffg", "#-1ffff", "#fffffff", "red"})
    EXPECT_FALSE(parseColour(word)) << word;
}

TEST(ParseLight, ReadsTheThreeShapes) {
  const auto point = parseLight("point:1,-2,3").value();
  EXPECT_EQ(std::get<scene::PointLight>(point.shape).position, Vec3(1, -2, 3));
  EXPECT_EQ(point.colour, Vec3(1.0));
  EXPECT_EQ(point.intensity, 1.0);

  const auto sun = parseLight("directional:-1,0,-2,#ff0000").value();
  EXPECT_EQ(std::get<scene::DirectionalLight>(sun.shape).direction, Vec3(-1, 0, -2));
  EXPECT_EQ(sun.colour, Vec3(1, 0, 0));

  const auto spot = parseLight("spot:0,0,5,0,0,-1,30,#0000ff,2.5").value();
  const auto& shape = std::get<scene::SpotLight>(spot.shape);
  EXPECT_EQ(shape.position, Vec3(0, 0, 5));
  EXPECT_EQ(shape.direction, Vec3(0, 0, -1));
  EXPECT_NEAR(shape.cutoff.degrees(), 30.0, 1e-12);
  EXPECT_EQ(spot.colour, Vec3(0, 0, 1));
  EXPECT_EQ(spot.intensity, 2.5);
  EXPECT_TRUE(scene::isValid(spot));
}

TEST(ParseLight, RefusesWithARemedy) {
  for (const auto* word : {"", "point", "point:", "point:1,2", "point:1,2,3,4", "point:nan,0,0", "sun:1,2,3",
                           "directional:0,0,0", "spot:0,0,0,0,0,0,30", "spot:0,0,0,0,0,-1", "spot:0,0,0,0,0,-1,0",
                           "spot:0,0,0,0,0,-1,181", "spot:0,0,0,0,0,-1,-5", "point:1,2,3,#ff", "point:1,2,3,#ffffff,-1",
                           "point:1,2,3,#ffffff,inf", "point:1,2,3,#ffffff,1,2", "point 1,2,3"})
    EXPECT_FALSE(parseLight(word)) << word;
  EXPECT_THAT(messageOf(parseLight("lamp:1,2,3")), HasSubstr("directional:dx,dy,dz"));
  EXPECT_THAT(messageOf(parseLight("sun:1,2,3")), HasSubstr("sun:dx,dy,dz,DIAMETER_DEG"));
  EXPECT_THAT(messageOf(parseLight("sphere:0,0,5,-1")), HasSubstr("no extent"));
}

TEST(ParseLight, KnowsLightsWithAnExtent) {
  EXPECT_EQ(std::get<scene::DiscLight>(parseLight("disc:0,0,5,0,0,-1,0.5")->shape).radius, 0.5);
  EXPECT_EQ(std::get<scene::RectangleLight>(parseLight("rect:0,0,5,1,0,0,0,-2,0,#ffffff,0.5")->shape).v,
            Vec3(0, -2, 0));
  EXPECT_EQ(std::get<scene::SphereLight>(parseLight("sphere:0,0,5,0.25")->shape).radius, 0.25);
  EXPECT_NEAR(std::get<scene::SunLight>(parseLight("sun:1,0,-1,0.533")->shape).radius.degrees(), 0.2665, 1e-12);
}

TEST(ParseWords, AllowsOnlyWhatIsKnown) {
  EXPECT_THAT(parseWords("volumes,silhouette,volumes", {"volumes", "silhouette"}).value(),
              ElementsAre("volumes", "silhouette"));
  EXPECT_THAT(messageOf(parseWords("volume", {"volumes", "silhouette"})), HasSubstr("volumes, silhouette"));
  EXPECT_FALSE(parseWords("", {"volumes"}));
  EXPECT_EQ(parseUnit("ft").value(), 0.3048);
  EXPECT_FALSE(parseUnit("km"));
  EXPECT_EQ(parseFinder("hextree").value(), shadow::FinderKind::hextree);
  EXPECT_EQ(parseFinder("auto").value(), shadow::FinderKind::automatic);
  EXPECT_THAT(messageOf(parseFinder("octree")), HasSubstr("potentially_visible"));
  EXPECT_EQ(parseUp("y").value(), scene::UpAxis::y);
  EXPECT_FALSE(parseUp("x"));
}

TEST(CompleteGround, GivesEveryGroundItsValue) {
  using Words = std::vector<std::string>;
  EXPECT_EQ(completeGround({"--ground", "-2", "a.obj"}), (Words{"--ground=-2", "a.obj"}));
  EXPECT_EQ(completeGround({"--ground", "0"}), (Words{"--ground=0"}));
  EXPECT_EQ(completeGround({"--ground"}), (Words{"--ground=lowest"}));
  EXPECT_EQ(completeGround({"--ground", "-o", "x.png"}), (Words{"--ground=lowest", "-o", "x.png"}));
  EXPECT_EQ(completeGround({"--ground", "3-20-DELFT.json"}), (Words{"--ground=lowest", "3-20-DELFT.json"}));
  EXPECT_EQ(completeGround({"--ground=-1e1"}), (Words{"--ground=-1e1"}));
  EXPECT_EQ(completeGround({"--ground", "nan"}), (Words{"--ground=nan"}));
  EXPECT_EQ(completeGround({"--ground", "1e999"}), (Words{"--ground=1e999"}));
  EXPECT_EQ(completeGround({"--", "--ground"}), (Words{"--", "--ground"}));
}

}  // namespace
}  // namespace umbrage::cli

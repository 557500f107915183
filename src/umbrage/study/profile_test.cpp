#include "umbrage/study/profile.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/box_scene.hpp"
#include "support/brute_force_technique.hpp"
#include "umbrage/study/sun_light.hpp"

namespace umbrage::study {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr double kHalf = 5.0, kHeight = 10.0;

scene::Scene boxOnGround() {
  return scene::withGround(support::boxScene({{"Box", {-kHalf, -kHalf, 0}, {kHalf, kHalf, kHeight}}}));
}

// Straight down from 100 units: half a unit of ground a pixel, north at the top.
scene::Camera mapCamera() {
  scene::Camera c;
  c.eye = {0, 0, 100};
  c.target = {0, 0, 0};
  c.up = {0, 1, 0};
  c.width = 96;
  c.height = 96;
  c.fovY = Angle::radians(2.0 * std::atan(24.0 / 100.0));
  return c;
}

Vec3 groundAt(int x, int y) { return {0.5 * (x + 0.5) - 24.0, 24.0 - 0.5 * (y + 0.5), 0}; }

ProfileOptions options(const char* from, const char* to, std::chrono::milliseconds step, const char* zone = "solar") {
  return {{*sun::makePlace(48.2, 16.37), *sun::parseZone(zone), *sun::parseDate("2026-09-18"), *sun::parseTime(from),
           *sun::parseTime(to), step},
          mapCamera(),
          {}};
}

// How deep the ray from p runs through the box: below 0 it misses by so much.
double depthInBox(const Vec3& p, const Vec3& towards) {
  double near = 0.0, far = 1e300;
  const Vec3 low(-kHalf, -kHalf, 0), high(kHalf, kHalf, kHeight);
  for (int k = 0; k < 3; ++k) {
    const double a = (low[k] - p[k]) / towards[k], b = (high[k] - p[k]) / towards[k];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return far - near;
}

bool isGround(const Profile& p, int x, int y) {
  const auto& s = p.geometry->surfaces;
  return s.casts[p.surface.triangle(x, y)] == 0;
}

Result<Profile> boxProfile(const ProfileOptions& o) {
  support::BruteForceTechnique technique;
  return profile(boxOnGround(), o, technique);
}

TEST(Profile, CountsTheExactMinutesOfABoxesShadow) {
  const auto p = boxProfile(options("08:00", "16:00", 30min));
  ASSERT_TRUE(p) << p.error().text();
  ASSERT_EQ(p->steps.size(), 17u);
  // The true solar day is at most 30 s longer or shorter than 24 h.
  EXPECT_NEAR(p->sunUpMinutes, 480.0, 0.17);
  int compared = 0, shadowed = 0;
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x) {
      if (!isGround(*p, x, y)) continue;
      double minutes = 0.0;
      bool clear = true;
      for (const auto& step : p->steps) {
        const double depth = depthInBox(groundAt(x, y), towardsSun(step.moment.sun, scene::UpAxis::z));
        clear = clear && std::abs(depth) > 1e-6;
        if (depth > 0) minutes += double(step.moment.share.count()) / 60e3;
      }
      if (!clear) continue;
      EXPECT_NEAR(p->shadowMinutes(x, y), minutes, 1e-3) << x << " " << y;
      EXPECT_NEAR(p->sunMinutes(x, y), p->sunUpMinutes - minutes, 1e-3);
      ++compared;
      shadowed += minutes > 0;
    }
  EXPECT_GT(compared, 8000);
  EXPECT_GT(shadowed, 1000);
}

// Due north of the box at solar noon the shadow ends h / tan(a) from its north wall.
TEST(Profile, TheNoonShadowIsAsLongAsTheTangentSays) {
  const auto p = boxProfile(options("11:00", "13:00", 1h));
  const auto& noon = p->steps[1];
  const double length = kHeight / tan(noon.moment.sun.elevation);
  for (int y = 0; y < 96; ++y) {
    const double beyondWall = groundAt(48, y).y - kHalf;
    if (beyondWall <= 0.01 || !isGround(*p, 48, y)) continue;
    EXPECT_EQ(noon.light(48, y), beyondWall < length ? 0 : 255) << beyondWall << " of " << length;
  }
}

TEST(Profile, KeepsNightStepsAndCountsThemAsNeither) {
  const auto p = boxProfile(options("00:00", "12:00", 4h));
  ASSERT_EQ(p->steps.size(), 4u);
  EXPECT_FALSE(p->steps[0].moment.sunIsUp());
  EXPECT_TRUE(p->steps[0].light.empty());
  EXPECT_TRUE(p->steps[2].moment.sunIsUp());
  EXPECT_NEAR(p->sunUpMinutes, 6 * 60, 0.1);
  EXPECT_NEAR(p->shadowMinutes(0, 0) + p->sunMinutes(0, 0), p->sunUpMinutes, 1e-3);
  EXPECT_THAT(p->ledger[3].text, HasSubstr("2 of them with the sun below"));
}

TEST(Profile, OfANightAloneSeesTheSceneWithoutSun) {
  const auto p = boxProfile(options("00:00", "02:00", 1h));
  ASSERT_TRUE(p);
  EXPECT_EQ(p->surface.triangle.width(), 96);
  EXPECT_EQ(p->sunUpMinutes, 0.0);
  EXPECT_EQ(p->shadowMinutes(50, 50), 0.0f);
}

TEST(Profile, GivesEveryPartMasksOfItsOwn) {
  auto scene = scene::withGround(support::boxScene({{"House/West", {-12, -3, 0}, {-8, 3, 6}},
                                                    {"House/East", {8, -3, 0}, {12, 3, 6}},
                                                    {"Tree", {-1, -1, 0}, {1, 1, 8}}}));
  auto o = options("11:00", "13:00", 1h);
  o.casters = {"West", "East"};
  support::BruteForceTechnique technique;
  const auto p = profile(scene, o, technique);
  ASSERT_TRUE(p) << p.error().text();
  EXPECT_EQ(technique.prepared, 3);
  ASSERT_EQ(p->parts.size(), 2u);
  EXPECT_THAT(p->parts[0].instances, testing::ElementsAre(0u));
  int west = 0, east = 0;
  for (const auto& step : p->steps) {
    ASSERT_EQ(step.parts.size(), 2u);
    for (std::size_t i = 0; i < step.light.size(); ++i) {
      EXPECT_EQ(step.light.pixels()[i], std::min(step.parts[0].pixels()[i], step.parts[1].pixels()[i]));
      west += step.parts[0].pixels()[i] == 0;
      east += step.parts[1].pixels()[i] == 0;
    }
    EXPECT_EQ(step.light(48, 48 - 2 * 4), 255);  // the tree throws no shadow
  }
  EXPECT_GT(west, 0);
  EXPECT_GT(east, 0);
}

TEST(Profile, SaysWhichPartsThereAreWhenAPatternMatchesNone) {
  auto o = options("11:00", "13:00", 1h);
  o.casters = {"Roof*"};
  const auto p = boxProfile(o);
  ASSERT_FALSE(p);
  EXPECT_EQ(p.error().code, ErrorCode::usage);
  EXPECT_THAT(p.error().message, HasSubstr("there are: Box"));
}

TEST(Profile, RefusesMoreMasksThanFit) {
  auto o = options("00:00", "24:00", 1min);
  o.camera.width = o.camera.height = 4000;
  EXPECT_EQ(boxProfile(o).error().code, ErrorCode::usage);
}

TEST(Profile, CanBeCancelledAndReportsEvenProgress) {
  support::BruteForceTechnique technique;
  std::vector<double> seen;
  const auto o = options("08:00", "16:00", 30min);
  ASSERT_TRUE(
      profile(boxOnGround(), o, technique, [&](double f, std::string_view) { return seen.push_back(f), true; }));
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_EQ(seen.back(), 1.0);
  const auto cancelled = profile(boxOnGround(), o, technique, [](double f, std::string_view) { return f < 0.4; });
  EXPECT_EQ(cancelled.error().code, ErrorCode::cancelled);
}

TEST(Profile, StatesItsConventions) {
  const auto p = boxProfile(options("11:00", "13:00", 1h, "Europe/Vienna"));
  std::string all;
  for (const auto& line : p->ledger) all += line.subject + ": " + line.text + "\n";
  for (const char* needed :
       {"48.2000 N, 16.3700 E", "2026-09-18", "Europe/Vienna, UTC+02:00 (CEST)", "11:00 to 13:00, every 60 min",
        "no refraction", "centre", "declination moving", "true north is +Y", "= 1 m", "Umbrage ", "brute_force"})
    EXPECT_THAT(all, HasSubstr(needed));
}

TEST(SunLight, PointsFromTheSunInEveryFrame) {
  const sun::SunPosition southEast{Angle::degrees(30), Angle::degrees(135)};
  const Vec3 z = towardsSun(southEast, scene::UpAxis::z);
  EXPECT_NEAR(z.x, -z.y, 1e-12);
  EXPECT_NEAR(z.z, 0.5, 1e-12);
  const Vec3 y = towardsSun(southEast, scene::UpAxis::y);
  EXPECT_NEAR(glm::length(y - Vec3(z.x, z.z, -z.y)), 0, 1e-12);
  const Vec3 turned = towardsSun({{}, Angle::degrees(0)}, scene::UpAxis::z, Angle::degrees(90));
  EXPECT_NEAR(turned.x, 1, 1e-12);
}

}  // namespace
}  // namespace umbrage::study

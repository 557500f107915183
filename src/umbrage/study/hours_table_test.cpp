#include "umbrage/study/hours_table.hpp"

#include <gtest/gtest.h>

namespace umbrage::study {
namespace {

using namespace std::chrono_literals;

const sun::Place kVienna{Angle::degrees(48.2), Angle::degrees(16.37)};
constexpr double kFar = 1e5;

mesh::Mesh sheet(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  mesh::Mesh m;
  m.positions = {a, b, c, d};
  m.triangles = {{0, 1, 2}, {0, 2, 3}};
  return m;
}
// From south to north, as good as endless: it hides the sun from the origin while the sun is in the east.
mesh::Mesh easternPane() { return sheet({1, -kFar, -1}, {1, kFar, -1}, {1, kFar, kFar}, {1, -kFar, kFar}); }
// From west to east: while the sun is in the south.
mesh::Mesh southernPane() { return sheet({-kFar, -1, -1}, {kFar, -1, -1}, {kFar, -1, kFar}, {-kFar, -1, kFar}); }

struct Part {
  mesh::Mesh mesh;
  double opacity;
};
scene::Scene sceneOf(std::vector<Part> parts) {
  scene::Scene scene;
  scene.up = scene::UpAxis::z;
  for (Part& part : parts) {
    const auto index = static_cast<std::uint32_t>(scene.meshes.size());
    part.mesh.materials.assign(part.mesh.triangles.size(), index);
    scene.materials.push_back({"m", Vec3(0.5), part.opacity});
    scene.meshes.push_back(std::make_shared<const mesh::Mesh>(std::move(part.mesh)));
    scene.instances.push_back({"part" + std::to_string(index), index, Mat4(1.0), true});
  }
  return scene;
}

HoursRequest requestOf(Transparent transparent) {
  HoursRequest request;
  request.place = kVienna;
  request.zone = *sun::parseZone("solar");
  request.date = 2026y / std::chrono::September / 18;
  request.transparent = transparent;
  return request;
}

double hoursAtOrigin(const scene::Scene& scene, const HoursRequest& request) {
  ReceiverSet set;
  set.receivers = {{Vec3(0.0), Vec3(0.0)}};
  const auto table = sunHours(scene, std::move(set), request);
  EXPECT_TRUE(table);
  return table ? table->hours.at(0) : -1.0;
}

// Hours of the day in which the sun is up and `holds`, from the sun's place alone: looked at every five minutes, changes narrowed down.
template <class Fn>
double hoursWhile(const HoursRequest& request, Fn&& holds) {
  const auto midnight = sun::instantOf(request.zone, request.place, {request.date, 0ms});
  EXPECT_TRUE(midnight);
  const auto at = [&](sun::Instant t) {
    const auto sun = sun::sunPosition(request.place, t);
    return sun.elevation.degrees() > 0.0 && holds(sun.azimuth.degrees());
  };
  std::chrono::milliseconds sum = 0ms;
  bool before = at(midnight->instant);
  for (sun::Instant t = midnight->instant; t < midnight->instant + 24h; t += 5min) {
    const bool after = at(t + 5min);
    sun::Instant low = t, high = t + 5min;
    while (before != after && high - low > 10ms)
      (at(low + (high - low) / 2) == before ? low : high) = low + (high - low) / 2;
    sum += before == after ? (before ? 5min : 0min) : before ? low - t : t + 5min - low;
    before = after;
  }
  return double(sum.count()) / 3.6e6;
}
bool inTheEast(double azimuth) { return azimuth > 0.0 && azimuth < 180.0; }
bool inTheSouth(double azimuth) { return azimuth > 90.0 && azimuth < 270.0; }

constexpr double kSeconds = 2.0 / 3600.0;  // panes end 100 km away, and a stretch may be 0.1 s off

TEST(HoursTable, anHourBehindAPaneCountsWhatItLetsThrough) {
  const auto scene = sceneOf({{easternPane(), 0.3}});
  const auto request = requestOf(Transparent::weighted);
  const double morning = hoursWhile(request, inTheEast),
               afternoon = hoursWhile(request, [](double a) { return !inTheEast(a); });
  EXPECT_NEAR(morning, 6.13, 0.02);
  EXPECT_NEAR(hoursAtOrigin(scene, request), 0.7 * morning + afternoon, kSeconds);
  EXPECT_NEAR(hoursAtOrigin(scene, requestOf(Transparent::opaque)), afternoon, kSeconds);
  EXPECT_NEAR(hoursAtOrigin(scene, requestOf(Transparent::ignored)), morning + afternoon, kSeconds);
}

TEST(HoursTable, panesBehindEachOtherMultiplyAndEachPartCountsOnce) {
  mesh::Mesh two = easternPane();  // one part of two sheets, 1 and 2 m away
  for (int i = 0; i < 4; ++i) two.positions.push_back(two.positions[std::size_t(i)] + Vec3(1, 0, 0));
  two.triangles.push_back({4, 5, 6});
  two.triangles.push_back({4, 6, 7});
  const auto scene = sceneOf({{two, 0.3}, {southernPane(), 0.5}});
  const auto request = requestOf(Transparent::weighted);
  const auto part = [&](bool east, bool south) {
    return hoursWhile(request, [&](double a) { return inTheEast(a) == east && inTheSouth(a) == south; });
  };
  const double expected =
      0.7 * 0.5 * part(true, true) + 0.7 * part(true, false) + 0.5 * part(false, true) + part(false, false);
  EXPECT_NEAR(hoursAtOrigin(scene, request), expected, kSeconds);
}

TEST(HoursTable, whatIsOpaqueHidesTheSunWithPanesToo) {
  const auto scene = sceneOf({{easternPane(), 1.0}, {southernPane(), 0.25}});
  const auto request = requestOf(Transparent::weighted);
  const double behind = hoursWhile(request, [](double a) { return !inTheEast(a) && inTheSouth(a); }),
               open = hoursWhile(request, [](double a) { return !inTheEast(a) && !inTheSouth(a); });
  EXPECT_NEAR(hoursAtOrigin(scene, request), 0.75 * behind + open, kSeconds);
}

TEST(HoursTable, samplesAreWeightedAsWell) {
  const auto scene = sceneOf({{easternPane(), 0.3}});
  auto request = requestOf(Transparent::weighted);
  const double exact = hoursAtOrigin(scene, request);
  request.sampled = 1min;
  EXPECT_NEAR(hoursAtOrigin(scene, request), exact, 3.0 / 60.0);
}

TEST(HoursTable, aPolarDayGoesFromMidnightToMidnight) {
  HoursRequest request = requestOf(Transparent::opaque);
  request.date = 2026y / std::chrono::June / 21;
  for (const double latitude : {70.0, 80.0, 90.0})
    for (const double longitude : {-75.3, 0.0, 15.6}) {
      request.place = {Angle::degrees(latitude), Angle::degrees(longitude)};
      ReceiverSet set;
      set.receivers = {{Vec3(0.0), Vec3(0.0)}};
      const auto table = sunHours(sceneOf({}), std::move(set), request);
      ASSERT_TRUE(table);
      EXPECT_EQ(stretchesText(*table, 0), "00:00:00-24:00:00") << latitude << ' ' << longitude;
    }
}

}  // namespace
}  // namespace umbrage::study

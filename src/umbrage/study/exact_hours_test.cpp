#include "umbrage/study/exact_hours.hpp"

#include <gtest/gtest.h>

namespace umbrage::study {
namespace {

sun::Instant utc(int year, unsigned month, unsigned day, int hour) {
  return std::chrono::sys_days(std::chrono::year(year) / std::chrono::month(month) / std::chrono::day(day)) +
         std::chrono::hours(hour);
}

// A square court, 30 m wide within, with walls 20 m high; the middle of the foot of the wall to the north, facing the court.
TEST(ExactHours, courtyard) {
  const sun::Place place{Angle::degrees(48.2), Angle::degrees(16.37)};
  mesh::Mesh m;
  for (const double z : {0.0, 20.0})
    for (const Vec2& c : {Vec2(-15, -15), Vec2(15, -15), Vec2(15, 15), Vec2(-15, 15)})
      m.positions.push_back({c.x, c.y, z});
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t k = (i + 1) % 4;
    m.triangles.push_back({i, k, k + 4});
    m.triangles.push_back({i, k + 4, i + 4});
  }
  scene::Scene s;
  s.materials.push_back({});
  s.meshes.push_back(std::make_shared<const mesh::Mesh>(std::move(m)));
  s.instances.push_back({"walls", 0});
  const auto hours = ExactHours::build(s, place);
  ASSERT_TRUE(hours);
  const auto course = SunCourse::make(place, {utc(2026, 9, 17, 22), utc(2026, 9, 18, 22)});
  const Receiver foot{{0, 15, 0}, {0, -1, 0}};
  const auto lit = hours->at({&foot, 1}, course);
  ASSERT_TRUE(lit);
  EXPECT_NEAR(double(lit->total(0).count()) / 1000.0, 3.65829 * 3600.0,
              1.0);  // counted second by second against the opening
}

}  // namespace
}  // namespace umbrage::study

#include "umbrage/outline/isochrones.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "umbrage/outline/test_prisms.hpp"
#include "umbrage/sun/zone.hpp"

namespace umbrage::outline {
namespace {

using std::chrono::milliseconds;
constexpr milliseconds kHour{3'600'000};

scene::Scene sceneOf(const std::vector<CasterPart>& parts) {
  scene::Scene scene;
  scene.materials.emplace_back();
  for (const CasterPart& part : parts) {
    auto mesh = std::make_shared<mesh::Mesh>();
    mesh->positions = part.points;
    mesh->triangles = part.triangles;
    scene.instances.push_back({part.name, static_cast<std::uint32_t>(scene.meshes.size()), Mat4(1.0), true});
    scene.meshes.push_back(std::move(mesh));
  }
  return scene;
}

struct Study {
  scene::Scene scene;
  study::ExactHours hours;
  study::SunCourse course;
};
Study studyOf(scene::Scene scene) {
  const auto place = sun::makePlace(48.2, 16.37);
  const auto day = std::chrono::sys_days(std::chrono::year(2026) / 9 / 18);
  auto hours = study::ExactHours::build(scene, *place);
  return {std::move(scene), std::move(*hours), study::SunCourse::make(*place, {day, day + std::chrono::hours(24)})};
}

double distanceTo(const Region& region, const Vec2& p) {
  double nearest = 1e300;
  const auto look = [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = ring[i], ab = ring[(i + 1) % ring.size()] - a;
      const double t = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0, 1.0);
      nearest = std::min(nearest, glm::length(p - a - t * ab));
    }
  };
  for (const Polygon& polygon : region.polygons) {
    look(polygon.outer);
    for (const Ring& hole : polygon.holes) look(hole);
  }
  return nearest;
}

// scripts/sweep isochrones asks for more.
std::size_t manyPoints() {
  const char* asked = std::getenv("UMBRAGE_SWEEP_POINTS");
  return asked != nullptr ? std::strtoul(asked, nullptr, 10) : 2000;
}

// Law 2, at points of its own.
void expectTrue(const Study& study, const Isochrones& map, const IsochroneOptions& options, std::size_t points) {
  std::mt19937_64 random(77);
  std::uniform_real_distribution<double> x(map.min.x, map.max.x), y(map.min.y, map.max.y);
  std::vector<study::Receiver> receivers;
  for (std::size_t n = 0; n < points; ++n) {
    const double east = x(random);
    receivers.push_back({Vec3(east, y(random), options.height), Vec3(0, 0, 1)});
  }
  const auto lit = study.hours.at(receivers, study.course);
  ASSERT_TRUE(lit);
  for (std::size_t level = 0; level < options.levels.size(); ++level) {
    std::size_t inside = 0;
    for (std::size_t n = 0; n < points; ++n) {
      const auto sunny = lit->total(n);
      const auto value = options.of == HoursOf::sun ? sunny : study.course.upTime() - sunny;
      const Vec2 p(receivers[n].position);
      const bool in = holds(map.regions[level], p);
      inside += in ? 1 : 0;
      if (in == (value >= options.levels[level])) continue;
      EXPECT_LE(distanceTo(map.regions[level], p), options.tolerance) << p.x << " " << p.y << " level " << level;
    }
    EXPECT_GT(inside, 0U);
  }
}

TEST(Isochrones, ofACourtAndATower) {
  const Study study = studyOf(
      sceneOf({prism("s", rectangle({-10, -10}, 50, 10), 0, 20), prism("n", rectangle({-10, 30}, 50, 10), 0, 20),
               prism("w", rectangle({-10, 0}, 10, 30), 0, 20), prism("e", rectangle({30, 0}, 10, 30), 0, 20),
               prism("tower", polygon(7, 6.0, {70, 10}), 0, 45)}));
  for (const HoursOf of : {HoursOf::sun, HoursOf::shadow}) {
    IsochroneOptions options{of, {kHour, 3 * kHour, 5 * kHour}, 0.0, 1.0, 2000};
    const auto map = isochrones(study.scene, study.hours, study.course, options);
    ASSERT_TRUE(map) << map.error().text();
    EXPECT_EQ(map->wrong, 0U);
    EXPECT_FALSE(map->cutOff);
    for (std::size_t level = 1; level < 3; ++level) EXPECT_LT(map->regions[level].area, map->regions[level - 1].area);
    expectTrue(study, *map, options, manyPoints());
  }
}

TEST(Isochrones, finerIsNearer) {
  const Study study = studyOf(sceneOf({prism("box", rectangle({0, 0}, 10, 10), 0, 10)}));
  double before = 0.0;
  for (const double tolerance : {0.8, 0.4, 0.1}) {
    const auto map =
        isochrones(study.scene, study.hours, study.course, {HoursOf::shadow, {2 * kHour}, 0.0, tolerance, 500});
    ASSERT_TRUE(map);
    const double area = map->regions[0].area;
    if (before > 0.0) {
      EXPECT_NEAR(area / before, 1.0, 0.01);
    }
    before = area;
  }
}

TEST(Isochrones, refusals) {
  const Study nothing = studyOf(scene::Scene{});
  EXPECT_EQ(isochrones(nothing.scene, nothing.hours, nothing.course, {HoursOf::sun, {kHour}}).error().code,
            ErrorCode::input);
  const Study box = studyOf(sceneOf({prism("box", rectangle({0, 0}, 1000, 1000), 0, 1000)}));
  EXPECT_EQ(isochrones(box.scene, box.hours, box.course, {HoursOf::sun, {kHour}, 0.0, 1e-3}).error().code,
            ErrorCode::usage);
  int calls = 0;
  const auto stopped = isochrones(box.scene, box.hours, box.course, {HoursOf::sun, {kHour}, 0.0, 20.0},
                                  [&](double, std::string_view) { return ++calls < 2; });
  EXPECT_TRUE(calls < 2 || stopped.error().code == ErrorCode::cancelled);
}

}  // namespace
}  // namespace umbrage::outline

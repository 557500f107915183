#include "umbrage/study/exact_hours.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "hours/scenes.hpp"
#include "umbrage/sun/sun_path.hpp"

namespace umbrage::study {
namespace {

using namespace std::chrono_literals;
using hours_tests::sceneOf;
using std::chrono::milliseconds;

const sun::Place kVienna{Angle::degrees(48.2), Angle::degrees(16.37)};

sun::Instant utc(std::chrono::year_month_day date) { return std::chrono::sys_days(date); }
SunCourse dayOf(std::chrono::year_month_day date, const sun::Place& place = kVienna, const SunModel& model = {}) {
  return SunCourse::make(place, {utc(date), utc(date) + 24h}, model);
}
double seconds(milliseconds t) { return double(t.count()) / 1000.0; }

SunHours hoursAt(const scene::Scene& s, const std::vector<Receiver>& receivers, const SunCourse& course,
                 const ExactHoursOptions& options = {}) {
  const auto built = ExactHours::build(s, course.place(), options);
  EXPECT_TRUE(built);
  auto hours = built->at(receivers, course);
  EXPECT_TRUE(hours);
  return std::move(*hours);
}

// Walls without thickness around a square court of 30 m, 20 m high.
mesh::Mesh court() {
  mesh::Mesh m;
  for (const double z : {0.0, 20.0})
    for (const Vec2& c : {Vec2(-15, -15), Vec2(15, -15), Vec2(15, 15), Vec2(-15, 15)})
      m.positions.push_back({c.x, c.y, z});
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t k = (i + 1) % 4;
    m.triangles.push_back({i, k, k + 4});
    m.triangles.push_back({i, k + 4, i + 4});
  }
  return m;
}

TEST(ExactHours, courtyard) {
  // The middle of the foot of the wall to the north. By counting seconds against the court's opening: 3.6583 h at the very foot,
  // 3.6661 h five centimetres above it.
  const SunCourse course = dayOf(2026y / std::chrono::September / 18);
  const SunHours lit = hoursAt(sceneOf(court()), {{{0, 15, 0}, {0, -1, 0}}, {{0, 15, 0.05}, {0, -1, 0}}}, course);
  EXPECT_NEAR(seconds(lit.total(0)), 3.6583 * 3600, 1.0);
  EXPECT_NEAR(seconds(lit.total(1)), 3.6661 * 3600, 1.0);
  EXPECT_EQ(lit.lit(0).size(), 1u);
  EXPECT_EQ(lit.longest(0), lit.total(0));
}

TEST(ExactHours, agreesWithARayEverySecond) {
  unsigned seed = 1;
  for (const auto& named : hours_tests::sceneKinds(6)) {
    const hours_tests::Rays rays(named.scene);
    hours_tests::Random random(seed++);
    const auto all = hours_tests::placed(rays, 10, random);
    std::vector<Receiver> receivers;
    for (const auto& p : all) receivers.push_back(p.receiver);
    const SunCourse course = dayOf(2026y / std::chrono::March / 20);
    const SunHours lit = hoursAt(named.scene, receivers, course);
    for (std::size_t i = 0; i < all.size(); ++i)
      EXPECT_EQ(hours_tests::disagreements(rays, all[i], lit.lit(i), course), 0) << named.name << ' ' << i;
  }
}

void expectSame(const SunHours& a, const SunHours& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(seconds(a.total(i)), seconds(b.total(i)), tolerance) << i;
}

TEST(ExactHours, sameWithAndWithoutWideLanesAndInAnyNumberOfThreads) {
  hours_tests::Random random(5);
  for (const auto& named : hours_tests::sceneKinds(6)) {
    const hours_tests::Rays rays(named.scene);
    std::vector<Receiver> receivers;
    for (const auto& p : hours_tests::placed(rays, 2000, random)) receivers.push_back(p.receiver);
    const SunCourse course = dayOf(2026y / std::chrono::May / 2);
    const SunHours wide = hoursAt(named.scene, receivers, course, {.threads = 1});
    expectSame(wide, hoursAt(named.scene, receivers, course, {.threads = 1, .wide = false}), 0.5);
    const SunHours threads = hoursAt(named.scene, receivers, course, {.threads = 3});
    for (std::size_t i = 0; i < receivers.size(); ++i)
      EXPECT_TRUE(std::ranges::equal(wide.lit(i), threads.lit(i))) << named.name << ' ' << i;
  }
}

TEST(ExactHours, centimetresFromACornerFarFromTheOrigin) {
  // Half a unit in the last place of a coordinate is 0.03 mm here: seen from a centimetre's distance the sun takes 40 s for that.
  mesh::Mesh m;
  hours_tests::addBox(m, {0, 0}, {3, 5}, 0.28, -0.5, 12);
  hours_tests::addBox(m, {-1960, 1840}, {4, 4}, 0.1, -0.5, 12);  // so that the origin is far from both
  const scene::Scene two = sceneOf(std::move(m));
  const hours_tests::Rays rays(two);
  hours_tests::Random random(17);
  std::vector<hours_tests::Placed> all;
  std::vector<Receiver> receivers;
  const auto add = [&](const Vec3& position) {
    const hours_tests::Placed p{{position, {0, 0, 1}}};
    if (rays.meets(position, {0, 0, 1}, 0xffffffffu)) return;
    all.push_back(p), receivers.push_back(p.receiver);
  };
  const Vec3 along(std::cos(0.28), std::sin(0.28), 0), across(-along.y, along.x, 0);
  for (int i = 0; i < 60; ++i) {
    const Vec3 at = two.meshes[0]->positions[static_cast<std::size_t>(i % 4)], corner(at.x, at.y, 0.01);
    add(corner + Vec3(hours_tests::uniform(random, -0.03, 0.03), hours_tests::uniform(random, -0.03, 0.03), 0));
    // Before the wall by less than what counts as touching it.
    const double x = i % 2 == 0 ? -1 : 1, y = i % 4 < 2 ? -1 : 1;
    add(corner + x * hours_tests::uniform(random, 2e-5, 4e-4) * along -
        y * hours_tests::uniform(random, 0.01, 0.2) * across);
    add(corner + y * hours_tests::uniform(random, 2e-5, 4e-4) * across -
        x * hours_tests::uniform(random, 0.01, 0.2) * along);
  }
  EXPECT_GT(all.size(), 100u);
  for (const bool wide : {true, false}) {
    const SunCourse course = dayOf(2026y / std::chrono::July / 22);
    const SunHours lit = hoursAt(two, receivers, course, {.wide = wide});
    for (std::size_t i = 0; i < all.size(); ++i)
      EXPECT_EQ(hours_tests::disagreements(rays, all[i], lit.lit(i), course), 0) << wide << ' ' << i;
  }
}

// An L, two arms of 10 m by 30 m, 12 m high; closed, and not convex.
mesh::Mesh angle() {
  mesh::Mesh m;
  const Vec2 outline[] = {{0, 0}, {30, 0}, {30, 10}, {10, 10}, {10, 30}, {0, 30}};
  for (const double z : {0.0, 12.0})
    for (const Vec2& c : outline) m.positions.push_back({c.x, c.y, z});
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t k = (i + 1) % 6;
    m.triangles.push_back({i, k, k + 6});
    m.triangles.push_back({i, k + 6, i + 6});
  }
  const mesh::Triangle floor[] = {{0, 3, 1}, {1, 3, 2}, {0, 5, 3}, {3, 5, 4}};
  for (const mesh::Triangle& t : floor) {
    m.triangles.push_back(t);
    m.triangles.push_back({t[0] + 6, t[2] + 6, t[1] + 6});
  }
  return m;
}

TEST(ExactHours, insideAndOutsideOfASolidThatIsNotConvex) {
  const scene::Scene s = sceneOf(angle());
  const hours_tests::Rays rays(s);
  hours_tests::Random random(19);
  const SunCourse course = dayOf(2026y / std::chrono::June / 21);
  std::vector<hours_tests::Placed> all;
  std::vector<Receiver> receivers;
  for (int i = 0; i < 60; ++i) {
    hours_tests::Placed p;
    p.receiver.position = {hours_tests::uniform(random, 0.5, 29.5), hours_tests::uniform(random, 0.5, 29.5), 0.5};
    if (i % 2 == 0) p.receiver.normal = {0, 0, 1};
    all.push_back(p), receivers.push_back(p.receiver);
  }
  const SunHours lit = hoursAt(s, receivers, course);
  int inside = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Vec3& p = receivers[i].position;
    EXPECT_EQ(hours_tests::disagreements(rays, all[i], lit.lit(i), course), 0) << i;
    if (p.x > 10 && p.y > 10) continue;
    ++inside;
    EXPECT_EQ(lit.total(i), 0ms) << i;
  }
  EXPECT_GT(inside, 10);
  EXPECT_LT(inside, 50);
}

TEST(ExactHours, manyStretchesAreAllKept) {
  // A fence of 300 posts, 5 cm wide, every 20 cm, to the south.
  mesh::Mesh m;
  for (int i = 0; i < 300; ++i) hours_tests::addBox(m, {-30 + 0.2 * i, -2}, {0.025, 0.01}, 0, -1, 50);
  const scene::Scene fence = sceneOf(std::move(m));
  const SunCourse course = dayOf(2026y / std::chrono::March / 20);
  const hours_tests::Rays rays(fence);
  const hours_tests::Placed eye{{{0.03, 0, 0}, {0, 0, 1}}};
  const SunHours lit = hoursAt(fence, {eye.receiver}, course);
  EXPECT_GT(lit.lit(0).size(), 100u);
  EXPECT_EQ(hours_tests::disagreements(rays, eye, lit.lit(0), course), 0);
}

TEST(ExactHours, surfacesThatTouchTheReceiver) {
  // A box to the height of 10 m, from -5 to 5.
  mesh::Mesh m;
  hours_tests::addBox(m, {0, 0}, {5, 5}, 0, 0, 10);
  const scene::Scene box = sceneOf(std::move(m));
  const SunCourse course = dayOf(2026y / std::chrono::March / 20);
  const SunHours free = hoursAt(sceneOf({}), {{{0, 0, 0}, {0, 0, 1}}, {{0, 0, 0}, {0, -1, 0}}}, course);
  EXPECT_EQ(free.total(0), course.upTime());
  const SunHours lit = hoursAt(box,
                               {{{1, 2, 10}, {0, 0, 1}},   // on the roof
                                {{-5, 2, 10}, {0, 0, 1}},  // on its edge
                                {{5, -5, 10}, {0, 0, 1}},  // at its corner
                                {{1, -5, 4}, {0, -1, 0}},  // on the wall to the south
                                {{5, -5, 4}, {0, -1, 0}},  // on its edge
                                {{0, 0, 5}, {}},           // inside
                                {{0, 0, 5}, {0, -1, 0}}},  // inside
                               course);
  for (const std::size_t i : {0u, 1u, 2u}) EXPECT_NEAR(seconds(lit.total(i)), seconds(free.total(0)), 1.0) << i;
  for (const std::size_t i : {3u, 4u}) EXPECT_NEAR(seconds(lit.total(i)), seconds(free.total(1)), 1.0) << i;
  EXPECT_EQ(lit.total(5), 0ms);
  EXPECT_EQ(lit.total(6), 0ms);
}

TEST(ExactHours, atTheFootOfAClosedWallFacingUp) {
  // The wall hides what is behind it, as just before it, whichever wall it is and whatever rounding makes of where the point lies.
  for (const double turn : {0.0, 0.3}) {
    mesh::Mesh m;
    hours_tests::addBox(m, {0, 0}, {5, 5}, turn, 0, 10);
    const scene::Scene box = sceneOf(m);
    const SunCourse course = dayOf(2026y / std::chrono::June / 21);
    for (const int corner : {0, 1, 2, 3}) {
      constexpr int kNext[] = {1, 3, 0, 2};
      const Vec3 a = m.positions[static_cast<std::size_t>(corner)],
                 b = m.positions[static_cast<std::size_t>(kNext[corner])];
      const Vec3 out = glm::normalize(glm::cross(b - a, Vec3(0, 0, 1)));
      std::vector<Receiver> at, before;
      for (int i = 1; i < 8; ++i) {
        const Vec3 foot = a + (b - a) * (i / 8.0) + Vec3(0, 0, 1);
        at.push_back({foot, {0, 0, 1}}), before.push_back({foot + 2e-5 * out, {0, 0, 1}});
      }
      expectSame(hoursAt(box, at, course), hoursAt(box, before, course), 1.0);
      for (const Receiver& alone : at)
        expectSame(hoursAt(box, {alone}, course), hoursAt(box, {{alone.position + 2e-5 * out, {0, 0, 1}}}, course),
                   1.0);
    }
  }
}

TEST(ExactHours, onRidgesAndCorners) {
  // A house with a gable roof, turned: nothing hides the sky from its ridge, and nothing from its corners that face up.
  for (const double turn : {0.0, 0.3, 1.1}) {
    mesh::Mesh m;
    const auto at = [&](double x, double y, double z) {
      m.positions.push_back(
          {0.1 + std::cos(turn) * x - std::sin(turn) * y, std::sin(turn) * x + std::cos(turn) * y, z});
    };
    for (const double y : {-6.0, 6.0}) at(-4, y, 0), at(4, y, 0), at(4, y, 5), at(0, y, 9), at(-4, y, 5);
    m.triangles = {{0, 1, 2}, {0, 2, 4}, {4, 2, 3}, {5, 7, 6}, {5, 9, 7}, {9, 8, 7}, {0, 5, 1}, {1, 5, 6},
                   {1, 6, 2}, {2, 6, 7}, {0, 4, 5}, {4, 9, 5}, {2, 7, 3}, {3, 7, 8}, {4, 3, 8}, {4, 8, 9}};
    std::vector<Receiver> ridge{{m.positions[3], {0, 0, 1}}, {m.positions[8], {0, 0, 1}}};
    for (int i = 1; i < 12; ++i)
      ridge.push_back({m.positions[3] + (m.positions[8] - m.positions[3]) * (i / 12.0), {0, 0, 1}});
    const SunCourse course = dayOf(2026y / std::chrono::June / 21);
    const SunHours lit = hoursAt(sceneOf(m), ridge, course);
    for (std::size_t i = 0; i < ridge.size(); ++i)
      EXPECT_NEAR(seconds(lit.total(i)), seconds(course.upTime()), 1.0) << i;
  }
}

TEST(ExactHours, inASharpValley) {
  // A wall to the north with a groove of 77 degrees along it; at the groove's bottom, as just before it. The way from there to a sun in the south leads
  // through the wall and meets neither of the groove's faces.
  for (const double turn : {0.0, 0.4, -0.7}) {
    const Vec3 along(std::cos(turn), std::sin(turn), 0), north(-along.y, along.x, 0), up(0, 0, 1);
    mesh::Mesh m;
    const Vec2 profile[] = {{6, 0}, {14, 0}, {14, 6}, {10.1, 1}, {6, 6}};  // height, north
    for (const double side : {-6.0, 6.0})
      for (const Vec2& p : profile) m.positions.push_back(side * along + p.y * north + p.x * up);
    m.triangles = {{0, 1, 3}, {1, 2, 3}, {0, 3, 4}, {5, 8, 6}, {6, 8, 7}, {5, 9, 8}};
    for (std::uint32_t i = 0; i < 5; ++i) {
      const std::uint32_t k = (i + 1) % 5;
      m.triangles.push_back({i, i + 5, k});
      m.triangles.push_back({k, i + 5, k + 5});
    }
    std::vector<Receiver> at, before;
    for (int i = 1; i < 12; ++i) {
      const Vec3 p = m.positions[3] + (m.positions[8] - m.positions[3]) * (i / 12.0);
      for (const Vec3& normal : {Vec3(0.0), north + 0.4 * up, along})
        at.push_back({p, normal}), before.push_back({p + 1e-5 * north, normal});
    }
    for (const auto date : {2026y / std::chrono::June / 21, 2026y / std::chrono::December / 21})
      expectSame(hoursAt(sceneOf(m), at, dayOf(date)), hoursAt(sceneOf(m), before, dayOf(date)), 2.0);
  }
}

TEST(ExactHours, onTheCornersOfASmoothSolid) {
  // As just before them.
  const mesh::Mesh m = hours_tests::ring(20, 6, 25, 60, 24);
  std::vector<Vec3> normals(m.positions.size(), Vec3(0.0));
  for (const mesh::Triangle& t : m.triangles)
    for (const std::uint32_t c : t)
      normals[c] +=
          glm::normalize(glm::cross(m.positions[t[1]] - m.positions[t[0]], m.positions[t[2]] - m.positions[t[0]]));
  const scene::Surfaces flat = scene::flatten(sceneOf(m));
  std::vector<Receiver> at, before;
  for (std::size_t i = 0; i < m.positions.size(); i += 7) {
    const Vec3 n = glm::normalize(normals[i]);
    // Outwards, whichever way the mesh is wound.
    const Vec3 centre(0, 0, 25), way = m.positions[i] - centre;
    const Vec3 flatWay = way - glm::dot(way, Vec3(0, -0.8, 0.6)) * Vec3(0, -0.8, 0.6);
    const Vec3 out = glm::dot(m.positions[i] - centre - 20.0 * glm::normalize(flatWay), n) < 0.0 ? -n : n;
    at.push_back({m.positions[i], out}), before.push_back({m.positions[i] + 1e-4 * out, out});
  }
  const SunCourse course = dayOf(2026y / std::chrono::September / 18);
  const SunHours on = hoursAt(sceneOf(m), at, course), off = hoursAt(sceneOf(m), before, course);
  for (std::size_t i = 0; i < at.size(); ++i) EXPECT_NEAR(seconds(on.total(i)), seconds(off.total(i)), 60.0) << i;
}

TEST(ExactHours, aSlopeHidesWhatIsBehindItWhateverTheNormalSays) {
  // A plane that falls to the north at 45 degrees; the receiver on it, once with the slope's normal and once upright.
  mesh::Mesh m;
  m.positions = {{-1000, -1000, 1000}, {1000, -1000, 1000}, {1000, 1000, -1000}, {-1000, 1000, -1000}};
  m.triangles = {{0, 1, 2}, {0, 2, 3}};
  const SunCourse course = dayOf(2026y / std::chrono::March / 20);
  const SunHours lit = hoursAt(sceneOf(std::move(m)), {{{3, 10, -10}, {0, 1, 1}}, {{3, 10, -10}, {0, 0, 1}}}, course);
  const SunHours free = hoursAt(sceneOf({}), {{{3, 10, -10}, {0, 1, 1}}}, course);
  EXPECT_NEAR(seconds(lit.total(0)), seconds(free.total(0)), 1.0);
  EXPECT_NEAR(seconds(lit.total(1)), seconds(free.total(0)), 1.0);
}

TEST(ExactHours, farFromTheOrigin) {
  hours_tests::Random random(11);
  scene::Scene here = sceneOf(hours_tests::boxes(4, 22, random));
  const hours_tests::Rays rays(here);
  std::vector<Receiver> receivers;
  for (const auto& p : hours_tests::placed(rays, 200, random)) receivers.push_back(p.receiver);
  const SunCourse course = dayOf(2026y / std::chrono::June / 21);
  const SunHours near = hoursAt(here, receivers, course);
  const Vec3 far(4.5e6, 5.2e6, 300);
  here.instances[0].toWorld = Mat4(1.0);
  here.instances[0].toWorld[3] = Vec4(far, 1.0);
  for (Receiver& r : receivers) r.position += far;
  expectSame(near, hoursAt(here, receivers, course), 5.0);  // corners are rounded anew about another origin
}

TEST(ExactHours, polarDaysAndNights) {
  const sun::Place north{Angle::degrees(78.2), Angle::degrees(15.6)};
  const SunCourse day = dayOf(2026y / std::chrono::June / 21, north),
                  night = dayOf(2026y / std::chrono::December / 21, north);
  EXPECT_EQ(day.upTime(), 24h);
  EXPECT_TRUE(night.up().empty());
  const SunHours lit = hoursAt(sceneOf(court()), {{{0, 0, 19}, {0, 0, 1}}, {{25, 25, 0}, {0, 0, 1}}}, day);
  EXPECT_EQ(lit.total(0), 24h);
  EXPECT_LT(lit.total(1), 24h);
  EXPECT_EQ(hoursAt(sceneOf(court()), {{{0, 0, 19}, {0, 0, 1}}}, night).total(0), 0ms);
}

TEST(ExactHours, wholeDayInShadeAndNoReceivers) {
  mesh::Mesh m;
  hours_tests::addBox(m, {0, 0}, {50, 50}, 0, 5, 6);
  const SunCourse course = dayOf(2026y / std::chrono::December / 21);
  EXPECT_EQ(hoursAt(sceneOf(court()), {}, course).size(), 0u);
  EXPECT_LT(hoursAt(sceneOf(std::move(m)), {{{0, 30, 4.9}, {0, 0, 1}}}, course).total(0), course.upTime());
}

TEST(ExactHours, stopsWhenAsked) {
  const auto built = ExactHours::build(sceneOf(court()), kVienna);
  const std::vector<Receiver> receivers(5000, {{0, 0, 1}, {0, 0, 1}});
  const auto stopped =
      built->at(receivers, dayOf(2026y / std::chrono::March / 20), [](double, std::string_view) { return false; });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::cancelled);
}

TEST(SunHours, runs) {
  const sun::Instant t{};
  const SunHours hours({0, 3, 3}, {{t, t + 30min}, {t + 1h, t + 3h}, {t + 4h, t + 5h}});
  EXPECT_EQ(hours.total(0), 3h + 30min);
  EXPECT_EQ(hours.longest(0), 2h);
  EXPECT_EQ(hours.runs(0, 60min).count, 2u);
  EXPECT_EQ(hours.runs(0, 60min).total, 3h);
  EXPECT_EQ(hours.total(1), 0ms);
}

// ---- the course

TEST(SunCourse, isTheSunOfTheRoomBelow) {
  for (const auto refraction : {sun::Refraction::none, sun::Refraction::standard}) {
    const SunCourse course = dayOf(2026y / std::chrono::September / 23, kVienna, {refraction, SunPoint::centre});
    for (sun::Instant t = course.span().from; t < course.span().to; t += 437s)
      EXPECT_LT(glm::length(course.towards(t) - sun::eastNorthUp(sun::sunPosition(kVienna, t, refraction))), 1e-8);
  }
}

TEST(SunCourse, riseAndSetAreThoseOfTheSunDay) {
  const auto date = 2026y / std::chrono::June / 21;
  const SunCourse course = dayOf(date);
  const auto day = sun::sunDay(kVienna, *sun::parseZone("+00:00"), date);
  ASSERT_EQ(course.up().size(), 1u);
  EXPECT_LT(std::abs((course.up()[0].from - *day->rise).count()), 5);
  EXPECT_LT(std::abs((course.up()[0].to - *day->set).count()), 5);
}

TEST(SunCourse, refractionAndTheUpperLimbLengthenTheDay) {
  const auto date = 2026y / std::chrono::March / 20;
  const milliseconds plain = dayOf(date).upTime();
  const milliseconds limb = dayOf(date, kVienna, {sun::Refraction::none, SunPoint::upperLimb}).upTime();
  const milliseconds both = dayOf(date, kVienna, {sun::Refraction::standard, SunPoint::upperLimb}).upTime();
  // The sun climbs by 15 degrees an hour times cos 48.2 degrees.
  EXPECT_NEAR(seconds(limb - plain), 2 * 0.267 * 240 / std::cos(48.2 * std::numbers::pi / 180), 3.0);
  EXPECT_GT(both - limb, 5min);
  EXPECT_LT(both - limb, 8min);
}

TEST(ExactHours, refractionAgreesWithARayEverySecond) {
  hours_tests::Random random(21);
  const scene::Scene boxes = sceneOf(hours_tests::boxes(5, 22, random));
  const hours_tests::Rays rays(boxes);
  const auto all = hours_tests::placed(rays, 20, random);
  std::vector<Receiver> receivers;
  for (const auto& p : all) receivers.push_back(p.receiver);
  const SunCourse course =
      dayOf(2026y / std::chrono::October / 20, kVienna, {sun::Refraction::standard, SunPoint::upperLimb});
  const SunHours lit = hoursAt(boxes, receivers, course);
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_EQ(hours_tests::disagreements(rays, all[i], lit.lit(i), course), 0) << i;
}

}  // namespace
}  // namespace umbrage::study

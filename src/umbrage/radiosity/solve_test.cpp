#include "umbrage/radiosity/solve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/shapes.hpp"

namespace umbrage::radiosity {
namespace {

double sumOf(const Vec3& v) { return v.x + v.y + v.z; }

/// An L-shaped room, closed, 1 high: the square 2 x 2 without its far quarter.
mesh::Mesh cornerRoom() {
  mesh::Mesh m{"room", {}, {}, {}};
  const std::array<Vec2, 6> outline{Vec2(0, 0), Vec2(2, 0), Vec2(2, 1), Vec2(1, 1), Vec2(1, 2), Vec2(0, 2)};
  for (const double z : {0.0, 1.0})
    for (const Vec2& p : outline) m.positions.emplace_back(p.x, p.y, z);
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t j = (i + 1) % 6;
    m.triangles.push_back({i, j, j + 6}), m.triangles.push_back({i, j + 6, i + 6});
  }
  // Around the reflex corner, which sees all of the floor.
  for (std::uint32_t k = 0; k < 6; ++k)
    if (k != 3 && (k + 1) % 6 != 3)
      for (const std::uint32_t up : {0u, 6u}) m.triangles.push_back({3 + up, k + up, (k + 1) % 6 + up});
  return m;
}

scene::Scene furnace(mesh::Mesh room, double albedo, double emission) {
  auto scene = shapes::scene({std::move(room)});
  scene.materials[0].colour = Vec3(albedo, 0.5 * albedo, 0.0);
  scene.materials[0].emission = Vec3(emission);
  return scene;
}

/// By how much of it light on inner sides is off e / (1 - r) at most.
double worstInFurnace(const Solution& solution, const scene::Scene& scene, const Vec3& inside) {
  const scene::Material& material = scene.materials[0];
  double worst = 0.0;
  for (std::size_t v = 0; v < solution.mesh.vertices().size(); ++v) {
    const Vertex& vertex = solution.mesh.vertices()[v];
    const Vec3 normal = solution.mesh.sheets()[vertex.sheet].normal;
    // Of the corner room some walls have the point behind them; all outer sides are dark but for what they give off.
    const std::size_t s = glm::dot(inside - vertex.position, normal) > 0.0 ? 0 : 1;
    const Vec3 bright = glm::max(solution.exitance[v][s], solution.exitance[v][1 - s]);
    for (int k = 0; k < 3; ++k)
      worst = std::max(worst, std::abs(bright[k] * (1.0 - material.colour[k]) / material.emission[k] - 1.0));
  }
  return worst;
}

TEST(Solve, AClosedFurnaceOfACubeGlowsAsItMust) {
  for (const double albedo : {0.1, 0.5, 0.9}) {
    const auto scene = furnace(shapes::box({0, 0, 0}, {1, 1, 1}), albedo, 0.7);
    const auto solution = solve(scene, {}, {.patch = 0.5, .unshot = 1e-5});
    ASSERT_TRUE(solution);
    const double worst = worstInFurnace(*solution, scene, Vec3(0.5));
    std::printf("cube, albedo %.1f: worst of %zu vertices off by %.2e, balance %.1e, %zu shots, %zu factors\n", albedo,
                solution->stats.vertices, worst, solution->balance.error(), solution->stats.shots,
                solution->stats.factors);
    EXPECT_TRUE(solution->stats.converged);
    EXPECT_LT(worst, 1e-4);
    EXPECT_LT(std::abs(solution->balance.error()), 1e-6);
  }
}

TEST(Solve, AClosedFurnaceThatIsNotConvexGlowsAsItMust) {
  for (const double albedo : {0.1, 0.5, 0.9}) {
    const auto scene = furnace(cornerRoom(), albedo, 1.0);
    const auto solution = solve(scene, {}, {.patch = 0.5, .unshot = 1e-4});
    ASSERT_TRUE(solution);
    const double worst = worstInFurnace(*solution, scene, {0.5, 0.5, 0.5});
    std::printf("corner room, albedo %.1f: worst of %zu vertices off by %.2e, balance %.1e, %zu shots, %zu factors\n",
                albedo, solution->stats.vertices, worst, solution->balance.error(), solution->stats.shots,
                solution->stats.factors);
    EXPECT_LT(worst, 0.005);
    EXPECT_LT(std::abs(solution->balance.error()), 0.005);
  }
}

/// A closed grey room with a lamp under its ceiling and a block in it.
scene::Scene roomWithALamp() {
  auto scene = shapes::scene({shapes::box({0, 0, 0}, {2, 2, 2}), shapes::box({0.5, 0.6, 0.01}, {1.1, 1.2, 0.8}),
                              shapes::quad({0.7, 0.7, 1.95}, {1.3, 0.7, 1.95}, {1.3, 1.3, 1.95}, {0.7, 1.3, 1.95})});
  scene.materials[0].colour = Vec3(0.6, 0.5, 0.4);
  scene.materials.push_back({.name = "lamp", .colour = Vec3(0.0)});
  scene.materials[1].emission = Vec3(10.0);
  auto lamp = std::make_shared<mesh::Mesh>(*scene.meshes[2]);
  lamp->materials = {1, 1};
  scene.meshes[2] = lamp;
  return scene;
}

TEST(Solve, EnergyIsKeptWhereLightIsUneven) {
  for (const double patch : {1.0, 0.5}) {
    const auto solution = solve(roomWithALamp(), {}, {.patch = patch, .error = 0.2, .unshot = 1e-3});
    ASSERT_TRUE(solution);
    const Balance& b = solution->balance;
    std::printf(
        "room, patches of %.2f: emitted %.3f absorbed %.3f escaped %.4f unshot %.4f, error %.4f; %zu elements\n", patch,
        sumOf(b.emitted), sumOf(b.absorbed), sumOf(b.escaped), sumOf(b.unshot), b.error(), solution->stats.elements);
    EXPECT_NEAR(sumOf(b.emitted), 3 * 10 * 0.36 * 2, 1e-4);
    EXPECT_LT(std::abs(b.error()), 0.02);
    EXPECT_LT(sumOf(b.escaped) / sumOf(b.emitted), 1e-3);
    EXPECT_LE(solution->stats.unshotPart, 1e-3);
  }
}

TEST(Solve, ElementsAreCutWhereShadowsEnd) {
  const auto even = solve(roomWithALamp(), {}, {.patch = 1.0, .error = 0.0, .unshot = 0.05});
  const auto fine = solve(roomWithALamp(), {}, {.patch = 1.0, .error = 0.2, .unshot = 0.05});
  ASSERT_TRUE(even && fine);
  EXPECT_EQ(even->stats.refinements, 0u);
  EXPECT_GT(fine->stats.refinements, 1u);
  EXPECT_GT(fine->stats.elements, 2 * even->stats.elements);
  EXPECT_EQ(fine->stats.patches, even->stats.patches);
  // Below the block it stays dark, whatever was cut when.
  double under = 1.0;
  for (std::size_t v = 0; v < fine->mesh.vertices().size(); ++v) {
    const Vec3 p = fine->mesh.vertices()[v].position;
    if (p.z == 0.0 && p.x > 0.7 && p.x < 0.9 && p.y > 0.8 && p.y < 1.0)
      under = std::min(under, std::max(fine->exitance[v][0].x, fine->exitance[v][1].x));
  }
  EXPECT_LT(under, 0.02);
}

// What is cut after light was shot has the same light as what was cut before.
TEST(Solve, LateElementsCatchUp) {
  const auto scene = roomWithALamp();
  const auto late = solve(scene, {}, {.patch = 1.0, .element = 0.25, .error = 0.2, .unshot = 0.01});
  ASSERT_TRUE(late);
  const auto again = solve(scene, {}, {.patch = 1.0, .element = 0.25, .error = 0.2, .unshot = 0.01, .memory = 0});
  ASSERT_TRUE(again);
  // The same elements; every factor computed anew for every shot.
  ASSERT_EQ(late->exitance.size(), again->exitance.size());
  double apart = 0.0, most = 0.0;
  for (std::size_t v = 0; v < late->exitance.size(); ++v) {
    apart = std::max(apart, glm::length(late->exitance[v][0] - again->exitance[v][0]));
    most = std::max(most, glm::length(late->exitance[v][0]));
  }
  EXPECT_LT(apart, 1e-9 * most);
  EXPECT_EQ(late->stats.shots, again->stats.shots);
  EXPECT_GT(again->stats.factors, 2 * late->stats.factors);
}

// Two plates: what the second gets of the first, which alone shines, is its form factor.
TEST(Solve, ParallelPlatesExchangeByTheirFormFactor) {
  auto scene = shapes::scene({shapes::quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}),
                              shapes::quad({0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1})});
  scene.materials[0].colour = Vec3(0.0);
  scene.materials.push_back({.name = "lamp", .colour = Vec3(0.0)});
  scene.materials[1].emission = Vec3(1.0);
  auto lamp = std::make_shared<mesh::Mesh>(*scene.meshes[1]);
  lamp->materials = {1, 1};
  scene.meshes[1] = lamp;
  const auto solution = solve(scene, {}, {.patch = 0.25, .error = 0.0, .unshot = 1e-6});
  ASSERT_TRUE(solution);
  const double factor = sumOf(solution->balance.absorbed) / 3.0;  // the areas and the emission are 1
  std::printf("parallel plates: %.6f, closed form 0.199825\n", factor);
  EXPECT_NEAR(factor / 0.199825, 1.0, 0.01);
  // Both sides shine; what the other side gives off escapes whole.
  EXPECT_NEAR(sumOf(solution->balance.escaped) / 3.0, 2.0 - 0.199825, 0.01);
  EXPECT_LT(std::abs(solution->balance.error()), 0.005);
}

// Light of the scene's lights keeps the law of pictures: brightness x cosine, and what a surface gives off is that times its albedo.
TEST(Solve, LightsOfTheSceneShineAsInEveryPicture) {
  const auto scene = shapes::scene({shapes::quad({-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0})});
  const std::vector<scene::Light> lights{{scene::PointLight{{0, 0, 3}}, Vec3(1.0, 0.5, 0.25), 2.0}};
  const auto solution = solve(scene, lights, {.patch = 1.0, .error = 0.0});
  ASSERT_TRUE(solution);
  for (std::size_t v = 0; v < solution->exitance.size(); ++v) {
    const Vertex& vertex = solution->mesh.vertices()[v];
    const std::size_t up = solution->mesh.sheets()[vertex.sheet].normal.z > 0.0 ? 0 : 1;
    const double cosine = 3.0 / glm::length(Vec3(0, 0, 3) - vertex.sample);
    EXPECT_LT(glm::length(solution->exitance[v][up] - 0.8 * 2.0 * cosine * Vec3(1.0, 0.5, 0.25)), 1e-6);
    EXPECT_EQ(solution->exitance[v][1 - up], Vec3(0.0));
  }
}

TEST(Solve, TellsHowFarItIsAndStopsWhenAsked) {
  double last = 0.0;
  std::size_t told = 0;
  const auto all = solve(roomWithALamp(), {}, {.patch = 1.0, .error = 0.0}, [&](double fraction, std::string_view) {
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1.0);
    last = fraction, ++told;
    return true;
  });
  ASSERT_TRUE(all);
  EXPECT_GT(told, 20u);
  const auto stopped =
      solve(roomWithALamp(), {}, {.patch = 1.0, .error = 0.0}, [&](double, std::string_view) { return told-- > 15; });
  ASSERT_TRUE(stopped);
  EXPECT_FALSE(stopped->stats.converged);
  EXPECT_GT(stopped->ambient.x, all->ambient.x);
}

TEST(Solve, EndsAfterSoManyShots) {
  const auto few = solve(roomWithALamp(), {}, {.patch = 1.0, .error = 0.0, .mostShots = 10});
  ASSERT_TRUE(few);
  EXPECT_EQ(few->stats.shots, 10u);
  EXPECT_FALSE(few->stats.converged);
}

TEST(Solve, NothingAtAllAndNothingThatShines) {
  scene::Scene empty;
  empty.materials.push_back({"grey", Vec3(0.8)});
  EXPECT_TRUE(solve(empty, {}));
  const auto dark = solve(shapes::scene({shapes::box({0, 0, 0}, {1, 1, 1})}), {});
  ASSERT_TRUE(dark);
  EXPECT_EQ(dark->balance.error(), 0.0);
  EXPECT_EQ(dark->exitance[0][0], Vec3(0.0));
}

// A hundred kilometres from the origin, where single precision knows centimetres.
TEST(Solve, FarFromTheOrigin) {
  auto scene = furnace(cornerRoom(), 0.5, 1.0);
  scene.instances[0].toWorld[3] = Vec4(1e5, -2e5, 300, 1);
  const auto solution = solve(scene, {}, {.patch = 0.5, .unshot = 1e-4});
  ASSERT_TRUE(solution);
  EXPECT_LT(worstInFurnace(*solution, scene, Vec3(1e5 + 0.5, -2e5 + 0.5, 300.5) - solution->surfaces->origin), 0.005);
}

}  // namespace
}  // namespace umbrage::radiosity

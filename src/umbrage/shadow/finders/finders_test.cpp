#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>
#include <random>
#include <thread>

#include "support/finder_meshes.hpp"
#include "umbrage/math/predicates.hpp"
#include "umbrage/shadow/finders/dual_space.hpp"
#include "umbrage/shadow/finders/finder.hpp"
#include "umbrage/shadow/finders/many_lights.hpp"
#include "umbrage/shadow/finders/potentially_visible.hpp"
#include "umbrage/shadow/finders/spread.hpp"
#include "umbrage/shadow/volume.hpp"

namespace umbrage::shadow {
namespace {

using test_meshes::between;
using test_meshes::latticeLight;
using test_meshes::latticePoint;
using test_meshes::latticeSoup;
using test_meshes::Mesh;
using test_meshes::Random;

constexpr SilhouetteOptions kEverySurface{.countEverySurface = true};
constexpr FinderKind kClever[] = {FinderKind::bruteForce, FinderKind::bruteForceSimd,     FinderKind::hextree,
                                  FinderKind::hough,      FinderKind::potentiallyVisible, FinderKind::automatic};

std::shared_ptr<const CasterSet> share(const Mesh& m) { return std::make_shared<const CasterSet>(m.casters()); }

// The edges of findSilhouette, by index.
std::vector<SignedEdge> expected(const CasterSet& casters, const Vec4& light, const SilhouetteOptions& options) {
  const Silhouette s = findSilhouette(casters, light, options);
  std::vector<SignedEdge> edges;
  std::uint32_t e = 0;
  for (const SilhouetteEdge& found : s.edges) {
    while (casters.edges[e].a != found.a || casters.edges[e].b != found.b) ++e;
    edges.push_back({e, found.multiplicity});
  }
  return edges;
}

// Powers of two: nothing is rounded.
Mesh scaled(Mesh m, int exponent) {
  for (Vec3f& p : m.positions) p *= std::ldexp(1.0f, exponent);
  return m;
}

TEST(Finders, HaveNames) {
  for (const FinderKind kind : allFinderKinds()) EXPECT_EQ(finderNamed(name(kind)), kind);
  EXPECT_EQ(finderNamed("bruteforce"), std::nullopt);
}

TEST(Finders, OfNothingFindNothing) {
  const auto none =
      std::make_shared<const CasterSet>(buildCasters(std::span<const Vec3f>(), std::span<const mesh::Triangle>()));
  for (const FinderKind kind : kClever) {
    const auto finder = makeFinder(kind, none);
    EXPECT_TRUE(finder->find({0, 0, 1, 0}).edges.empty());
    EXPECT_TRUE(finder->find({0, 0, 1, 1}).edges.empty());
  }
  EXPECT_TRUE(ManyLights(none).find(std::vector<Vec4>{{0, 0, 1, 0}})[0].edges.empty());
  EXPECT_TRUE(ManyLights(none).find({}).empty());
}

// The law of the interface, where degeneracies are common. Ten thousand meshes.
TEST(Finders, AgreeOnLattices) {
  for (unsigned seed = 0; seed < 10'000; ++seed) {
    Random random(seed);
    const Mesh m = latticeSoup(random);
    const int exponent = between(random, -30, 30);
    const auto casters = share(scaled(m, exponent));
    const FinderOptions build{.threads = 1 + seed % 2, .vectorUnits = seed % 3 != 0};
    const SilhouetteOptions options{.countEverySurface = seed % 2 == 0};
    std::vector<Vec4> lights;
    for (int i = 0; i < 3; ++i) {
      const Vec4 light = latticeLight(random, m);
      lights.emplace_back(std::ldexp(1.0, exponent) * Vec3(light), light.w);
    }
    std::vector<std::vector<SignedEdge>> truth;
    for (const Vec4& light : lights) truth.push_back(expected(*casters, light, options));
    for (const FinderKind kind : kClever) {
      const auto finder = makeFinder(kind, casters, build);
      for (std::size_t i = 0; i < lights.size(); ++i)
        ASSERT_EQ(finder->find(lights[i], options).edges, truth[i])
            << name(kind) << ", mesh " << seed << ", light " << i;
    }
    const auto many = ManyLights(casters, build).find(lights, options);
    for (std::size_t i = 0; i < lights.size(); ++i) ASSERT_EQ(many[i].edges, truth[i]) << "many lights, mesh " << seed;
  }
}

std::vector<Vec4> lightsAround(const CasterSet& casters, int count, unsigned seed) {
  Random random(seed);
  std::vector<Vec4> lights;
  const double r = casters.bounds.radius();
  while (lights.size() < static_cast<std::size_t>(count)) {
    const Vec3 p = Vec3(latticePoint(random, 1000)) / 1000.0;
    const std::size_t kind = lights.size() % 4;
    if (kind == 0)
      lights.emplace_back(p, 0.0);
    else if (kind == 1)
      lights.emplace_back(casters.bounds.centre() + r * p, 1.0);
    else if (kind == 2)
      lights.emplace_back(casters.position(static_cast<std::uint32_t>(random() % casters.positions.size())), 1.0);
    else
      lights.emplace_back(casters.bounds.centre() + 100.0 * r * p, 1.0);
  }
  for (int k = 0; k < 3; ++k) {
    Vec4 axis(0.0);
    axis[k] = k == 1 ? -1.0 : 1.0;
    lights.push_back(axis);
  }
  return lights;
}

void expectAgreement(const Mesh& m) {
  const auto casters = share(m);
  const auto lights = lightsAround(*casters, 66, 3);
  for (const SilhouetteOptions& options : {SilhouetteOptions{}, kEverySurface}) {
    std::vector<Silhouette> truth;
    std::vector<std::vector<SignedEdge>> edges;
    for (const Vec4& light : lights) {
      truth.push_back(findSilhouette(*casters, light, options));
      edges.push_back(expected(*casters, light, options));
    }
    for (const FinderKind kind : kClever) {
      const auto finder = makeFinder(kind, casters);
      for (std::size_t i = 0; i < lights.size(); ++i) {
        ASSERT_EQ(finder->find(lights[i], options).edges, edges[i]) << name(kind) << ", light " << i;
        const Silhouette s = finder->silhouette(lights[i], options);
        ASSERT_EQ(s.side, truth[i].side) << name(kind);
        ASSERT_TRUE(std::equal(s.edges.begin(), s.edges.end(), truth[i].edges.begin(), truth[i].edges.end(),
                               [](const SilhouetteEdge& a, const SilhouetteEdge& b) {
                                 return a.a == b.a && a.b == b.b && a.multiplicity == b.multiplicity &&
                                        a.component == b.component;
                               }));
      }
    }
    const ManyLights many(casters);
    const auto found = many.find(lights, options);
    for (std::size_t i = 0; i < lights.size(); ++i) ASSERT_EQ(found[i].edges, edges[i]) << "many lights, light " << i;
    std::atomic<int> differing{0}, answered{0};
    many.visit(
        lights, [&](std::size_t i, const FoundEdges& f) { ++answered, differing += f.edges != edges[i]; }, options);
    EXPECT_EQ(differing, 0);
    EXPECT_EQ(answered, static_cast<int>(lights.size()));
  }
}

TEST(Finders, AgreeOnSmoothMeshes) { expectAgreement(test_meshes::smooth(20'000)); }
TEST(Finders, AgreeOnBoxes) { expectAgreement(test_meshes::boxy(20'000)); }
TEST(Finders, AgreeOnBoxesAlongTheAxes) { expectAgreement(test_meshes::boxy(12'000, false)); }
TEST(Finders, AgreeOnSoup) { expectAgreement(test_meshes::soup(10'000)); }

TEST(Finders, AgreeOnWhatIsFarFromItsOrigin) {
  Mesh m = test_meshes::smooth(5'000);
  for (Vec3f& p : m.positions) p += Vec3f(3e5f, -7e5f, 1e4f);
  expectAgreement(m);
}

// A lattice of height steps: many edges with the light in the plane of a face, many faces at one edge.
TEST(Finders, AgreeOnSharedWalls) {
  Random random(5);
  Mesh m;
  for (int i = 0; i < 200; ++i)
    test_meshes::addBox(m, {float(2 * (i % 14)), float(2 * (i / 14)), 0.0f}, {2.0f, 2.0f, float(between(random, 1, 3))},
                        0.0f);
  expectAgreement(m);
}

// Solids whose faces are counted or not by where the light is: a prism of many sides along whose axis the light shines.
TEST(Finders, AgreeOnSolidsSeenEdgeOn) {
  Mesh m;
  constexpr std::uint32_t kSides = 300;
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const double a = 2.0 * std::numbers::pi * i / kSides;
    for (const float z : {0.0f, 2.0f}) m.positions.emplace_back(float(std::cos(a)), float(std::sin(a)), z);
  }
  const auto at = [](std::uint32_t i, std::uint32_t top) { return i % kSides * 2 + top; };
  for (std::uint32_t i = 0; i < kSides; ++i) {
    m.triangles.push_back({at(i, 0), at(i + 1, 0), at(i + 1, 1)});
    m.triangles.push_back({at(i, 0), at(i + 1, 1), at(i, 1)});
    for (const std::uint32_t top : {0u, 1u})
      if (i > 0 && i + 1 < kSides) m.triangles.push_back({at(0, top), at(i, top), at(i + 1, top)});
  }
  expectAgreement(m);
}

// What bounds prove, the predicate must find: random triangles of all shapes and sizes, lights close to their planes.
TEST(DualSpace, NeverProvesAWrongSign) {
  Random random(11);
  std::normal_distribution<double> normal;
  const auto vector = [&] {
    const double x = normal(random), y = normal(random), z = normal(random);
    return Vec3(x, y, z);
  };
  int proven = 0, near = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double scale = std::ldexp(1.0, between(random, -40, 40)), thin = std::ldexp(1.0, -between(random, 0, 26));
    const Vec3 offset = std::ldexp(1.0, between(random, -4, 12)) * vector();
    const Vec3 a = vector(), b = a + vector(), c = a + (b - a) * normal(random) + thin * vector();
    std::vector<Vec3f> corners;
    for (const Vec3& p : {a, b, c, Vec3(5.0 * vector())}) corners.emplace_back(scale * (p + offset));
    const std::vector<mesh::Triangle> triangles{{0, 1, 2}, {0, 1, 3}};
    const CasterSet casters = buildCasters(corners, triangles);
    if (casters.triangles.size() != 2) continue;
    const DualFrame frame = dualFrame(casters);
    for (std::uint32_t t = 0; t < 2; ++t) {
      const DualPlane plane = dualPlane(casters, frame, t);
      if (!plane.steady) continue;
      const Vec3 p = casters.corner(t, 0), q = casters.corner(t, 1), r = casters.corner(t, 2);
      const Vec3 inPlane = p + normal(random) * (q - p) + normal(random) * (r - p);
      for (int k = 0; k < 30; ++k) {
        const double lift = std::ldexp(normal(random), -k) * frame.radius;
        const Vec3 place = inPlane + lift * glm::normalize(glm::cross(q - p, r - p));
        for (const Vec4& light : {Vec4(place, 1.0), Vec4(place - p, 0.0)}) {
          const DualPoint u = dualLight(frame, light);
          float value = 0.0f;
          for (int axis = 0; axis < 4; ++axis) value += plane.point[axis] * u[axis];
          if (std::abs(value) <= kDoubt) {
            ++near;
            continue;
          }
          ++proven;
          ASSERT_EQ(lightSide(p, q, r, light), value > 0.0f ? 1 : -1) << i << ' ' << k;
        }
      }
    }
  }
  EXPECT_GT(proven, 100'000);
  EXPECT_GT(near, 100'000);
}

TEST(DualSpace, TellsNothingForLightsBeyondAllNumbers) {
  const auto casters = share(test_meshes::smooth(500));
  for (const Vec4& light : {Vec4(1e200, 0, 0, 1), Vec4(1e-200, 0, 0, 0), Vec4(0, 0, 0, 0)})
    for (const FinderKind kind : kClever)
      EXPECT_EQ(makeFinder(kind, casters)->find(light).edges, expected(*casters, light, {})) << name(kind);
}

TEST(Spread, SelectsTheSmallest) {
  Random random(2);
  for (int round = 0; round < 20'000; ++round) {
    std::vector<std::uint64_t> a(static_cast<std::size_t>(between(random, 2, 90)));
    const int range = between(random, 1, 60), kind = between(random, 0, 2);
    for (std::uint32_t i = 0; i < a.size(); ++i) {
      const float value = kind == 0 ? float(between(random, -range, range)) : (kind == 1 ? float(i) : -float(i));
      a[i] = spreading::sortable(value, i);
    }
    std::vector<std::uint64_t> sorted = a;
    std::sort(sorted.begin(), sorted.end());
    const auto k = static_cast<std::size_t>(between(random, 1, static_cast<int>(a.size()) - 1));
    spreading::select(a.data(), a.size(), k);
    std::sort(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(k));
    std::sort(a.begin() + static_cast<std::ptrdiff_t>(k), a.end());
    ASSERT_EQ(a, sorted);
  }
}

TEST(Spread, OrdersTheSameInAnyNumberOfThreadsAndLosesNothing) {
  Random random(3);
  std::vector<std::array<float, 2>> points(60'000);
  for (auto& p : points) p = {float(between(random, 0, 300)), float(between(random, 0, 9))};
  const auto key = [](const std::array<float, 2>& p, int k) { return p[static_cast<std::size_t>(k)]; };
  const auto ordered = [&](unsigned threads) {
    std::vector<std::array<float, 2>> all(points.size());
    spread<2>(std::span<const std::array<float, 2>>(points), {8, 16}, key, threads, [&](std::size_t first, auto some) {
      std::copy(some.begin(), some.end(), all.begin() + static_cast<std::ptrdiff_t>(first));
    });
    return all;
  };
  auto one = ordered(1);
  EXPECT_EQ(one, ordered(3));
  std::sort(points.begin(), points.end());
  std::sort(one.begin(), one.end());
  EXPECT_EQ(one, points);
}

TEST(Dual, IsTheSameInAnyNumberOfThreads) {
  Mesh m = test_meshes::smooth(120'000);
  for (std::size_t t = 0; t < m.triangles.size(); t += 100) {  // slivers
    mesh::Triangle& corners = m.triangles[t];
    m.positions.push_back((m.positions[corners[0]] + m.positions[corners[1]]) * 0.5f);
    corners[2] = static_cast<std::uint32_t>(m.positions.size() - 1);
  }
  const CasterSet casters = m.casters();
  const DualEdges one = dualEdges(casters, 1), three = dualEdges(casters, 3);
  EXPECT_FALSE(one.always.empty());
  EXPECT_EQ(one.always, three.always);
  const auto same = [](const DualEdge& a, const DualEdge& b) { return a.point == b.point && a.tag == b.tag; };
  EXPECT_TRUE(std::equal(one.segments.begin(), one.segments.end(), three.segments.begin(), three.segments.end(), same));
}

// --- cost, in edges -------------------------------------------------------------------------------------------------------

struct Cost {
  double tested = 0.0, found = 0.0, bytesPerEdge = 0.0;
};

Cost costOf(FinderKind kind, std::uint32_t triangles, double w) {
  const auto casters = share(test_meshes::smooth(triangles));
  const auto finder = makeFinder(kind, casters);
  Cost cost;
  for (int i = 0; i < 12; ++i) {
    const Vec3 d(std::cos(1.0 + 2.4 * i), std::sin(1.0 + 2.4 * i), 0.2 + 0.1 * i);
    const FoundEdges f = finder->find(w == 0.0 ? Vec4(d, 0.0) : Vec4(casters->bounds.centre() + 4.0 * d, 1.0));
    cost.tested += double(f.tested), cost.found += double(f.edges.size());
  }
  cost.bytesPerEdge = double(finder->memory()) / double(casters->edges.size());
  return cost;
}

TEST(Hextree, TestsFewEdgesMoreThanItFinds) {
  for (const double w : {0.0, 1.0}) {
    const Cost small = costOf(FinderKind::hextree, 10'000, w), large = costOf(FinderKind::hextree, 160'000, w);
    EXPECT_LT(large.tested, 10.0 * large.found);
    EXPECT_LT(large.bytesPerEdge, 64.0);
    EXPECT_LT(std::log(large.tested / small.tested) / std::log(16.0), 0.65);
  }
}

TEST(Hextree, TakesWholeGroupsUntested) {
  const auto casters = share(test_meshes::boxy(60'000, false));
  const FoundEdges f = makeFinder(FinderKind::hextree, casters)->find({0.3, 0.4, 0.5, 0.0});
  EXPECT_EQ(f.edges, expected(*casters, {0.3, 0.4, 0.5, 0.0}, {}));
  EXPECT_LT(f.tested * 5, f.edges.size());
}

TEST(Hough, TestsFewerEdgesThanThereAre) {
  const Cost small = costOf(FinderKind::hough, 10'000, 1.0), large = costOf(FinderKind::hough, 160'000, 1.0);
  EXPECT_LT(std::log(large.tested / small.tested) / std::log(16.0), 0.65);
  EXPECT_LT(large.bytesPerEdge, 64.0);
}

TEST(PotentiallyVisible, SaysWhenTheLightIsOutsideItsVolume) {
  const auto casters = share(test_meshes::smooth(3'000));
  const PotentiallyVisible finder(casters, {.litVolume = 3.0});
  const Vec3 centre = casters->bounds.centre(), size = casters->bounds.size();
  const auto inside = finder.find(Vec4(centre + 1.4 * size, 1.0), {}),
             outside = finder.find(Vec4(centre + 1.6 * size, 1.0), {}), sun = finder.find({1, 1, 1, 0}, {});
  EXPECT_EQ(inside.answeredBy, FinderKind::potentiallyVisible);
  EXPECT_EQ(outside.answeredBy, FinderKind::bruteForceSimd);
  EXPECT_EQ(sun.answeredBy, FinderKind::bruteForceSimd);
  EXPECT_EQ(outside.tested, casters->edges.size());
  EXPECT_LT(inside.tested * 4, casters->edges.size());
  EXPECT_GT(finder.cellCount(), 8u);
}

// Deterministic: built after so many questions, whatever the clock says.
TEST(Automatic, BuildsATreeWhenEnoughWasAskedAndWhereItCanHelp) {
  const auto knot = share(test_meshes::smooth(4'000)), soup = share(test_meshes::soup(4'000));
  const auto lights = lightsAround(*knot, 200, 9);
  for (const auto& casters : {knot, soup}) {
    const auto finder = makeFinder(FinderKind::automatic, casters);
    const std::size_t before = finder->memory();
    for (const Vec4& light : lights) ASSERT_EQ(finder->find(light).edges, expected(*casters, light, {}));
    EXPECT_EQ(finder->memory() > before, casters == knot);
  }
}

TEST(Automatic, AnswersManyThreadsAtOnce) {
  const auto casters = share(test_meshes::smooth(2'000));
  const auto finder = makeFinder(FinderKind::automatic, casters);
  const auto lights = lightsAround(*casters, 150, 4);
  std::vector<std::vector<SignedEdge>> truth;
  for (const Vec4& light : lights) truth.push_back(expected(*casters, light, {}));
  std::atomic<int> wrong{0};
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 3; ++t)
      threads.emplace_back([&] {
        for (std::size_t i = 0; i < lights.size(); ++i) wrong += finder->find(lights[i]).edges != truth[i];
      });
  }
  EXPECT_EQ(wrong, 0);
}

// --- rigid motion ---------------------------------------------------------------------------------------------------------

// The silhouette as flow along edges named by their corners' numbers, which a motion does not change.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> flow(const CasterSet& casters,
                                                            const std::vector<SignedEdge>& edges) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> flow;
  for (const SignedEdge& e : edges) {
    const auto [a, b, begin, end] = casters.edges[e.edge];
    flow[std::minmax(a, b)] = a < b ? e.multiplicity : -e.multiplicity;
  }
  return flow;
}

TEST(RigidMotion, ThatRoundsNothingFindsTheSilhouetteOfTheMovedCasters) {
  // A turn of the axes x -> y -> z -> x, and a quarter turn; shifts by whole numbers.
  const Mat4 turns[] = {Mat4(0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 7, -3, 12, 1),
                        Mat4(0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, -5, 0, 2, 1)};
  for (unsigned seed = 0; seed < 2'000; ++seed) {
    Random random(seed);
    const Mesh m = latticeSoup(random);
    for (const Mat4& motion : turns) {
      Mesh moved = m;
      for (Vec3f& p : moved.positions) p = Vec3f(transformPoint(motion, Vec3(p)));
      const auto here = share(m), there = share(moved);
      const Vec4 light(Vec3(latticePoint(random, 20)), between(random, 0, 1));
      const auto inObject = makeFinder(FinderKind::hextree, here)->find(intoObjectSpace(motion, light), kEverySurface);
      ASSERT_EQ(flow(*here, inObject.edges), flow(*there, expected(*there, light, kEverySurface))) << seed;
    }
  }
}

TEST(RigidMotion, InGeneralChangesOnlyFacesThatTheLightIsInThePlaneOf) {
  const Mesh m = test_meshes::smooth(4'000);
  const double a = 0.7;
  const Mat4 motion(std::cos(a), std::sin(a), 0, 0, -std::sin(a), std::cos(a), 0, 0, 0, 0, 1, 0, 3.3, -1.7, 0.9, 1);
  Mesh moved = m;
  for (Vec3f& p : moved.positions) p = Vec3f(transformPoint(motion, Vec3(p)));
  const auto here = share(m), there = share(moved);
  for (const Vec4& light : lightsAround(*there, 40, 8)) {
    const Vec4 inObject = intoObjectSpace(motion, light);
    ASSERT_EQ(here->triangles.size(), there->triangles.size());
    for (std::uint32_t t = 0; t < here->triangles.size(); ++t) {
      const auto side = [&](const CasterSet& c, const Vec4& l, bool other) {
        return (other ? -1 : 1) * lightSide(c.corner(t, 0), c.corner(t, 1), c.corner(t, 2), l);
      };
      // Sorting may have turned the triangle over.
      const auto& p = here->triangles[t];
      const auto& q = there->triangles[t];
      const bool turned =
          !((p[0] == q[0] && p[1] == q[1]) || (p[0] == q[1] && p[1] == q[2]) || (p[0] == q[2] && p[1] == q[0]));
      if (side(*here, inObject, false) == side(*there, light, turned)) continue;
      const Vec3 n = glm::normalize(
          glm::cross(there->corner(t, 1) - there->corner(t, 0), there->corner(t, 2) - there->corner(t, 0)));
      const Vec3 from = Vec3(light) - there->corner(t, 0) * light.w;
      // Rounding of 2^-24 of the coordinates, over triangles of about 1/50 of them.
      EXPECT_LT(std::abs(glm::dot(n, from)), 1e-4 * glm::length(from) + 1e-5);
    }
  }
}

}  // namespace
}  // namespace umbrage::shadow

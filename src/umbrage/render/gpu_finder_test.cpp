#include "umbrage/render/gpu_finder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "support/finder_meshes.hpp"
#include "umbrage/gl/context.hpp"
#include "umbrage/gl/debug_log.hpp"
#include "umbrage/shadow/eye_count.hpp"
#include "umbrage/shadow/volume.hpp"

namespace umbrage::render {
namespace {

using shadow::test_meshes::Mesh;
using shadow::test_meshes::Random;
using Casters = std::shared_ptr<const shadow::CasterSet>;

Casters share(const Mesh& m) { return std::make_shared<const shadow::CasterSet>(m.casters()); }

// A side or a cap as a triangle whose first index is the smallest; sorted, so that orders of writing do not matter.
using Triangles = std::vector<std::array<std::uint32_t, 3>>;
Triangles trianglesOf(std::span<const std::uint32_t> indices) {
  Triangles triangles;
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    std::array<std::uint32_t, 3> t{indices[i], indices[i + 1], indices[i + 2]};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    triangles.push_back(t);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

class GpuSilhouettes : public ::testing::Test {
 protected:
  void SetUp() override {
    auto context = gl::Context::createHeadless({.debug = true});
    if (!context) GTEST_SKIP() << "no graphics: " << context.error().text();
    current_.emplace(*context);
    programs_ = std::make_shared<const FinderPrograms>();
  }
  void TearDown() override {
    programs_.reset();
    current_.reset();
  }
  std::unique_ptr<GpuFinder> finderOf(const Casters& casters) const {
    auto finder = GpuFinder::make(casters, programs_);
    EXPECT_TRUE(finder) << finder.error().text();
    return std::move(*finder);
  }
  // Sides and edges, bit by bit.
  static void expectSame(const GpuFinder& finder, const Vec4& light, const shadow::SilhouetteOptions& options) {
    const shadow::Silhouette truth = shadow::findSilhouette(finder.casters(), light, options);
    const shadow::Silhouette found = finder.silhouette(light, options);
    ASSERT_EQ(found.side, truth.side);
    ASSERT_EQ(found.edges.size(), truth.edges.size());
    for (std::size_t i = 0; i < truth.edges.size(); ++i) {
      const auto &f = found.edges[i], &t = truth.edges[i];
      ASSERT_TRUE(f.a == t.a && f.b == t.b && f.multiplicity == t.multiplicity && f.component == t.component) << i;
    }
  }
  std::optional<gl::CurrentContext> current_;
  std::shared_ptr<const FinderPrograms> programs_;
};

// scripts/sweep properties asks for more.
unsigned meshesToTry() {
  const char* given = std::getenv("UMBRAGE_TEST_MESHES");
  return given != nullptr ? static_cast<unsigned>(std::atoi(given)) : 1000;
}

// Doubled and flat faces, edges of many triangles, lights on corners and in planes.
TEST_F(GpuSilhouettes, AreThoseOfBruteForceOnLattices) {
  const gl::DebugLog log;
  for (unsigned seed = 0; seed < meshesToTry(); ++seed) {
    Random random(seed);
    Mesh m = shadow::test_meshes::latticeSoup(random);
    const int exponent = shadow::test_meshes::between(random, -30, 30);
    std::vector<Vec4> lights;
    for (int i = 0; i < 3; ++i) {
      const Vec4 light = shadow::test_meshes::latticeLight(random, m);
      lights.emplace_back(std::ldexp(1.0, exponent) * Vec3(light), light.w);
    }
    for (Vec3f& p : m.positions) p *= std::ldexp(1.0f, exponent);
    const auto finder = finderOf(share(m));
    for (const Vec4& light : lights) {
      SCOPED_TRACE("mesh " + std::to_string(seed));
      expectSame(*finder, light, {.countEverySurface = seed % 2 == 0});
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_TRUE(log.messages().empty()) << log.messages().front();
}

// Coordinates with full mantissas, where every rounding shows.
TEST_F(GpuSilhouettes, AreThoseOfBruteForceOnMeshesOfAllKinds) {
  for (const Mesh& m : {shadow::test_meshes::smooth(20'000), shadow::test_meshes::boxy(9'000)}) {
    const auto finder = finderOf(share(m));
    EXPECT_GT(finder->memory(), 0u);
    const auto& casters = finder->casters();
    Random random(7);
    for (int i = 0; i < 12; ++i) {
      SCOPED_TRACE(i);
      const double x = double(random()) * 0x1p-31 - 1.0, y = double(random()) * 0x1p-31 - 1.0;
      const auto t = static_cast<std::uint32_t>(random() % casters.triangles.size());
      const Vec3 a = casters.corner(t, 0), ab = casters.corner(t, 1) - a, ac = casters.corner(t, 2) - a;
      const Vec4 light = i % 4 == 0   ? Vec4(x, y, 0.37, 0.0)
                         : i % 4 == 1 ? Vec4(casters.bounds.centre() + casters.bounds.size() * Vec3(x, y, x + y), 1.0)
                         : i % 4 == 2 ? Vec4(a + 3.0 * x * ab - 2.0 * y * ac, 1.0)
                                      : Vec4(x * ab + y * ac, 0.0);
      expectSame(*finder, light, {.countEverySurface = i % 3 == 0});
      if (HasFatalFailure()) return;
    }
  }
}

// What is extruded on the card is what the processor extrudes, triangle by triangle, whatever becomes of which component.
TEST_F(GpuSilhouettes, AreExtrudedAsOnTheProcessor) {
  const auto casters = share(shadow::test_meshes::boxy(1'200));
  const auto finder = finderOf(casters);
  const Vec3 eye = casters->bounds.centre() + Vec3(0.1, 0.2, 0.3);
  CardVolume volume;
  for (const Vec4& light : {Vec4(0.3, -0.2, 0.9, 0.0), Vec4(casters->bounds.centre() + Vec3(1, 2, 9), 1.0)}) {
    const bool toOnePoint = light.w == 0.0;
    std::vector<Role> roles;
    std::vector<std::uint8_t> passes, fails;
    for (std::uint32_t c = 0; c < casters->componentCount; ++c) {
      roles.push_back(static_cast<Role>(c % 4));
      passes.push_back(c % 4 == 1);
      fails.push_back(c % 4 >= 2);
    }
    const CardRequest request{.light = light,
                              .eye = eye,
                              .roles = roles,
                              .sides = toOnePoint ? SideFormat::triangle : SideFormat::quad,
                              .farCaps = !toOnePoint};
    {
      gl::HostScope scope;
      ASSERT_TRUE(finder->extrude(scope, request, volume));
    }
    const CardCounts counts = countsOf(volume);
    const auto silhouette = shadow::findSilhouette(*casters, light);
    const auto sees = [&](const shadow::SilhouetteEdge& e) {
      return roles[e.component] != Role::failAtEye || !shadow::liesOnSide(*casters, e, light, eye);
    };
    const auto pass = shadow::extrude(*casters, silhouette, {.caps = false, .components = passes});
    const auto fail = shadow::extrude(*casters, silhouette, {.components = fails, .keepSide = sees});
    const auto all = volume.indices.readAll<std::uint32_t>(volume.indices.bytes() / sizeof(std::uint32_t));
    const auto draws = volume.draws.readAll<gl::IndirectDraw>(3);
    const auto part = [&](CardVolume::Part p) {
      return trianglesOf(std::span(all).subspan(draws[p].firstIndex, counts.indices[p]));
    };
    EXPECT_EQ(part(CardVolume::passSides), trianglesOf(pass.sides));
    EXPECT_EQ(part(CardVolume::failSides), trianglesOf(fail.sides));
    EXPECT_EQ(part(CardVolume::failCaps), trianglesOf(fail.caps));
    EXPECT_EQ(counts.edges, static_cast<std::size_t>(
                                std::count_if(silhouette.edges.begin(), silhouette.edges.end(),
                                              [&](const auto& e) { return roles[e.component] != Role::leftOut; })));
  }
}

// Sides on which the eye lies are left out by the same rule as on the processor.
TEST_F(GpuSilhouettes, LeaveOutSidesOnWhichTheEyeLies) {
  const auto casters = share(shadow::test_meshes::boxy(240));
  const auto finder = finderOf(casters);
  const std::vector<Role> roles(casters->componentCount, Role::failAtEye);
  std::size_t leftOut = 0;
  for (const Vec4& light : {Vec4(0.3, -0.2, 0.9, 0.0), Vec4(casters->bounds.centre() + Vec3(1, 2, 9), 1.0)}) {
    const auto silhouette = shadow::findSilhouette(*casters, light);
    for (std::size_t i = 0; i < silhouette.edges.size(); i += 5) {
      const Vec3 a = casters->position(silhouette.edges[i].a), b = casters->position(silhouette.edges[i].b);
      const Vec3 middle = glm::mix(a, b, 0.37), away = glm::normalize(middle * light.w - Vec3(light));
      const Vec3 eye = middle + 0.31 * away + (i % 2 == 0 ? 0.0 : 1e-3) * glm::normalize(glm::cross(b - a, away));
      std::size_t kept = 0;
      for (const auto& e : silhouette.edges) {
        const bool dropped = shadow::liesOnSide(*casters, e, light, eye);
        leftOut += dropped;
        kept += dropped ? 0 : static_cast<std::size_t>(std::abs(e.multiplicity));
      }
      CardVolume volume;
      gl::HostScope scope;
      ASSERT_TRUE(finder->extrude(
          scope, {.light = light, .eye = eye, .roles = roles, .sides = SideFormat::line, .farCaps = false}, volume));
      EXPECT_EQ(countsOf(volume).indices[CardVolume::failSides], 2 * kept) << i;
    }
  }
  EXPECT_GT(leftOut, 10u);
}

TEST_F(GpuSilhouettes, OfNothingAreEmpty) {
  const auto finder = finderOf(std::make_shared<const shadow::CasterSet>());
  EXPECT_TRUE(finder->find({0, 0, 1, 0}, {}).edges.empty());
  EXPECT_TRUE(finder->silhouette({0, 0, 1, 1}, {}).side.empty());
}

}  // namespace
}  // namespace umbrage::render

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "support/finder_meshes.hpp"
#include "umbrage/math/predicates.hpp"
#include "umbrage/shadow/caster_set.hpp"
#include "umbrage/shadow/composite.hpp"
#include "umbrage/shadow/eye_count.hpp"
#include "umbrage/shadow/facing.hpp"
#include "umbrage/shadow/layering.hpp"
#include "umbrage/shadow/light_mask.hpp"
#include "umbrage/shadow/silhouette.hpp"
#include "umbrage/shadow/volume.hpp"

namespace umbrage::shadow {
namespace {

const std::vector<Vec3f> kCubeCorners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                      {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
const std::vector<mesh::Triangle> kCubeFaces{{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                             {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};

CasterSet cube() { return buildCasters(kCubeCorners, kCubeFaces); }

struct Soup {
  std::vector<Vec3f> positions;
  std::vector<mesh::Triangle> triangles;
};

Vec3f latticePoint(int reach) {
  const auto coordinate = rc::gen::inRange(-reach, reach + 1);
  return {float(*coordinate), float(*coordinate), float(*coordinate)};
}

Soup latticeSoup() {
  Soup soup;
  soup.positions.resize(*rc::gen::inRange<std::size_t>(3, 10));
  for (Vec3f& p : soup.positions) p = latticePoint(4);
  const auto corner = rc::gen::inRange<std::uint32_t>(0, static_cast<std::uint32_t>(soup.positions.size()));
  soup.triangles.resize(*rc::gen::inRange<std::size_t>(0, 16));
  for (mesh::Triangle& t : soup.triangles) t = {*corner, *corner, *corner};
  return soup;
}

Vec4 latticeLight() {
  const Vec3 p(latticePoint(6));
  if (*rc::gen::inRange(0, 2) == 1 || p == Vec3(0.0)) return {p, 1.0};
  return {p, 0.0};
}

// --- silhouettes ---------------------------------------------------------------------------------------------------------

constexpr SilhouetteOptions kEverySurface{.countEverySurface = true};

TEST(Silhouette, OfACubeFromAboveIsItsUpperSquare) {
  const CasterSet casters = cube();
  const Vec4 above(0.5, 0.5, 9, 1);
  const Silhouette s = findSilhouette(casters, above);
  EXPECT_EQ(s.edges.size(), 4u);
  for (const SilhouetteEdge& e : s.edges) EXPECT_EQ(std::abs(e.multiplicity), 1);
  // Counting both the lit top and the averted rest, the same edges count twice.
  const Silhouette all = findSilhouette(casters, above, kEverySurface);
  EXPECT_EQ(all.edges.size(), 4u);
  for (const SilhouetteEdge& e : all.edges) EXPECT_EQ(std::abs(e.multiplicity), 2);
  EXPECT_EQ(casters.report.topology, mesh::Topology::closed);
  EXPECT_EQ(casters.componentCount, 1u);
}

TEST(Silhouette, OfNothingIsEmpty) {
  const CasterSet none = buildCasters(std::span<const Vec3f>(), std::span<const mesh::Triangle>());
  const Silhouette s = findSilhouette(none, {0, 0, 1, 0});
  EXPECT_TRUE(s.edges.empty());
  EXPECT_EQ(extrude(none, s).triangleCount(), 0u);
  EXPECT_EQ(countAtEye(none, s, {1, 2, 3}).count, 0);
}

TEST(Silhouette, DoesNotDependOnTheFilesWindingOrOrder) {
  auto flipped = kCubeFaces;
  std::reverse(flipped.begin(), flipped.end());
  for (std::size_t i = 0; i < flipped.size(); i += 2) std::swap(flipped[i][0], flipped[i][1]);
  const auto signature = [](const CasterSet& c) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const SilhouetteEdge& e : findSilhouette(c, {3, 4, 5, 1}).edges) edges[{e.a, e.b}] = e.multiplicity;
    return edges;
  };
  EXPECT_EQ(signature(cube()), signature(buildCasters(kCubeCorners, flipped)));
}

TEST(Silhouette, OfASolidCountsAllFacesForALightInsideOrOnIt) {
  const CasterSet casters = cube();
  for (const Vec3& light : {Vec3(0.5, 0.4, 0.3), Vec3(0, 0, 1), Vec3(0.5, 0.5, 1), Vec3(1, 0.5, 1)}) {
    const Silhouette s = findSilhouette(casters, Vec4(light, 1.0));
    EXPECT_EQ(s.side, findSilhouette(casters, Vec4(light, 1.0), kEverySurface).side);
    EXPECT_GT(countSurfaces(casters, s, {0.51, 0.43, -3}).count, 0);
  }
}

TEST(ConvexSolids, AreClosedAndHaveAnInside) {
  const auto isSolid = [](const CasterSet& c) {
    return !c.outward.empty() && std::all_of(c.outward.begin(), c.outward.end(), [](int v) { return v != 0; });
  };
  EXPECT_TRUE(isSolid(cube()));
  auto open = kCubeFaces;
  open.pop_back();
  EXPECT_FALSE(isSolid(buildCasters(kCubeCorners, open)));
  auto dented = kCubeCorners;
  dented[6] = {0.4f, 0.4f, 0.4f};
  EXPECT_FALSE(isSolid(buildCasters(dented, kCubeFaces)));
  auto flat = kCubeCorners;
  for (Vec3f& p : flat) p.z = 0.25f * p.x;
  EXPECT_FALSE(isSolid(buildCasters(flat, kCubeFaces)));
  // Turned and carried off, its faces are plane only up to rounding.
  auto turned = kCubeCorners;
  for (Vec3f& p : turned) {
    p = Vec3f(0.36f * p.x - 0.48f * p.y + 0.8f * p.z, 0.8f * p.x + 0.6f * p.y,
              -0.48f * p.x + 0.64f * p.y + 0.6f * p.z) +
        Vec3f(100.3f, 7.7f, -31.1f);
  }
  EXPECT_TRUE(isSolid(buildCasters(turned, kCubeFaces)));
}

// Leaving out averted faces never changes where shadow is.
RC_GTEST_PROP(ConvexSolids, HideTheSameWithAndWithoutTheirAvertedFaces, ()) {
  Soup soup;
  for (int box = 0; box < 3; ++box) {
    const Vec3f low = latticePoint(4), size = glm::abs(latticePoint(3)) + Vec3f(1.0f);
    const auto base = static_cast<std::uint32_t>(soup.positions.size());
    for (const Vec3f& c : kCubeCorners) soup.positions.push_back(low + c * size);
    for (const mesh::Triangle& t : kCubeFaces) soup.triangles.push_back({base + t[0], base + t[1], base + t[2]});
  }
  const CasterSet casters = buildCasters(soup.positions, soup.triangles);
  const Vec4 light = latticeLight();
  const Vec3 point = Vec3(latticePoint(8)) + Vec3(0.3113, 0.2371, 0.1709);
  const SurfaceCount every = countSurfaces(casters, findSilhouette(casters, light, kEverySurface), point);
  RC_PRE(every.unclear == 0);
  RC_ASSERT((countSurfaces(casters, findSilhouette(casters, light), point).count > 0) == (every.count > 0));
}

// Sides and caps together are a closed surface: every directed edge is run as often one way as the other.
RC_GTEST_PROP(Volume, IsWatertightForAnySoup, ()) {
  const Soup soup = latticeSoup();
  const CasterSet casters = buildCasters(soup.positions, soup.triangles);
  Vec4 light = latticeLight();
  light.w = 1.0;  // with a direction all far vertices are one point; the point light's index structure covers both
  const ShadowVolume volume = extrude(casters, findSilhouette(casters, light));
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> flow;
  for (const auto* list : {&volume.sides, &volume.caps}) {
    for (std::size_t i = 0; i < list->size(); i += 3) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto a = (*list)[i + k], b = (*list)[i + (k + 1) % 3];
        ++flow[{a, b}];
        --flow[{b, a}];
      }
    }
  }
  for (const auto& [edge, sum] : flow) RC_ASSERT(sum == 0);
}

// --- counting ------------------------------------------------------------------------------------------------------------

// Independent rule: crossings of the open segment with the closed triangle's interior, by exact integers. `sure` is cleared
// when the segment touches a border or the plane contains an end.
int exactCrossings(const Soup& soup, const Vec3f& point, const Vec4& light, bool& sure) {
  using I = long long;
  using V = std::array<I, 3>;
  const auto toInt = [](const auto& v) { return V{I(v.x), I(v.y), I(v.z)}; };
  const auto sub = [](V a, V b) { return V{a[0] - b[0], a[1] - b[1], a[2] - b[2]}; };
  const auto det = [](V a, V b, V c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  };
  const auto sign = [](I v) { return (v > 0) - (v < 0); };
  const V p = toInt(point), l = toInt(light);
  const V direction = light.w == 0.0 ? l : sub(l, p);
  int count = 0;
  for (const mesh::Triangle& t : soup.triangles) {
    const V a = sub(toInt(soup.positions[t[0]]), p), b = sub(toInt(soup.positions[t[1]]), p),
            c = sub(toInt(soup.positions[t[2]]), p);
    const int here = sign(-det(a, b, c));  // side of the point itself
    V toLight = light.w == 0.0 ? l : sub(toInt(light), p);
    const I lightVolume =
        light.w == 0.0 ? det(sub(b, a), sub(c, a), toLight) : det(sub(b, a), sub(c, a), sub(toLight, a));
    const int there = sign(lightVolume);
    const int uv = sign(det(direction, a, b)), vw = sign(det(direction, b, c)), wu = sign(det(direction, c, a));
    if (there == 0) continue;  // edge-on to the light
    if (uv == 0 || vw == 0 || wu == 0) {
      sure = false;
      continue;
    }
    if (here == 0) continue;
    count += here != there && uv == vw && vw == wu;
  }
  return count;
}

RC_GTEST_PROP(CountSurfaces, EqualsExactCrossingsOnALattice, ()) {
  const Soup soup = latticeSoup();
  const CasterSet casters = buildCasters(soup.positions, soup.triangles);
  const Vec3f point = latticePoint(6);
  const Vec4 light = latticeLight();
  bool sure = true;
  const int expected = exactCrossings(soup, point, light, sure);
  RC_PRE(sure);
  const SurfaceCount counted = countSurfaces(casters, findSilhouette(casters, light, kEverySurface), Vec3(point));
  RC_ASSERT(counted.unclear == 0);
  RC_ASSERT(counted.count == expected);
}

// A corner of a volume in homogeneous coordinates.
Vec4 volumeVertex(const CasterSet& casters, const Vec4& light, std::uint32_t i) {
  const Vec3 p = casters.position(i / 2);
  return i % 2 == 0 ? Vec4(p, 1.0) : Vec4(p * light.w - Vec3(light), 0.0);
}

// The volume's own winding number around a point: signed crossings of sides and near caps with a ray, or nothing when the ray
// ends in a far cap, at infinity. Checks that the extruded surface encloses exactly the points that the counting rule says.
std::optional<int> windingNumber(const CasterSet& casters, const Vec4& light, const Vec3& point,
                                 const Vec3& direction) {
  const ShadowVolume volume = extrude(casters, findSilhouette(casters, light));
  const auto det4 = [](const Vec4& a, const Vec4& b, const Vec4& c, const Vec4& d) {
    return glm::determinant(Mat4(a, b, c, d));
  };
  int sum = 0;
  const Vec4 p(point, 1.0), d(direction, 0.0);
  for (const auto* list : {&volume.sides, &volume.caps}) {
    for (std::size_t i = 0; i < list->size(); i += 3) {
      const Vec4 a = volumeVertex(casters, light, (*list)[i]), b = volumeVertex(casters, light, (*list)[i + 1]),
                 c = volumeVertex(casters, light, (*list)[i + 2]);
      if (a.w + b.w + c.w == 0.0) {
        const Mat3 cone{Vec3(a), Vec3(b), Vec3(c)};
        const Vec3 inside = glm::inverse(cone) * direction;
        if (glm::determinant(cone) != 0.0 && inside.x >= 0 && inside.y >= 0 && inside.z >= 0) return std::nullopt;
        continue;
      }
      // The ray p + t d, t > 0, meets the homogeneous triangle iff p = alpha a + beta b + gamma c - t d with all four > 0.
      const double whole = det4(a, b, c, d);
      const double alpha = det4(p, b, c, d) / whole, beta = det4(a, p, c, d) / whole, gamma = det4(a, b, p, d) / whole,
                   t = -det4(a, b, c, p) / whole;
      if (whole != 0.0 && alpha > 0 && beta > 0 && gamma > 0 && t > 0) sum += whole < 0 ? 1 : -1;  // leaving counts +1
    }
  }
  return sum;
}

RC_GTEST_PROP(Volume, EnclosesEveryPointAsOftenAsSurfacesCoverIt, ()) {
  const Soup soup = latticeSoup();
  const CasterSet casters = buildCasters(soup.positions, soup.triangles);
  const Vec4 light = latticeLight();
  // Off the lattice, so that nothing is touched.
  const Vec3 point = Vec3(latticePoint(6)) + Vec3(0.3113, 0.2371, 0.1709);
  const Vec3 direction = glm::normalize(Vec3(0.4137, -0.5231, 0.7451));
  const SurfaceCount counted = countSurfaces(casters, findSilhouette(casters, light), point);
  RC_PRE(counted.unclear == 0);
  const auto winding = windingNumber(casters, light, point, direction);
  RC_PRE(winding.has_value());
  RC_ASSERT(*winding == counted.count);
}

// --- the eye count -------------------------------------------------------------------------------------------------------

TEST(EyeCount, CountsTheWallsOfACubeBetweenEyeAndLight) {
  const CasterSet casters = cube();
  const Vec4 light(0.4, 0.3, 9, 1);
  EXPECT_EQ(countAtEye(casters, findSilhouette(casters, light, kEverySurface), {0.45, 0.35, -5}).count, 2);
  const Silhouette s = findSilhouette(casters, light);
  EXPECT_EQ(countAtEye(casters, s, {0.45, 0.35, -5}).count, 1);
  EXPECT_EQ(countAtEye(casters, s, {0.45, 0.35, 0.5}).count, 1);
  EXPECT_EQ(countAtEye(casters, s, {5, 5, -5}).count, 0);
}

TEST(EyeCount, LeavesACasterThatHoldsTheEyeToZFail) {
  const CasterSet casters = cube();
  const Silhouette s = findSilhouette(casters, {0.2, 0.3, 9, 1});
  EXPECT_EQ(countAtEye(casters, s, {0.45, 0.35, 1.0}).byZFailCount, 1u);   // on the lit top
  EXPECT_EQ(countAtEye(casters, s, {0.45, 0.35, 1.01}).byZFailCount, 0u);  // above it
  EXPECT_EQ(countAtEye(casters, s, {0.45, 0.35, 0.99}).byZFailCount, 0u);  // inside
}

TEST(EyeCount, IsRightWhereTheSegmentRunsThroughInnerCornersAndEdges) {
  // A fan around the origin, seen along its axis: the segment from the eye to the light goes through the inner corner.
  std::vector<Vec3f> p{{0, 0, 0}};
  std::vector<mesh::Triangle> t;
  for (std::uint32_t i = 0; i < 8; ++i) {
    p.push_back({float(std::cos(i * 0.785398)), float(std::sin(i * 0.785398)), 0});
    t.push_back({0, 1 + i, 1 + (i + 1) % 8});
  }
  const CasterSet fan = buildCasters(p, t);
  EXPECT_EQ(countAtEye(fan, findSilhouette(fan, {0, 0, 5, 1}), {0, 0, -5}).count, 1);
  EXPECT_EQ(countAtEye(fan, findSilhouette(fan, {0, 0, 1, 0}), {0, 0, -5}).count, 1);
  EXPECT_EQ(countAtEye(fan, findSilhouette(fan, {0.5, 0, 5, 1}), {0.5, 0, -5}).count, 1);
}

TEST(EyeCount, HandsCastersNearTheEyeToZFail) {
  const CasterSet casters = cube();
  const Silhouette s = findSilhouette(casters, {0.5, 0.5, 9, 1});
  const EyeCount away = countAtEye(casters, s, {4, 4, 0});
  EXPECT_EQ(away.byZFailCount, 0u);
  // On the plane of the side below the upper edge x = 1: the quad spreads from (1, y, 1) away from the light.
  const Vec3 edgePoint(1, 0.5, 1), fromLight = edgePoint - Vec3(0.5, 0.5, 9);
  const Vec3 onSide = edgePoint + 0.7 * fromLight;
  EXPECT_EQ(countAtEye(casters, s, onSide).byZFailCount, 1u);
  EXPECT_EQ(countAtEye(casters, s, onSide).count, 0);
  EXPECT_EQ(countAtEye(casters, s, onSide + Vec3(1e-5, 0, 0)).byZFailCount, 1u);
  EXPECT_EQ(countAtEye(casters, s, onSide + Vec3(0.1, 0, 0)).byZFailCount, 0u);
  // In the quad's plane but before the edge: not near the bounded side.
  EXPECT_EQ(countAtEye(casters, s, edgePoint - 0.3 * fromLight).byZFailCount, 0u);
}

// --- layering ------------------------------------------------------------------------------------------------------------

// On lattices, where eyes stand in planes, on edges and at corners.
TEST(EyeCount, AsksBoxesForAllThatItMayTouchOrCount) {
  std::size_t between = 0, all = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    test_meshes::Random random(seed);
    const auto mesh = test_meshes::latticeSoup(random);
    const auto soup = mesh.casters();
    const Vec4 light = test_meshes::latticeLight(random, mesh);
    const auto silhouette = findSilhouette(soup, light, kEverySurface);
    for (int i = 0; i < 8; ++i) {
      const Vec3 eye = Vec3(test_meshes::latticePoint(random, 8)) * (i % 2 == 0 ? 1.0 : 0.5);
      const auto boxes = boxesBetween(soup, light, eye);
      const auto touched = touchesEye(soup, silhouette, eye);
      for (std::uint32_t c = 0; c < soup.componentCount; ++c) {
        ++all;
        between += boxes[c];
        ASSERT_LE(touched.byZFail[c], boxes[c]) << seed;
      }
      EXPECT_EQ(countSurfaces(soup, silhouette, eye, boxes).count, 0) << seed;
    }
  }
  EXPECT_GT(between, 100u);
  EXPECT_LT(between, all - 100);
}

TEST(LayeringBound, IsExactForAStackAndForAFence) {
  Soup stack;
  for (std::uint32_t i = 0; i < 300; ++i) {
    for (const Vec3f& c : {Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0)})
      stack.positions.push_back(c + Vec3f(0, 0, float(i)));
    stack.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const CasterSet layers = buildCasters(stack.positions, stack.triangles);
  EXPECT_EQ(layeringBound(layers, findSilhouette(layers, {0, 0, 1, 0})), 300);
  EXPECT_EQ(layeringBound(layers, findSilhouette(layers, {0.3, 0.3, 900, 1})), 300);
  EXPECT_LT(layeringBound(layers, findSilhouette(layers, {0.9, 0.1, 0.01, 0}), 5), 12);  // almost from the side

  Soup fence;  // separate boxes side by side: seen from the front no ray meets two
  for (std::uint32_t i = 0; i < 100; ++i) {
    for (const Vec3f& c : kCubeCorners) fence.positions.push_back(c + Vec3f(2.0f * float(i), 0, 0));
    for (const mesh::Triangle& t : kCubeFaces) fence.triangles.push_back({8 * i + t[0], 8 * i + t[1], 8 * i + t[2]});
  }
  const CasterSet posts = buildCasters(fence.positions, fence.triangles);
  EXPECT_EQ(layeringBound(posts, findSilhouette(posts, {0, 1, 0.2, 0}), 0), 1);
  EXPECT_GT(layeringBound(posts, findSilhouette(posts, {1, 0.0001, 0.0001, 0}), 0), 90);
}

TEST(LayeringBound, IsNotSpoiltByAStrayTriangle) {
  Soup fence;
  for (std::uint32_t i = 0; i < 100; ++i) {
    for (const Vec3f& c : kCubeCorners) fence.positions.push_back(c + Vec3f(2.0f * float(i), 0, 0));
    for (const mesh::Triangle& t : kCubeFaces) fence.triangles.push_back({8 * i + t[0], 8 * i + t[1], 8 * i + t[2]});
  }
  for (const Vec3f& c : {Vec3f(3e7f, 0, 0), Vec3f(3e7f, 1e6f, 2e6f), Vec3f(2e7f, 1e6f, -4e6f)})
    fence.positions.push_back(c);
  fence.triangles.push_back({800, 801, 802});
  const CasterSet posts = buildCasters(fence.positions, fence.triangles);
  EXPECT_LE(layeringBound(posts, findSilhouette(posts, {0, 1, 0.2, 0}), 0), 4);
  EXPECT_LE(layeringBound(posts, findSilhouette(posts, {100, 300, 10, 1}), 0), 4);
}

RC_GTEST_PROP(LayeringBound, IsNeverTooSmall, ()) {
  const Soup soup = latticeSoup();
  const CasterSet casters = buildCasters(soup.positions, soup.triangles);
  const Silhouette s = findSilhouette(casters, latticeLight(), {.countEverySurface = *rc::gen::inRange(0, 2) == 1});
  const int bound = layeringBound(casters, s, *rc::gen::inRange(0, 4));
  for (int i = 0; i < 8; ++i) {
    const Vec3 point = Vec3(latticePoint(7)) + Vec3(0.3113, 0.2371, 0.1709);
    RC_ASSERT(countSurfaces(casters, s, point).count <= bound);
  }
}

RC_GTEST_PROP(GroupLayers, KeepsEveryGroupWithinTheLimitAndLosesNoShadow, ()) {
  const Soup soup = latticeSoup();
  const CasterSet casters = buildCasters(soup.positions, soup.triangles);
  const Silhouette s = findSilhouette(casters, latticeLight(), {.countEverySurface = *rc::gen::inRange(0, 2) == 1});
  const int limit = *rc::gen::inRange(1, 4);
  const LayerGroups groups = groupLayers(casters, s, limit);
  for (int i = 0; i < 4; ++i) {
    const Vec3 point = Vec3(latticePoint(7)) + Vec3(0.3113, 0.2371, 0.1709);
    int sum = 0;
    for (int g = 0; g < groups.count; ++g) {
      const int part = countSurfaces(casters, restrictTo(casters, s, groups, g), point).count;
      RC_ASSERT(part <= limit);
      sum += part;
    }
    RC_ASSERT(sum == countSurfaces(casters, s, point).count);
  }
}

// --- facing, masks, pictures ---------------------------------------------------------------------------------------------

TEST(Facing, IsTheSameSideForEyeAndLight) {
  scene::Scene s;
  auto m = std::make_shared<mesh::Mesh>();
  m->positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  m->triangles = {{0, 1, 2}};
  s.meshes = {m};
  s.materials = {{}};
  s.instances = {{"t", 0}};
  const auto surfaces = scene::flatten(s);
  const auto facing = [&](const Vec4& eye, const Vec4& light) {
    return visibleSideFacesLight(surfaces, eye, light)[0];
  };
  EXPECT_EQ(facing({0, 0, 5, 1}, {0, 0, 1, 0}), 1);
  EXPECT_EQ(facing({0, 0, -5, 1}, {0, 0, 1, 0}), 0);
  EXPECT_EQ(facing({0, 0, -5, 1}, {0, 0, -9, 1}), 1);
  EXPECT_EQ(facing({0, 0, 5, 1}, {1, 0, 0, 0}), 0);  // edge-on
}

LightMask maskOf(int width, int height, std::uint8_t light) {
  return {image::GreyImage(width, height, light), {}, image::GreyImage(width, height, 1)};
}

TEST(LightMask, IsWrittenWithItsOwnCodeForNoSurface) {
  LightMask m = maskOf(2, 1, 255);
  m.covered(1, 0) = 0;
  m.light(1, 0) = 0;
  EXPECT_EQ(fileImage(m)(0, 0), 255);
  EXPECT_EQ(fileImage(m)(1, 0), 128);
}

TEST(LightMask, ForgivesOnlyPixelsNearAnEdge) {
  LightMask truth = maskOf(16, 1, 255);
  for (int x = 8; x < 16; ++x) truth.light(x, 0) = 0;
  const auto edges = edgePixels(truth);
  EXPECT_EQ(edges(7, 0), 255);
  EXPECT_EQ(edges(8, 0), 255);
  EXPECT_EQ(edges(9, 0), 0);
  LightMask shifted = truth;
  shifted.light(8, 0) = 255;
  EXPECT_EQ(compare(shifted, truth, edges).differing, 1u);
  EXPECT_EQ(compare(shifted, truth, edges).farFromEdge, 0u);
  shifted.light(12, 0) = 255;
  EXPECT_EQ(compare(shifted, truth, edges).farFromEdge, 1u);
}

TEST(Averaged, MixesLightAndNotCodes) {
  image::RgbImage stripes(4, 2);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; x += 2) stripes(x, y) = {255, 255, 255};
  const auto mixed = averaged(stripes, 2);
  EXPECT_EQ(mixed.width(), 2);
  EXPECT_EQ(mixed(1, 0).g, 188);  // half the light of white
  EXPECT_EQ(averaged(stripes, 1), stripes);
}

TEST(Srgb, RoundTripsEveryCode) {
  for (int code = 0; code < 256; ++code) EXPECT_EQ(encodeSrgb(decodeSrgb(std::uint8_t(code))), code);
  EXPECT_EQ(encodeSrgb(std::nan("")), 0);
  EXPECT_EQ(encodeSrgb(7.0), 255);
}

}  // namespace
}  // namespace umbrage::shadow

#include "umbrage/shadow/reach.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <map>

#include "umbrage/shadow/volume.hpp"

namespace umbrage::shadow {
namespace {

Vec3f latticePoint(int reach) {
  const auto coordinate = rc::gen::inRange(-reach, reach + 1);
  return {float(*coordinate), float(*coordinate), float(*coordinate)};
}

CasterSet latticeSoup() {
  std::vector<Vec3f> positions(*rc::gen::inRange<std::size_t>(3, 12));
  for (Vec3f& p : positions) p = latticePoint(4);
  const auto corner = rc::gen::inRange<std::uint32_t>(0, static_cast<std::uint32_t>(positions.size()));
  std::vector<mesh::Triangle> triangles(*rc::gen::inRange<std::size_t>(0, 16));
  for (mesh::Triangle& t : triangles) t = {*corner, *corner, *corner};
  return buildCasters(positions, triangles);
}

// Also from far outside, where more planes serve.
Vec4 latticeLight() {
  const Vec3 p = Vec3(latticePoint(6)) * double(*rc::gen::element(1, 3));
  return {p, *rc::gen::inRange(0, 2) == 1 || p == Vec3(0.0) ? 1.0 : 0.0};
}

Box3 latticeRoom() {
  Box3 room;
  room.add(Vec3(latticePoint(8)));
  room.add(Vec3(latticePoint(8)));
  return room;
}

// How often a surface of homogeneous triangles is crossed from `point` along `direction`, leaving counted +1; `endless`: the
// ray may leave through a triangle at infinity.
int windingNumber(const std::vector<std::array<Vec4, 3>>& triangles, const Vec3& point, const Vec3& direction,
                  bool& endless) {
  const auto det = [](const Vec4& a, const Vec4& b, const Vec4& c, const Vec4& d) {
    return glm::determinant(Mat4(a, b, c, d));
  };
  int sum = 0;
  const Vec4 p(point, 1.0), d(direction, 0.0);
  for (const auto& [a, b, c] : triangles) {
    if (a.w + b.w + c.w == 0.0) {
      const Mat3 cone{Vec3(a), Vec3(b), Vec3(c)};
      if (glm::determinant(cone) == 0.0) continue;
      const Vec3 inside = glm::inverse(cone) * direction;
      endless = endless || (inside.x >= 0 && inside.y >= 0 && inside.z >= 0);
      continue;
    }
    const double whole = det(a, b, c, d);
    const double alpha = det(p, b, c, d) / whole, beta = det(a, p, c, d) / whole, gamma = det(a, b, p, d) / whole,
                 t = -det(a, b, c, p) / whole;
    if (whole != 0.0 && alpha > 0 && beta > 0 && gamma > 0 && t > 0) sum += whole < 0 ? 1 : -1;
  }
  return sum;
}

std::vector<std::array<Vec4, 3>> corners(const CasterSet& casters, const Vec4& light, const Reach& reach,
                                         const ShadowVolume& volume) {
  const auto vertex = [&](std::uint32_t i) {
    const Vec3 p = casters.position(i / 2);
    return i % 2 == 0 ? Vec4(p, 1.0) : farPoint(reach, casters.componentOfPosition[i / 2], p, light);
  };
  std::vector<std::array<Vec4, 3>> out;
  for (const auto* list : {&volume.sides, &volume.caps})
    for (std::size_t i = 0; i < list->size(); i += 3)
      out.push_back({vertex((*list)[i]), vertex((*list)[i + 1]), vertex((*list)[i + 2])});
  return out;
}

RC_GTEST_PROP(Reach, VolumesEncloseEveryPointOfTheRoomAsOftenAsSurfacesCoverIt, ()) {
  const CasterSet casters = latticeSoup();
  const Vec4 light = latticeLight();
  Box3 room = latticeRoom();
  const Vec3 point = Vec3(latticePoint(6)) + Vec3(0.3113, 0.2371, 0.1709);
  room.add(point);
  const Reach reach = reachWithin(casters, light, room);
  const Silhouette silhouette = findSilhouette(casters, light);
  const SurfaceCount counted = countSurfaces(casters, silhouette, point);
  RC_PRE(counted.unclear == 0);
  bool endless = false;
  const ShadowVolume volume = extrude(casters, silhouette, {.reach = &reach});
  const int winding = windingNumber(corners(casters, light, reach, volume), point,
                                    glm::normalize(Vec3(0.4137, -0.5231, 0.7451)), endless);
  RC_PRE(!endless);
  RC_ASSERT(winding == counted.count);
}

RC_GTEST_PROP(Reach, VolumesStayWatertight, ()) {
  const CasterSet casters = latticeSoup();
  const Vec4 light = latticeLight();
  const Reach reach = reachWithin(casters, light, latticeRoom());
  const ShadowVolume volume = extrude(casters, findSilhouette(casters, light), {.reach = &reach});
  // All far vertices of an endless component of a directional light are one point.
  const auto name = [&](std::uint32_t i) {
    const bool onePoint = light.w == 0.0 && i % 2 == 1 && reach.isEndless(casters.componentOfPosition[i / 2]);
    return onePoint ? std::uint32_t{1} : i;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> flow;
  for (const auto* list : {&volume.sides, &volume.caps})
    for (std::size_t i = 0; i < list->size(); i += 3)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto a = name((*list)[i + k]), b = name((*list)[i + (k + 1) % 3]);
        ++flow[{a, b}];
        --flow[{b, a}];
      }
  for (const auto& [edge, sum] : flow) RC_ASSERT(sum == 0);
}

RC_GTEST_PROP(Reach, FarVerticesLieOutsideTheRoom, ()) {
  const CasterSet casters = latticeSoup();
  const Vec4 light = latticeLight();
  const Vec3 eye(latticePoint(8));
  Box3 room = latticeRoom();
  room.add(casters.bounds);
  const Reach reach = reachWithin(casters, light, room);
  const std::vector<Vec4f> points = farPoints(casters, reach, light, eye);
  for (const mesh::Triangle& t : casters.triangles)
    for (const std::uint32_t i : t) {
      if (points[i].w == 0.0f) continue;
      const Vec3 p = Vec3(points[i]) + eye;
      RC_ASSERT(glm::any(glm::lessThan(p, room.min)) || glm::any(glm::greaterThan(p, room.max)));
    }
}

CasterSet cubeAt(const Vec3f& low) {
  std::vector<Vec3f> positions;
  for (int i = 0; i < 8; ++i) positions.push_back(low + Vec3f(float(i & 1), float((i >> 1) & 1), float((i >> 2) & 1)));
  const std::vector<mesh::Triangle> faces{{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                          {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return buildCasters(positions, faces);
}

TEST(Reach, EndsAtTheNearestPlaneBehindTheCaster) {
  const CasterSet cube = cubeAt({0, 0, 0});
  Box3 room;
  room.add(Vec3(-10, -10, 0));
  room.add(Vec3(10, 10, 5));
  EXPECT_EQ(reachWithin(cube, {0.1, 0.2, 0.9, 0.0}, room).plane[0], 4);    // down to the ground
  EXPECT_EQ(reachWithin(cube, {-0.9, 0.2, 0.05, 0.0}, room).plane[0], 1);  // a low sun: out at +x
  EXPECT_EQ(reachWithin(cube, {0.5, 0.5, -9, 1.0}, room).plane[0], 5);     // a lamp below: up
}

TEST(Reach, IsEndlessAroundALight) {
  const CasterSet cube = cubeAt({0, 0, 0});
  for (const Vec3& light : {Vec3(0.5, 0.5, 0.5), Vec3(0.5, 0.5, 1.0), Vec3(0, 0, 0)})
    EXPECT_TRUE(reachWithin(cube, Vec4(light, 1.0), {}).isEndless(0));
  EXPECT_EQ(reachWithin(cube, {0.5, 0.5, 0.5, 1.0}, {}).endlessCount(), 1u);
  const std::array<std::uint8_t, 1> asked{1};
  EXPECT_TRUE(reachWithin(cube, {0, 0, 1, 0}, {}, asked).isEndless(0));
  EXPECT_FALSE(reachWithin(cube, {0, 0, 1, 0}, {}).isEndless(0));
}

}  // namespace
}  // namespace umbrage::shadow

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "umbrage/scene/camera.hpp"
#include "umbrage/scene/framing.hpp"
#include "umbrage/scene/scene.hpp"
#include "umbrage/scene/surfaces.hpp"

namespace umbrage::scene {
namespace {

Scene oneTriangle(const Vec3& shift = Vec3(0.0)) {
  auto m = std::make_shared<mesh::Mesh>();
  m->positions = {Vec3(1, 0, 0) + shift, Vec3(0, 0, 0) + shift, Vec3(0, 1, 0) + shift};
  m->triangles = {{0, 1, 2}};
  Scene s;
  s.meshes = {m};
  s.materials = {{}};
  s.instances = {{"House/Roof", 0}};
  return s;
}

void expectNear(const Vec3& a, const Vec3& b) { EXPECT_LT(glm::length(a - b), 1e-12); }

TEST(Light, IsValidUpToWhereItsLightIsParallel) {
  EXPECT_TRUE(isValid({.shape = PointLight{{0.9 * kFarthestLight, 0, 0}}}));
  EXPECT_FALSE(isValid({.shape = PointLight{{1.1 * kFarthestLight, 0, 0}}}));
  EXPECT_FALSE(isValid({.shape = SpotLight{{0, 1e300, 1e300}}}));
}

TEST(Frame, EastAndNorthFollowTheContract) {
  expectNear(eastVector(UpAxis::z), {1, 0, 0});
  expectNear(northVector(UpAxis::z), {0, 1, 0});
  expectNear(eastVector(UpAxis::y), {1, 0, 0});
  expectNear(northVector(UpAxis::y), {0, 0, -1});
  // True north 90 degrees clockwise of the frame's north is the frame's east.
  expectNear(northVector(UpAxis::z, Angle::degrees(90)), {1, 0, 0});
  expectNear(eastVector(UpAxis::z, Angle::degrees(90)), {0, -1, 0});
}

TEST(Camera, TheMiddleOfThePictureLooksAtTheTarget) {
  Camera c;
  c.eye = {3, -4, 5};
  c.target = {1, 1, 1};
  c.width = 64;
  c.height = 48;
  const PixelRays rays = pixelRays(c);
  expectNear(glm::normalize(rays.through(32, 24)), glm::normalize(c.target - c.eye));
  EXPECT_GT(glm::dot(rays.through(32, 0), c.up), glm::dot(rays.through(32, 48), c.up));
}

TEST(Camera, SurvivesDegenerateViews) {
  Camera c;
  c.eye = c.target;
  EXPECT_NEAR(glm::length(basis(c).right), 1, 1e-12);
  c.target = c.eye + c.up;
  EXPECT_NEAR(glm::length(basis(c).up), 1, 1e-12);
  c.up = Vec3(0.0);
  EXPECT_NEAR(glm::length(basis(c).up), 1, 1e-12);
}

TEST(FrameAll, LooksFromTheSouthWestAtThirtyDegrees) {
  Box3 box;
  box.add(Vec3(-1.0));
  box.add(Vec3(1.0));
  const Camera c = frameAll(box, UpAxis::z, {}, Angle::degrees(45), 1280, 720);
  const Vec3 from = glm::normalize(c.eye - c.target);
  EXPECT_NEAR(from.z, 0.5, 1e-12);
  EXPECT_NEAR(from.x, from.y, 1e-12);
  EXPECT_LT(from.x, 0);
}

// All corners are inside the picture, and in one direction two of them touch its 94 %.
TEST(FrameAll, FillsThePicture) {
  for (const Vec3 size : {Vec3(2, 2, 2), Vec3(100, 1, 5), Vec3(1, 3, 300), Vec3(60, 60, 0)})
    for (const UpAxis up : {UpAxis::y, UpAxis::z})
      for (const double degrees : {20.0, 45.0, 120.0}) {
        Box3 box;
        box.add(Vec3(7, -8, 9));
        box.add(Vec3(7, -8, 9) + size);
        const Camera c = frameAll(box, up, Angle::degrees(20), Angle::degrees(degrees), 640, 400);
        const CameraBasis b = basis(c);
        const double tangent = tan(0.5 * c.fovY);
        Box3 seen;
        for (int i = 0; i < 8; ++i) {
          const Vec3 corner(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                            i & 4 ? box.max.z : box.min.z);
          const Vec3 v = corner - c.eye;
          const double depth = glm::dot(v, b.forward);
          EXPECT_GT(depth, 0.0);
          seen.add(Vec3(glm::dot(v, b.right) / (depth * tangent * 1.6), glm::dot(v, b.up) / (depth * tangent), 0));
        }
        EXPECT_LE(std::max({seen.max.x, seen.max.y, -seen.min.x, -seen.min.y}), 0.94 + 1e-9);
        if (degrees > 90.0) continue;
        EXPECT_NEAR(std::max(seen.max.x, seen.max.y), 0.94, 1e-9);
        EXPECT_NEAR(std::min(seen.min.x, seen.min.y), -0.94, 1e-9);
      }
}

// A tetrahedron fills less of the picture than its box does, so the camera comes nearer; what is framed too pushes it back.
TEST(FrameScene, IsTighterThanTheBox) {
  auto mesh = std::make_shared<mesh::Mesh>();
  mesh->positions = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 9}};
  mesh->triangles = {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {0, 2, 3}};
  Scene s = oneTriangle();
  s.meshes = {mesh};
  s.instances[0].toWorld = glm::translate(Mat4(1.0), Vec3(100, 200, 0));
  const auto distance = [](const Camera& c) { return glm::length(c.eye - c.target); };
  const Camera tight = frameScene(s, {}, Angle::degrees(45), 640, 400);
  EXPECT_LT(distance(tight), distance(frameAll(bounds(s), s.up, {}, Angle::degrees(45), 640, 400)));
  const CameraBasis b = basis(tight);
  double top = 0.0;
  for (const Vec3& p : mesh->positions) {
    const Vec3 v = p + Vec3(100, 200, 0) - tight.eye;
    const double depth = glm::dot(v, b.forward);
    EXPECT_LE(std::abs(glm::dot(v, b.right)), 0.9401 * 1.6 * tan(0.5 * tight.fovY) * depth);
    top = std::max(top, std::abs(glm::dot(v, b.up)) / (tan(0.5 * tight.fovY) * depth));
  }
  EXPECT_NEAR(top, 0.94, 1e-9);
  Box3 shadows;
  shadows.add(Vec3(90, 190, 0));
  shadows.add(Vec3(110, 210, 0));
  EXPECT_GT(distance(frameScene(s, shadows, Angle::degrees(45), 640, 400)), distance(tight));
  Scene nothing = oneTriangle();
  nothing.instances.clear();
  EXPECT_TRUE(std::isfinite(distance(frameScene(nothing, {}, Angle::degrees(45), 640, 400))));
}

TEST(FindFault, SeesWhatIsBroken) {
  EXPECT_FALSE(findFault(oneTriangle()));
  Scene s = oneTriangle();
  s.instances[0].mesh = 1;
  EXPECT_TRUE(findFault(s));
  s = oneTriangle();
  s.instances[0].toWorld[3][0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(findFault(s));
  s = oneTriangle(Vec3(1e200, 0, 0));
  s.instances[0].toWorld = glm::scale(Mat4(1.0), Vec3(1e200));
  EXPECT_TRUE(findFault(s));
}

TEST(Names, MatchWholePathsAndSingleLevels) {
  EXPECT_TRUE(matchesName("House/Roof", "Roof"));
  EXPECT_TRUE(matchesName("House/Roof", "House/*"));
  EXPECT_TRUE(matchesName("House/Roof", "R??f"));
  EXPECT_FALSE(matchesName("House/Roof", "roof"));
  EXPECT_FALSE(withCasters(oneTriangle(), {"Wall*"}).instances[0].casts);
  EXPECT_TRUE(withCasters(oneTriangle(), {"Wall*", "Roof"}).instances[0].casts);
}

TEST(Ground, ReceivesAndCastsNothing) {
  const Scene s = withGround(oneTriangle(), -2.0);
  EXPECT_FALSE(s.instances.back().casts);
  EXPECT_EQ(bounds(s).min.z, -2.0);
  EXPECT_EQ(bounds(s, true).min.z, 0.0);
  EXPECT_FALSE(findFault(s));
  EXPECT_FALSE(findFault(withGround(Scene{.materials = {{}}})));
}

TEST(Flatten, SortsCornersAndKeepsExactCoordinatesNearTheOrigin) {
  const Surfaces s = flatten(oneTriangle());
  ASSERT_EQ(s.triangles.size(), 1u);
  EXPECT_EQ(s.origin, Vec3(0.0));
  EXPECT_EQ(s.corner(0, 0), Vec3(0, 0, 0));
  EXPECT_EQ(s.corner(0, 1), Vec3(0, 1, 0));
  EXPECT_EQ(s.corner(0, 2), Vec3(1, 0, 0));
}

TEST(Flatten, MovesTheOriginForScenesFarAway) {
  const Surfaces s = flatten(oneTriangle(Vec3(85000.25, 446000.5, 0)));
  EXPECT_EQ(s.corner(0, 2) + s.origin, Vec3(85001.25, 446000.5, 0));
}

TEST(Flatten, DropsWhatCollapsesAndCountsIt) {
  Scene s = oneTriangle();
  s.instances.push_back({"flat", 0, glm::scale(Mat4(1.0), Vec3(0, 1, 1)), true});
  const Surfaces flat = flatten(s);
  EXPECT_EQ(flat.triangles.size(), 1u);
  EXPECT_EQ(flat.dropped, 1u);
  EXPECT_EQ(flat.materials.size(), 1u);
  EXPECT_TRUE(flatten(Scene{.materials = {{}}}).triangles.empty());
}

}  // namespace
}  // namespace umbrage::scene

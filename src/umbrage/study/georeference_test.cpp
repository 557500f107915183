#include "umbrage/study/georeference.hpp"

#include <gtest/gtest.h>

namespace umbrage::study {
namespace {

scene::Scene triangleAt(const Vec3& where, const char* crs) {
  auto mesh = std::make_shared<mesh::Mesh>();
  mesh->positions = {where, where + Vec3(10, 0, 0), where + Vec3(0, 10, 5)};
  mesh->triangles = {{0, 1, 2}};
  scene::Scene scene;
  scene.crs = crs;
  scene.materials.emplace_back();
  scene.meshes.push_back(mesh);
  scene.instances.push_back({"t", 0, Mat4(1.0), true});
  return scene;
}

TEST(Georeference, placeAndNorth) {
  const auto rotterdam = georeferenceOf(triangleAt({91000, 435700, 0}, "EPSG:7415"));
  ASSERT_TRUE(rotterdam) << rotterdam.error().text();
  EXPECT_NEAR(rotterdam->place.latitude.degrees(), 51.906, 0.005);
  EXPECT_NEAR(rotterdam->place.longitude.degrees(), 4.457, 0.005);
  EXPECT_NEAR(rotterdam->trueNorth.degrees(), 0.73, 0.02);
}

TEST(Georeference, yUpScenesHaveNorthAtMinusZ) {
  auto scene = triangleAt({91000, 0, -435700}, "EPSG:28992");
  scene.up = scene::UpAxis::y;
  const auto there = georeferenceOf(scene);
  ASSERT_TRUE(there) << there.error().text();
  EXPECT_NEAR(there->place.latitude.degrees(), 51.906, 0.005);
  EXPECT_EQ(mapPoint({1, 2, 3}, scene::UpAxis::y), Vec2(1, -3));
  EXPECT_EQ(scenePoint({1, -3}, 2, scene::UpAxis::y), Vec3(1, 2, 3));
}

TEST(Georeference, absentOrImpossible) {
  EXPECT_EQ(georeferenceOf(triangleAt({0, 0, 0}, "")).error().message, "has no georeference");
  EXPECT_FALSE(georeferenceOf(triangleAt({0, 0, 0}, "my garden")));
  EXPECT_FALSE(georeferenceOf(scene::Scene{}));
}

}  // namespace
}  // namespace umbrage::study

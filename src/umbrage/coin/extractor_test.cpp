#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/SoPath.h>
#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/actions/SoGetBoundingBoxAction.h>
#include <Inventor/nodes/SoCoordinate3.h>
#include <Inventor/nodes/SoCube.h>
#include <Inventor/nodes/SoSeparator.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "umbrage/coin/detail/extractor.hpp"
#include "umbrage/coin/exact_shadow_group.hpp"
#include "umbrage/shadow/caster_set.hpp"

namespace umbrage::coin::detail {
namespace {

const Registry kEverything{.everything = true, .lights = {}, .objects = {}, .places = {}};

class Extraction : public testing::Test {
 protected:
  void read(const std::string& text, const std::string& header = "#Inventor V2.1 ascii") {
    SoDB::init();
    coin::init();
    const std::string whole = header + "\n" + text;
    SoInput input;
    input.setBuffer(const_cast<char*>(whole.data()), whole.size());
    root_ = hold(SoDB::readAll(&input));
    ASSERT_NE(root_, nullptr);
  }
  Scan scan(const Registry& registry = kEverything, int transparencyType = SoGLRenderAction::BLEND) {
    auto* path = new SoPath(root_.get());
    path->ref();
    Scan scan = extractor_.scan({path, SbViewportRegion(320, 240), &registry, false, transparencyType});
    path->unref();
    return scan;
  }
  /// The opaque triangles of the only shape, as a caster.
  shadow::CasterSet only(const Scan& scan) {
    EXPECT_EQ(scan.shapes.size(), 1u);
    const mesh::Mesh& mesh = *scan.shapes.at(0).triangles->opaque;
    std::vector<Vec3f> positions;
    for (const Vec3& p : mesh.positions) positions.emplace_back(transformPoint(scan.shapes[0].toWorld, p));
    return shadow::buildCasters(positions, mesh.triangles);
  }

  NodeRef root_;
  Extractor extractor_;
};

TEST_F(Extraction, SolidsOfCoinAreClosed) {
  for (const char* solid : {"Cube { }", "Cylinder { }", "Cone { }"}) {
    read(std::string("Separator { ") + solid + "}");
    EXPECT_EQ(only(scan()).report.topology, mesh::Topology::closed) << solid;
  }
  read("Separator { Sphere { } }");  // but for its seam, where sines do not meet to the last bit
  EXPECT_GT(only(scan()).triangles.size(), 200u);
}

TEST_F(Extraction, EveryKindOfFaceSetGivesItsTriangles) {
  const std::string points = "Coordinate3 { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0, 2 0 0, 2 1 0 ] }\n";
  const std::pair<const char*, std::size_t> kinds[] = {
      {"IndexedFaceSet { coordIndex [ 0, 1, 2, 3, -1, 1, 4, 5, 2, -1 ] }", 4},
      {"FaceSet { numVertices [ 4 ] }", 2},
      {"QuadMesh { verticesPerRow 3 verticesPerColumn 2 }", 4},
      {"TriangleStripSet { numVertices [ 5 ] }", 3},
      {"IndexedTriangleStripSet { coordIndex [ 0, 1, 3, 2, -1 ] }", 2},
      {"Complexity { value 0.5 } IndexedFaceSet { vertexProperty VertexProperty { vertex [ 0 0 0, 1 0 0, 0 1 0 ] } "
       "coordIndex [ 0, 1, 2, -1 ] }",
       1},
      {"LineSet { numVertices [ 3 ] }", 0},
      {"PointSet { }", 0},
      {"DrawStyle { style INVISIBLE } FaceSet { numVertices [ 4 ] }", 0},
      {"DrawStyle { style LINES } FaceSet { numVertices [ 4 ] }", 0},
      {"IndexedFaceSet { coordIndex [ 0, 1, 2, -1, -1, 1, 2, -1, 1, 4, 5, 2, -1 ] }", 4},
      {"VRMLIndexedFaceSet { coord VRMLCoordinate { point [ 0 0 0, 1 0 0, 0 1 0 ] } coordIndex [ 0, 1, 2, -1, 0, -1, "
       "2, "
       "1, 0 ] }",
       3},
      {"IndexedFaceSet { coordIndex [ 0, 1, 99, -1 ] }", 0}};
  for (const auto& [text, triangles] : kinds) {
    read("Separator { " + points + text + "}");
    std::size_t found = 0;
    for (const PlacedShape& shape : scan().shapes) found += shape.triangles->opaque->triangles.size();
    EXPECT_EQ(found, triangles) << text;
  }
}

TEST_F(Extraction, NodesOfVrmlAreShapesToo) {
  read(
      "Transform { translation 1 2 3 children Shape { geometry Box { size 2 2 2 } } }\n"
      "Shape { appearance Appearance { material Material { transparency 0.5 } } geometry Sphere { } }\n"
      "DirectionalLight { direction 0 -1 0 } PointLight { location 1 1 1 on FALSE } SpotLight { cutOffAngle 0.5 }",
      "#VRML V2.0 utf8");
  const Scan found = scan();
  ASSERT_EQ(found.shapes.size(), 2u);
  EXPECT_EQ(found.shapes[0].toWorld[3], Vec4(1, 2, 3, 1));
  EXPECT_NE(found.shapes[0].triangles->opaque, nullptr);
  EXPECT_EQ(found.shapes[1].triangles->opaque, nullptr);
  EXPECT_NE(found.shapes[1].triangles->veiled, nullptr);
  ASSERT_EQ(found.lights.size(), 2u);
  EXPECT_TRUE(std::holds_alternative<scene::DirectionalLight>(found.lights[0].light.shape));
  EXPECT_TRUE(std::holds_alternative<scene::SpotLight>(found.lights[1].light.shape));
}

TEST_F(Extraction, TransparencyIsTakenFaceByFace) {
  const std::string faces =
      "Coordinate3 { point [ 0 0 0, 1 0 0, 0 1 0, 0 0 1 ] } MaterialBinding { value PER_FACE_INDEXED }\n"
      "IndexedFaceSet { coordIndex [ 0, 1, 2, -1, 0, 1, 3, -1, 0, 2, 3, -1 ] materialIndex [ 0, 1, 2 ] }";
  read("Separator { Material { transparency [ 0, 0.4, 1 ] diffuseColor [ 1 0 0, 0 1 0, 0 0 1 ] }" + faces + "}");
  const Scan found = scan();
  ASSERT_EQ(found.shapes.size(), 1u);
  EXPECT_EQ(found.shapes[0].triangles->opaque->triangles.size(), 1u);
  EXPECT_EQ(found.shapes[0].triangles->veiled->triangles.size(), 1u);
  EXPECT_EQ(scan(kEverything, SoGLRenderAction::NONE).shapes[0].triangles->opaque->triangles.size(),
            3u);  // drawn as if it were opaque
}

TEST_F(Extraction, ATextureThatLetsLightThroughVeilsAll) {
  read("Separator { Texture2 { image 1 2 4 0xffffffff 0xffffff00 } Cube { } }");
  EXPECT_EQ(scan().shapes.at(0).triangles->opaque, nullptr);
  read("Separator { Texture2 { image 1 2 3 0xffffff 0xffff00 } Cube { } }");
  EXPECT_NE(scan().shapes.at(0).triangles->opaque, nullptr);
}

TEST_F(Extraction, AShapeAtSeveralPlacesIsReadOnce) {
  read(
      "Separator { DEF BALL Sphere { } Translation { translation 3 0 0 } USE BALL Scale { scaleFactor -1 2 1 } USE "
      "BALL }");
  const Scan found = scan();
  ASSERT_EQ(found.shapes.size(), 3u);
  EXPECT_EQ(extractor_.extractions(), 1u);
  EXPECT_EQ(found.shapes[0].triangles, found.shapes[2].triangles);
  EXPECT_EQ(found.shapes[2].toWorld, Mat4(Vec4(-1, 0, 0, 0), Vec4(0, 2, 0, 0), Vec4(0, 0, 1, 0), Vec4(3, 0, 0, 1)));
}

TEST_F(Extraction, WhatAShapeDependsOnHasItReadAgain) {
  read("Separator { Complexity { value 0.2 } Sphere { } Complexity { value 0.9 } Sphere { } }");
  EXPECT_NE(scan().shapes.at(0).triangles->opaque->triangles.size(),
            scan().shapes.at(1).triangles->opaque->triangles.size());
  EXPECT_EQ(extractor_.extractions(), 2u);
  read("Separator { DEF POINTS Coordinate3 { point [ 0 0 0, 1 0 0, 0 1 0 ] } FaceSet { } Material { } FaceSet { } }");
  const std::size_t before = extractor_.extractions();
  (void)scan();
  (void)scan();
  EXPECT_EQ(extractor_.extractions(), before + 2);
}

TEST_F(Extraction, LightsOfEveryKindStandInTheWorld) {
  read(
      "Separator { Translation { translation 0 5 0 }\n"
      "PointLight { location 1 0 0 color 1 0.5 0 intensity 0.5 }\n"
      "SpotLight { location 0 0 1 direction 0 0 -2 cutOffAngle 0.3 }\n"
      "Rotation { rotation 0 0 1 1.5707963 } DirectionalLight { direction 1 0 0 }\n"
      "PointLight { on FALSE } PointLight { intensity 0 } Cube { } }");
  const Scan found = scan();
  ASSERT_EQ(found.lights.size(), 3u);
  const auto& point = std::get<scene::PointLight>(found.lights[0].light.shape);
  EXPECT_EQ(point.position, Vec3(1, 5, 0));
  EXPECT_EQ(found.lights[0].light.intensity, 0.5);
  const auto& spot = std::get<scene::SpotLight>(found.lights[1].light.shape);
  EXPECT_EQ(spot.position, Vec3(0, 5, 1));
  EXPECT_NEAR(spot.cutoff.radians(), 0.3, 1e-6);
  const auto& sun = std::get<scene::DirectionalLight>(found.lights[2].light.shape);
  EXPECT_NEAR(sun.direction.y, 1.0, 1e-6);
}

TEST_F(Extraction, LightsBeyondAllDistancesShineFromTheirDirection) {
  read(
      "Separator { PointLight { location 3e18 0 0 } PointLight { location 0 1e37 0 } SpotLight { location 0 0 -1e16 } "
      "PointLight { location 1e12 0 0 } Cube { } }");
  const Scan found = scan();
  ASSERT_EQ(found.lights.size(), 4u);
  const Vec3 towards[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(scene::homogeneous(found.lights[i].light, Vec3(0.0)), Vec4(towards[i], 0.0));
  EXPECT_EQ(scene::homogeneous(found.lights[3].light, Vec3(0.0)).w, 1.0);
}

TEST_F(Extraction, TransparencyTypesCountWhereTheyStand) {
  const std::string glass = "Material { transparency 0.5 } Cube { }";
  read("Separator { TransparencyType { value NONE } " + glass + "}");
  EXPECT_NE(scan().shapes.at(0).triangles->opaque, nullptr);
  read("Separator { Separator { TransparencyType { value BLEND } " + glass + "} " + glass + "}");
  const Scan found = scan(kEverything, SoGLRenderAction::NONE);
  EXPECT_EQ(found.shapes.at(0).triangles->opaque, nullptr);
  EXPECT_NE(found.shapes.at(1).triangles->opaque, nullptr);
}

TEST_F(Extraction, ShapesBeyondAllMeasureAreLeftOut) {
  read("Separator { Cube { } Coordinate3 { point [ 0 0 0, 1 0 0, 0 1 0 ] } FaceSet { numVertices 3 } }");
  auto* points = static_cast<SoCoordinate3*>(static_cast<SoSeparator*>(root_.get())->getChild(1));
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  for (const float far : {1e14f, 1e16f, 1e38f, kInfinite, -kInfinite, std::numeric_limits<float>::quiet_NaN()}) {
    points->point.set1Value(1, far, 0, 0);
    const Scan found = scan();
    EXPECT_EQ(found.beyond, far == 1e14f ? 0u : 1u) << far;
    EXPECT_EQ(found.shapes.size(), far == 1e14f ? 2u : 1u) << far;
  }
  read("Separator { Cube { } Scale { scaleFactor 1e20 1e20 1e20 } Cube { } }");
  EXPECT_EQ(scan().beyond, 1u);
}

TEST_F(Extraction, TextsReachNoFartherThanTheirLetters) {
  for (const std::string parts : {"FRONT", "SIDES", "ALL"}) {
    read("Separator { Translation { translation 5 0 0 } Text3 { string \"Shade\" parts " + parts + " } }");
    const Scan found = scan();
    if (found.shapes.empty()) continue;
    SoGetBoundingBoxAction bounds(SbViewportRegion(320, 240));
    bounds.apply(root_.get());
    const SbVec3f low = bounds.getBoundingBox().getMin(), high = bounds.getBoundingBox().getMax();
    for (const Vec3& p : found.shapes[0].triangles->opaque->positions) {
      const Vec3 world = transformPoint(found.shapes[0].toWorld, p);
      for (int k = 0; k < 3; ++k) {
        EXPECT_GE(world[k], double(low[k]) - 0.5) << parts;
        EXPECT_LE(world[k], double(high[k]) + 0.5) << parts;
      }
    }
  }
}

TEST_F(Extraction, OfAChangingShapeTheLatestIsKept) {
  read("Separator { Coordinate3 { point [ 0 0 0, 1 0 0, 0 1 0 ] } FaceSet { numVertices 3 } Cube { } }");
  auto* root = static_cast<SoSeparator*>(root_.get());
  for (int i = 0; i < 100; ++i) {
    static_cast<SoCoordinate3*>(root->getChild(0))->point.set1Value(1, 1.0f + float(i), 0, 0);
    static_cast<SoCube*>(root->getChild(2))->height = 1.0f + float(i);
    (void)scan();
    EXPECT_LE(extractor_.kept(), 4u);
  }
  EXPECT_EQ(extractor_.extractions(), 200u);
}

TEST_F(Extraction, ClippingPlanesCut) {
  read(
      "Separator { Translation { translation 1 0 0 } ClipPlane { plane 1 0 0 0.25 } Separator { Scale { scaleFactor -1 "
      "1 1 } DEF BOX Cube { } } Translation { translation 5 0 0 } Cube { } Translation { translation -20 0 0 } Cube { "
      "} "
      "}");
  const Scan found = scan();
  ASSERT_EQ(found.shapes.size(), 2u);  // the third lies beyond
  double low = 1e9, high = -1e9;
  for (const Vec3& p : found.shapes[0].triangles->opaque->positions) {
    const double x = transformPoint(found.shapes[0].toWorld, p).x;
    low = std::min(low, x);
    high = std::max(high, x);
  }
  EXPECT_NEAR(low, 1.25, 1e-6);
  EXPECT_NEAR(high, 2.0, 1e-6);
  EXPECT_EQ(found.shapes[1].triangles->opaque->triangles.size(), 12u);
  EXPECT_EQ(scan().shapes[0].triangles, found.shapes[0].triangles);  // nothing is cut twice
}

TEST_F(Extraction, OnlyWhatIsRegisteredCasts) {
  read("Separator { PointLight { } DEF A Separator { Cube { } } DEF B Separator { Cube { } } }");
  Registry registry;
  registry.objects.push_back(hold(static_cast<SoSeparator*>(root_.get())->getChild(1)));
  const Scan found = scan(registry);
  ASSERT_EQ(found.shapes.size(), 2u);
  EXPECT_TRUE(found.shapes[0].casts);
  EXPECT_FALSE(found.shapes[1].casts);
  EXPECT_TRUE(found.lights.empty());
}

}  // namespace
}  // namespace umbrage::coin::detail

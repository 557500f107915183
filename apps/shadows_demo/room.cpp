#include "room.hpp"

#include <Inventor/nodes/SoCone.h>
#include <Inventor/nodes/SoCoordinate3.h>
#include <Inventor/nodes/SoCube.h>
#include <Inventor/nodes/SoCylinder.h>
#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoQuadMesh.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoShapeHints.h>
#include <Inventor/nodes/SoSphere.h>
#include <Inventor/nodes/SoTranslation.h>

#include <cmath>
#include <initializer_list>
#include <numbers>

namespace umbrage::demo {
namespace {

constexpr float kTurn = 2.0f * std::numbers::pi_v<float>;

SoMaterial* paint(float r, float g, float b) {
  auto* material = new SoMaterial;
  material->diffuseColor.setValue(r, g, b);
  material->ambientColor.setValue(r, g, b);  // so that ambient light shows
  return material;
}

SoSeparator* placed(const SbVec3f& at, SoNode* shape) {
  auto* made = new SoSeparator;
  auto* translation = new SoTranslation;
  translation->translation = at;
  made->addChild(translation);
  made->addChild(shape);
  return made;
}

// A grid of quads, since OpenGL of Coin's time lights corners only.
SoNode* tiles(const SbVec3f& corner, const SbVec3f& along, const SbVec3f& across, int count) {
  auto* made = new SoSeparator;
  auto* points = new SoCoordinate3;
  for (int i = 0, k = 0; i <= count; ++i)
    for (int j = 0; j <= count; ++j, ++k)
      points->point.set1Value(k, corner + along * (float(i) / float(count)) + across * (float(j) / float(count)));
  auto* mesh = new SoQuadMesh;
  mesh->verticesPerColumn = mesh->verticesPerRow = count + 1;
  made->addChild(points);
  made->addChild(mesh);
  return made;
}

SbVec3f knotAt(float t) {
  return {std::sin(t) + 2.0f * std::sin(2.0f * t), std::cos(t) - 2.0f * std::cos(2.0f * t), -std::sin(3.0f * t)};
}

SbVec3f tubeAt(float t, float angle, float radius) {
  SbVec3f forward = knotAt(t + 0.01f) - knotAt(t - 0.01f);
  forward.normalize();
  SbVec3f side = forward.cross(SbVec3f(0, 0, 1));
  side.normalize();
  return knotAt(t) + radius * (std::cos(angle) * side + std::sin(angle) * side.cross(forward));
}

}  // namespace

SoSeparator* makeRoom() {
  constexpr float kHalf = 8.0f, kHeight = 8.0f;
  constexpr int kTiles = 40;
  auto* room = new SoSeparator;
  auto* hints = new SoShapeHints;
  hints->vertexOrdering = SoShapeHints::COUNTERCLOCKWISE;  // lit on both sides
  room->addChild(hints);
  room->addChild(paint(0.75f, 0.72f, 0.65f));
  room->addChild(tiles({-kHalf, 0, kHalf}, {2 * kHalf, 0, 0}, {0, 0, -2 * kHalf}, kTiles));
  room->addChild(paint(0.6f, 0.68f, 0.75f));
  room->addChild(tiles({-kHalf, 0, -kHalf}, {2 * kHalf, 0, 0}, {0, kHeight, 0}, kTiles));
  room->addChild(tiles({-kHalf, 0, kHalf}, {0, 0, -2 * kHalf}, {0, kHeight, 0}, kTiles));
  return room;
}

SoSeparator* makeKnot() {
  constexpr int kAlong = 180, kAround = 20;
  constexpr float kRadius = 0.55f;
  auto* knot = new SoSeparator;
  auto* points = new SoCoordinate3;
  for (int i = 0, k = 0; i <= kAlong; ++i)
    for (int j = 0; j <= kAround; ++j, ++k)
      points->point.set1Value(
          k, tubeAt(kTurn * float(i % kAlong) / kAlong, kTurn * float(j % kAround) / kAround, kRadius));
  auto* hints = new SoShapeHints;
  hints->vertexOrdering = SoShapeHints::COUNTERCLOCKWISE;
  hints->creaseAngle = 1.0f;
  auto* mesh = new SoQuadMesh;
  mesh->verticesPerColumn = kAlong + 1;
  mesh->verticesPerRow = kAround + 1;
  SoMaterial* material = paint(0.85f, 0.4f, 0.2f);
  material->specularColor.setValue(0.4f, 0.4f, 0.4f);
  material->shininess = 0.5f;
  for (SoNode* node : std::initializer_list<SoNode*>{hints, material, points, mesh}) knot->addChild(node);
  return knot;
}

SoSeparator* makeTable() {
  auto* table = new SoSeparator;
  table->addChild(paint(0.35f, 0.55f, 0.35f));
  auto* top = new SoCube;
  top->width = top->depth = 3.0f;
  top->height = 0.2f;
  auto* leg = new SoCylinder;
  leg->radius = 0.12f;
  table->addChild(placed({0, 2.0f, 0}, top));
  for (const float x : {-1.2f, 1.2f})
    for (const float z : {-1.2f, 1.2f}) table->addChild(placed({x, 0.95f, z}, leg));
  table->addChild(paint(0.7f, 0.65f, 0.2f));
  table->addChild(placed({-0.6f, 3.1f, 0}, new SoCone));
  auto* ball = new SoSphere;
  ball->radius = 0.5f;
  table->addChild(placed({0.9f, 2.6f, 0.4f}, ball));
  return table;
}

}  // namespace umbrage::demo

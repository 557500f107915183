#include "umbrage/coin/detail/lights.hpp"

#include <Inventor/VRMLnodes/SoVRMLDirectionalLight.h>
#include <Inventor/VRMLnodes/SoVRMLPointLight.h>
#include <Inventor/VRMLnodes/SoVRMLSpotLight.h>
#include <Inventor/nodes/SoDirectionalLight.h>
#include <Inventor/nodes/SoPointLight.h>
#include <Inventor/nodes/SoSpotLight.h>

#include <algorithm>
#include <numbers>

#include "umbrage/coin/detail/matrices.hpp"

namespace umbrage::coin::detail {
namespace {

using Shape = decltype(scene::Light::shape);

template <class Node>
const Node* as(const SoNode& node) {
  return node.isOfType(Node::getClassTypeId()) ? static_cast<const Node*>(&node) : nullptr;
}

bool isFar(const Vec3& v) { return glm::length(v) > scene::kFarthestLight; }

template <class Node>
Shape spot(const Node& node, const Mat4& m) {
  // OpenGL takes no cone wider than a half space.
  const double cutoff = std::min(double(node.cutOffAngle.getValue()), std::numbers::pi / 2);
  return scene::SpotLight{transformPoint(m, vectorOf(node.location.getValue())),
                          transformVector(m, vectorOf(node.direction.getValue())), Angle::radians(cutoff)};
}

template <class Node>
Shape point(const Node& node, const Mat4& m) {
  return scene::PointLight{transformPoint(m, vectorOf(node.location.getValue()))};
}

template <class Node>
Shape directional(const Node& node, const Mat4& m) {
  return scene::DirectionalLight{transformVector(m, vectorOf(node.direction.getValue()))};
}

std::optional<Shape> shapeOf(const SoNode& node, const Mat4& m) {
  if (const auto* n = as<SoPointLight>(node)) return point(*n, m);
  if (const auto* n = as<SoVRMLPointLight>(node)) return point(*n, m);
  if (const auto* n = as<SoDirectionalLight>(node)) return directional(*n, m);
  if (const auto* n = as<SoVRMLDirectionalLight>(node)) return directional(*n, m);
  if (const auto* n = as<SoSpotLight>(node)) return spot(*n, m);
  if (const auto* n = as<SoVRMLSpotLight>(node)) return spot(*n, m);
  return std::nullopt;
}

// A light beyond all distances shines from its direction. What a spot light's cone leaves dark, OpenGL leaves dark by itself.
Shape broughtNear(const Shape& shape) {
  const auto* lamp = std::get_if<scene::PointLight>(&shape);
  const auto* spot = std::get_if<scene::SpotLight>(&shape);
  if (lamp == nullptr && spot == nullptr) return shape;
  const Vec3& at = lamp != nullptr ? lamp->position : spot->position;
  return isFar(at) ? scene::DirectionalLight{-at} : shape;
}

template <class Node>
void describe(const Node& node, scene::Light& light) {
  const SbColor c = node.color.getValue();
  light.colour = {c[0], c[1], c[2]};
  light.intensity = node.on.getValue() ? node.intensity.getValue() : 0.0;
}

}  // namespace

bool isLight(const SoNode& node) {
  return node.isOfType(SoLight::getClassTypeId()) || node.isOfType(SoVRMLLight::getClassTypeId());
}

std::optional<scene::Light> lightOf(const SoNode& node, const Mat4& toWorld) {
  const auto shape = shapeOf(node, toWorld);
  if (!shape) return std::nullopt;
  scene::Light light;
  light.shape = broughtNear(*shape);
  light.name = node.getName().getString();
  if (const auto* vrml = as<SoVRMLLight>(node))
    describe(*vrml, light);
  else
    describe(static_cast<const SoLight&>(node), light);
  const bool shines = light.intensity > 0.0 && light.colour != Vec3(0.0);
  if (!shines || !scene::isValid(light)) return std::nullopt;
  return light;
}

std::vector<SoSFFloat*> brightnessOf(SoNode& node) {
  if (!node.isOfType(SoVRMLLight::getClassTypeId())) return {&static_cast<SoLight&>(node).intensity};
  auto& light = static_cast<SoVRMLLight&>(node);
  return {&light.intensity, &light.ambientIntensity};
}

scene::Light withoutCone(scene::Light light) {
  if (const auto* spot = std::get_if<scene::SpotLight>(&light.shape)) light.shape = scene::PointLight{spot->position};
  return light;
}

}  // namespace umbrage::coin::detail

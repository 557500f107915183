// Open Inventor and VRML 1 and 97 through Coin, which works in single precision. Names come from DEF.
#include <Inventor/SbViewportRegion.h>
#include <Inventor/SoPath.h>
#include <Inventor/SoPrimitiveVertex.h>
#include <Inventor/VRMLnodes/SoVRMLDirectionalLight.h>
#include <Inventor/VRMLnodes/SoVRMLMaterial.h>
#include <Inventor/VRMLnodes/SoVRMLPointLight.h>
#include <Inventor/VRMLnodes/SoVRMLSpotLight.h>
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/elements/SoLazyElement.h>
#include <Inventor/nodes/SoDirectionalLight.h>
#include <Inventor/nodes/SoGroup.h>
#include <Inventor/nodes/SoInfo.h>
#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoNormal.h>
#include <Inventor/nodes/SoNormalBinding.h>
#include <Inventor/nodes/SoPointLight.h>
#include <Inventor/nodes/SoShape.h>
#include <Inventor/nodes/SoSpotLight.h>
#include <Inventor/nodes/SoTexture.h>
#include <Inventor/nodes/SoTextureCoordinate2.h>
#include <Inventor/nodes/SoTextureCoordinate3.h>
#include <Inventor/nodes/SoTextureCoordinateFunction.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <tuple>

#include "umbrage/inventor/check.hpp"
#include "umbrage/io/reader/inventor_files.hpp"
#include "umbrage/io/reader/read.hpp"

namespace umbrage::io::reader {
namespace {

constexpr std::string_view kNameRemark = "name: ";

Vec3 vectorOf(const SbVec3f& v) { return {v[0], v[1], v[2]}; }
Vec3 colourOf(const SbColor& c) { return linearFromSrgb({c[0], c[1], c[2]}); }

// Coin multiplies row vectors from the left, glm column vectors from the right: the storage is the same.
Mat4 matrixOf(const SbMatrix& given) {
  Mat4 m;
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k) m[i][k] = given[i][k];
  return m;
}

// The node's name, or the one that its first child, an Info "name: ..", gives it in full: Inventor's own names have no blanks.
std::string levelName(const SoNode* node) {
  if (node->isOfType(SoGroup::getClassTypeId())) {
    const auto* group = static_cast<const SoGroup*>(node);
    if (group->getNumChildren() > 0 && group->getChild(0)->isOfType(SoInfo::getClassTypeId())) {
      const std::string text = static_cast<const SoInfo*>(group->getChild(0))->string.getValue().getString();
      if (text.starts_with(kNameRemark)) return text.substr(kNameRemark.size());
    }
  }
  return node->getName().getString();
}

std::string pathOf(const SoPath* path, const SoNode* leaf) {
  const auto* full = static_cast<const SoFullPath*>(path);  // inside node kits too
  std::string name;
  for (int i = 0; i < full->getLength(); ++i) name = childPath(name, levelName(full->getNode(i)));
  return name.empty() ? leaf->getTypeId().getName().getString() : name;
}

class Collector {
 public:
  SoCallbackAction::Response enter(SoCallbackAction* action, const SoNode* shape);
  void addTriangle(SoCallbackAction* action, const SoNode* shape, const SoPrimitiveVertex* const (&corners)[3]);
  void addLight(SoCallbackAction* action, const SoNode* node);
  void nameMaterial(const SoNode* node);
  [[nodiscard]] scene::Scene finish();

 private:
  using Look = std::tuple<float, float, float, float>;
  void beginPart(SoCallbackAction* action, const SoNode* shape);
  void endPart();
  [[nodiscard]] std::uint32_t materialAt(SoCallbackAction* action, int index);

  scene::Scene scene_;
  mesh::Mesh part_;
  scene::Instance placed_;
  const SoNode* shape_ = nullptr;
  std::map<Look, std::uint32_t> materials_;
  std::map<Look, std::string> materialNames_;
  std::size_t brokenShapes_ = 0, nurbs_ = 0;
};

SoCallbackAction::Response Collector::enter(SoCallbackAction* action, const SoNode* shape) {
  endPart();
  using inventor::ShapeVerdict;
  const ShapeVerdict verdict = inventor::judge(action, shape);
  // Coin's callbacks show nodes as const; what is changed in this graph is of no meaning to the scene.
  if (verdict == ShapeVerdict::read) {
    inventor::secureBindings(const_cast<SoNode*>(shape));
    if (inventor::hasShortFaces(*shape)) inventor::fillShortFaces(const_cast<SoNode*>(shape));
  }
  if (verdict == ShapeVerdict::broken) ++brokenShapes_;
  if (verdict == ShapeVerdict::nurbs) ++nurbs_;
  return verdict == ShapeVerdict::read ? SoCallbackAction::CONTINUE : SoCallbackAction::PRUNE;
}

void Collector::beginPart(SoCallbackAction* action, const SoNode* shape) {
  endPart();
  shape_ = shape;
  placed_.toWorld = matrixOf(action->getModelMatrix());
  placed_.name = pathOf(action->getCurPath(), shape);
}

void Collector::endPart() {
  shape_ = nullptr;
  if (part_.triangles.empty()) return;
  placed_.mesh = static_cast<std::uint32_t>(scene_.meshes.size());
  part_.name = placed_.name;
  scene_.meshes.push_back(std::make_shared<const mesh::Mesh>(std::move(part_)));
  scene_.instances.push_back(std::move(placed_));
  part_ = {};
  placed_ = {};
}

void Collector::addTriangle(SoCallbackAction* action, const SoNode* shape,
                            const SoPrimitiveVertex* const (&corners)[3]) {
  if (shape != shape_ || matrixOf(action->getModelMatrix()) != placed_.toWorld) beginPart(action, shape);
  const auto base = static_cast<std::uint32_t>(part_.positions.size());
  for (const SoPrimitiveVertex* corner : corners) part_.positions.push_back(vectorOf(corner->getPoint()));
  part_.triangles.push_back({base, base + 1, base + 2});
  part_.materials.push_back(materialAt(action, corners[0]->getMaterialIndex()));
}

std::uint32_t Collector::materialAt(SoCallbackAction* action, int index) {
  SoState* state = action->getState();
  const SoLazyElement* lazy = SoLazyElement::getInstance(state);
  // Coin reads beyond its arrays for an index beyond them.
  const SbColor colour = SoLazyElement::getDiffuse(state, std::clamp(index, 0, std::max(lazy->getNumDiffuse() - 1, 0)));
  const float clear =
      SoLazyElement::getTransparency(state, std::clamp(index, 0, std::max(lazy->getNumTransparencies() - 1, 0)));
  const auto [at, isNew] = materials_.try_emplace({colour[0], colour[1], colour[2], clear},
                                                  static_cast<std::uint32_t>(scene_.materials.size()));
  if (isNew) scene_.materials.push_back({"", colourOf(colour), 1.0 - clear});
  return at->second;
}

// At a triangle Coin knows a colour but not the node it came from; the first named node of that look gives the name.
void Collector::nameMaterial(const SoNode* node) {
  const std::string name = node->getName().getString();
  if (name.empty()) return;
  if (node->isOfType(SoMaterial::getClassTypeId())) {
    const auto* m = static_cast<const SoMaterial*>(node);
    if (m->diffuseColor.getNum() > 0 && m->transparency.getNum() > 0) {
      const SbColor c = m->diffuseColor[0];
      materialNames_.try_emplace({c[0], c[1], c[2], m->transparency[0]}, name);
    }
  } else {
    const auto* m = static_cast<const SoVRMLMaterial*>(node);
    const SbColor c = m->diffuseColor.getValue();
    materialNames_.try_emplace({c[0], c[1], c[2], m->transparency.getValue()}, name);
  }
}

template <class Node>
bool describe(const SoNode* node, scene::Light& light) {
  if (!node->isOfType(Node::getClassTypeId())) return false;
  const auto* given = static_cast<const Node*>(node);
  light.colour = colourOf(given->color.getValue());
  light.intensity = given->on.getValue() ? given->intensity.getValue() : 0.0;
  return true;
}

template <class Node>
scene::SpotLight spotOf(const SoNode* node, const Mat4& toWorld, float cutoff) {
  const auto* spot = static_cast<const Node*>(node);
  return {transformPoint(toWorld, vectorOf(spot->location.getValue())),
          transformVector(toWorld, vectorOf(spot->direction.getValue())), Angle::radians(cutoff)};
}

void Collector::addLight(SoCallbackAction* action, const SoNode* node) {
  const Mat4 m = matrixOf(action->getModelMatrix());
  scene::Light light;
  if (describe<SoPointLight>(node, light))
    light.shape =
        scene::PointLight{transformPoint(m, vectorOf(static_cast<const SoPointLight*>(node)->location.getValue()))};
  else if (describe<SoVRMLPointLight>(node, light))
    light.shape =
        scene::PointLight{transformPoint(m, vectorOf(static_cast<const SoVRMLPointLight*>(node)->location.getValue()))};
  else if (describe<SoDirectionalLight>(node, light))
    light.shape = scene::DirectionalLight{
        transformVector(m, vectorOf(static_cast<const SoDirectionalLight*>(node)->direction.getValue()))};
  else if (describe<SoVRMLDirectionalLight>(node, light))
    light.shape = scene::DirectionalLight{
        transformVector(m, vectorOf(static_cast<const SoVRMLDirectionalLight*>(node)->direction.getValue()))};
  else if (describe<SoSpotLight>(node, light))
    light.shape = spotOf<SoSpotLight>(node, m, static_cast<const SoSpotLight*>(node)->cutOffAngle.getValue());
  else if (describe<SoVRMLSpotLight>(node, light))
    light.shape = spotOf<SoVRMLSpotLight>(node, m, static_cast<const SoVRMLSpotLight*>(node)->cutOffAngle.getValue());
  else
    return;
  if (light.intensity == 0.0) return;  // switched off
  light.name = pathOf(action->getCurPath(), node);
  scene_.lights.push_back(std::move(light));
}

scene::Scene Collector::finish() {
  endPart();
  for (const auto& [look, index] : materials_) {
    const auto named = materialNames_.find(look);
    scene_.materials[index].name = named != materialNames_.end() ? named->second : "material " + std::to_string(index);
  }
  if (brokenShapes_ > 0)
    scene_.warnings.push_back(counted(brokenShapes_, "shape") + " dropped: more points named than there are");
  if (nurbs_ > 0) scene_.warnings.push_back(counted(nurbs_, "NURBS surface") + " left out: not read");
  return std::move(scene_);
}

SoCallbackAction::Response passOver(void*, SoCallbackAction*, const SoNode*) { return SoCallbackAction::PRUNE; }
SoCallbackAction::Response enterShape(void* self, SoCallbackAction* action, const SoNode* node) {
  return static_cast<Collector*>(self)->enter(action, node);
}
SoCallbackAction::Response meetLight(void* self, SoCallbackAction* action, const SoNode* node) {
  static_cast<Collector*>(self)->addLight(action, node);
  return SoCallbackAction::CONTINUE;
}
SoCallbackAction::Response meetMaterial(void* self, SoCallbackAction*, const SoNode* node) {
  static_cast<Collector*>(self)->nameMaterial(node);
  return SoCallbackAction::CONTINUE;
}
void meetTriangle(void* self, SoCallbackAction* action, const SoPrimitiveVertex* a, const SoPrimitiveVertex* b,
                  const SoPrimitiveVertex* c) {
  const SoPrimitiveVertex* const corners[3] = {a, b, c};
  static_cast<Collector*>(self)->addTriangle(action, action->getCurPathTail(), corners);
}

scene::Scene collect(SoNode* root) {
  Collector collector;
  SoCallbackAction action;
  action.addPreCallback(SoShape::getClassTypeId(), enterShape, &collector);
  action.addPreCallback(SoMaterial::getClassTypeId(), meetMaterial, &collector);
  action.addPreCallback(SoVRMLMaterial::getClassTypeId(), meetMaterial, &collector);
  action.addPreCallback(SoLight::getClassTypeId(), meetLight, &collector);
  action.addPreCallback(SoVRMLLight::getClassTypeId(), meetLight, &collector);
  // Normals and textures are not needed, and Coin trusts the indices into them.
  for (const SoType type : {SoNormal::getClassTypeId(), SoNormalBinding::getClassTypeId(), SoTexture::getClassTypeId(),
                            SoTextureCoordinate2::getClassTypeId(), SoTextureCoordinate3::getClassTypeId(),
                            SoTextureCoordinateFunction::getClassTypeId()})
    action.addPreCallback(type, passOver, nullptr);
  action.addTriangleCallback(SoShape::getClassTypeId(), meetTriangle, &collector);
  action.apply(root);
  return collector.finish();
}

}  // namespace

Result<scene::Scene> readInventor(const Request& request) {
  Complaints complaints;
  SoSeparator* root = readInventorFile(request.file, complaints);
  if (root == nullptr)
    return fail(ErrorCode::input, "cannot be read: " + (complaints.empty() ? "it holds no nodes" : complaints.first()));
  root->ref();
  if (auto fine = inventor::checkGraph(root); !fine) return tl::unexpected(fine.error());
  scene::Scene scene = collect(root);
  scene.up = scene::UpAxis::y;
  complaints.appendTo(scene.warnings);
  return scene;
}

}  // namespace umbrage::io::reader

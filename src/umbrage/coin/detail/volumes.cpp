#include "umbrage/coin/detail/volumes.hpp"

#include <Inventor/nodes/SoCoordinate4.h>
#include <Inventor/nodes/SoDepthBuffer.h>
#include <Inventor/nodes/SoIndexedFaceSet.h>
#include <Inventor/nodes/SoLightModel.h>
#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoPolygonOffset.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoShapeHints.h>
#include <Inventor/nodes/SoTranslation.h>
#include <Inventor/nodes/SoTransparencyType.h>

#include <algorithm>

#include "umbrage/shadow/caster_set.hpp"
#include "umbrage/shadow/volume.hpp"

namespace umbrage::coin::detail {
namespace {

constexpr float kTransparency = 0.75f;

shadow::CasterSet castersOf(const mesh::Mesh& mesh, const Mat3& turn) {
  std::vector<Vec3f> positions;
  for (const Vec3& p : mesh.positions) positions.push_back(Vec3f(turn * p));
  return shadow::buildCasters(positions, mesh.triangles);
}

/// Where a vertex of a volume is. Even: a caster's position; odd: that position carried away from the light.
SbVec4f vertexOf(const shadow::CasterSet& casters, std::uint32_t index, const Vec4& light,
                 std::optional<double> depth) {
  const Vec3 p = casters.position(index / 2);
  const auto near = [](const Vec3& v) { return SbVec4f(float(v.x), float(v.y), float(v.z), 1.0f); };
  if (index % 2 == 0) return near(p + casters.origin);
  const Vec3 away = -scene::towardsLight(light, p);
  if (depth) return near(p + casters.origin + *depth * glm::normalize(away));
  return {float(away.x), float(away.y), float(away.z), 0.0f};
}

SoSeparator* nodesOf(const shadow::CasterSet& casters, const Vec4& light, std::optional<double> depth, Caps caps) {
  shadow::ExtrudeOptions options;
  options.endsAnywhere = depth.has_value();
  options.caps = caps == Caps::both;
  const auto volume = shadow::extrude(casters, shadow::findSilhouette(casters, light), options);
  auto* points = new SoCoordinate4;
  auto* faces = new SoIndexedFaceSet;
  std::vector<std::int32_t> placeOf(2 * casters.positions.size(), -1), corners;
  std::vector<SbVec4f> used;
  for (const auto* part : {&volume.sides, &volume.caps}) {
    for (std::size_t i = 0; i < part->size(); ++i) {
      std::int32_t& place = placeOf[(*part)[i]];
      if (place < 0) {
        place = static_cast<std::int32_t>(used.size());
        used.push_back(vertexOf(casters, (*part)[i], light, depth));
      }
      corners.push_back(place);
      if (i % 3 == 2) corners.push_back(-1);
    }
  }
  points->point.setValues(0, static_cast<int>(used.size()), used.data());
  faces->coordIndex.setValues(0, static_cast<int>(corners.size()), corners.data());
  auto* node = new SoSeparator;
  node->addChild(points);
  node->addChild(faces);
  return node;
}

// Unlit, blended where it stands, hiding nothing.
SoSeparator* emptyRoot(Caps caps) {
  auto* root = new SoSeparator;
  auto* model = new SoLightModel;
  model->model = SoLightModel::BASE_COLOR;
  auto* blended = new SoTransparencyType;
  blended->value = SoTransparencyType::BLEND;
  auto* depth = new SoDepthBuffer;
  depth->write = FALSE;
  auto* hints = new SoShapeHints;  // both sides are seen, and nothing is known of their order
  hints->vertexOrdering = SoShapeHints::UNKNOWN_ORDERING;
  for (SoNode* node : std::initializer_list<SoNode*>{model, blended, depth, hints}) root->addChild(node);
  if (caps == Caps::both) root->addChild(new SoPolygonOffset);  // caps lie in the faces of their casters, and give way
  return root;
}

SoSeparator* groupOf(const scene::Light& light) {
  auto* group = new SoSeparator;
  auto* look = new SoMaterial;
  look->diffuseColor = SbColor(float(light.colour.x), float(light.colour.y), float(light.colour.z));
  look->transparency = kTransparency;
  group->addChild(look);
  return group;
}

SoSeparator* placed(SoNode* volume, const Vec3& at) {
  auto* node = new SoSeparator;
  auto* move = new SoTranslation;
  move->translation = SbVec3f(float(at.x), float(at.y), float(at.z));
  node->addChild(move);
  node->addChild(volume);
  return node;
}

// As seen from a place that only moved: a direction stays what it is.
Vec4 lightFrom(const scene::Light& light, const Vec3& at) { return scene::homogeneous(light, at); }

std::vector<std::shared_ptr<const mesh::Mesh>> castingParts(const PlacedShape& shape, TransparentCasters transparent) {
  std::vector<std::shared_ptr<const mesh::Mesh>> parts;
  if (!shape.casts) return parts;
  if (shape.triangles->opaque != nullptr) parts.push_back(shape.triangles->opaque);
  if (transparent == TransparentCasters::opaque && shape.triangles->veiled != nullptr)
    parts.push_back(shape.triangles->veiled);
  return parts;
}

}  // namespace

struct VolumeMaker::Key {
  std::shared_ptr<const mesh::Mesh> mesh;
  Mat3 turn{1.0};
  Vec4 light{0.0};
  std::optional<double> depth;
  Caps caps = Caps::none;
  friend bool operator==(const Key&, const Key&) = default;
};

struct VolumeMaker::Made {
  Key key;
  NodeRef volume;
  std::size_t lastUsed = 0;
};

VolumeMaker::VolumeMaker() = default;
VolumeMaker::~VolumeMaker() = default;

VolumeMaker::Made& VolumeMaker::volumeOf(const std::shared_ptr<const mesh::Mesh>& mesh, const Mat4& toWorld,
                                         const Vec4& light, const Settings& settings, Caps caps, Work& work) {
  const Key key{mesh, Mat3(toWorld), light, settings.volumeDepth, caps};
  const auto known = std::ranges::find(made_, key, &Made::key);
  if (known != made_.end()) {
    ++work.volumesReused;
    known->lastUsed = turn_;
    return *known;
  }
  ++work.volumes;
  made_.push_back({key, hold(nodesOf(castersOf(*mesh, key.turn), light, key.depth, caps)), turn_});
  return made_.back();
}

SoSeparator* VolumeMaker::build(const Scan& scan, const Settings& settings, Caps caps, Work& work) {
  ++turn_;
  SoSeparator* root = emptyRoot(caps);
  NodeRef owned = hold(root);
  bool any = false;
  for (const PlacedLight& light : scan.lights) {
    SoSeparator* group = groupOf(light.light);
    root->addChild(group);
    for (const PlacedShape& shape : scan.shapes) {
      const Vec3 at(shape.toWorld[3]);
      for (const auto& mesh : castingParts(shape, settings.transparentCasters)) {
        any = true;
        const Made& made = volumeOf(mesh, shape.toWorld, lightFrom(light.light, at), settings, caps, work);
        group->addChild(placed(made.volume.get(), at));
      }
    }
  }
  std::erase_if(made_, [&](const Made& made) { return made.lastUsed != turn_; });
  root_ = std::move(owned);
  return any ? root : nullptr;
}

}  // namespace umbrage::coin::detail

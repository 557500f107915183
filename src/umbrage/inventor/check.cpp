#include "umbrage/inventor/check.hpp"

#include <Inventor/SbName.h>
#include <Inventor/VRMLnodes/SoVRMLCoordinate.h>
#include <Inventor/VRMLnodes/SoVRMLElevationGrid.h>
#include <Inventor/VRMLnodes/SoVRMLIndexedFaceSet.h>
#include <Inventor/VRMLnodes/SoVRMLIndexedLineSet.h>
#include <Inventor/VRMLnodes/SoVRMLPointSet.h>
#include <Inventor/elements/SoCoordinateElement.h>
#include <Inventor/misc/SoChildList.h>
#include <Inventor/nodes/SoFaceSet.h>
#include <Inventor/nodes/SoImage.h>
#include <Inventor/nodes/SoIndexedFaceSet.h>
#include <Inventor/nodes/SoIndexedLineSet.h>
#include <Inventor/nodes/SoIndexedNurbsCurve.h>
#include <Inventor/nodes/SoIndexedNurbsSurface.h>
#include <Inventor/nodes/SoIndexedPointSet.h>
#include <Inventor/nodes/SoIndexedTriangleStripSet.h>
#include <Inventor/nodes/SoLineSet.h>
#include <Inventor/nodes/SoNurbsCurve.h>
#include <Inventor/nodes/SoNurbsSurface.h>
#include <Inventor/nodes/SoPointSet.h>
#include <Inventor/nodes/SoQuadMesh.h>
#include <Inventor/nodes/SoTriangleStripSet.h>
#include <Inventor/nodes/SoVertexProperty.h>

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace umbrage::inventor {
namespace {

constexpr double kMaxNodes = 5e6;

struct Mark {
  bool open = true;    // on the way down from the root at this moment
  double nodes = 1.0;  // below and including this one, following every use
};

struct Step {
  SoNode* node;
  int next = 0;
};

int childCount(SoNode* node) { return node->getChildren() != nullptr ? node->getChildren()->getLength() : 0; }

std::int64_t pointCount(SoCallbackAction* action, const SoVertexShape* shape) {
  const SoNode* own = shape->vertexProperty.getValue();
  if (own != nullptr && own->isOfType(SoVertexProperty::getClassTypeId()))
    if (const int count = static_cast<const SoVertexProperty*>(own)->vertex.getNum(); count > 0) return count;
  return SoCoordinateElement::getInstance(action->getState())->getNum();
}

bool indicesFit(const SoMFInt32& indices, std::int64_t points) {
  for (int i = 0; i < indices.getNum(); ++i)
    if (indices[i] < -1 || indices[i] >= points) return false;
  return true;
}

// A length of -1 means: as many as are left.
bool lengthsFit(const SoMFInt32& lengths, std::int64_t start, std::int64_t points) {
  std::int64_t end = start;
  for (int i = 0; i < lengths.getNum(); ++i) {
    if (lengths[i] < -1) return false;
    if (lengths[i] > 0) end += lengths[i];
  }
  return start >= 0 && end <= points;
}

template <class Node>
const Node* as(const SoNode* node) {
  return node->isOfType(Node::getClassTypeId()) ? static_cast<const Node*>(node) : nullptr;
}

bool vrmlFacesFit(const SoVRMLIndexedFaceSet& faces) {
  const SoNode* coord = faces.coord.getValue();
  const auto* points = coord != nullptr ? as<SoVRMLCoordinate>(coord) : nullptr;
  return points != nullptr && indicesFit(faces.coordIndex, points->point.getNum());
}

bool gridFits(const SoVRMLElevationGrid& grid) {
  const std::int64_t x = grid.xDimension.getValue(), z = grid.zDimension.getValue();
  return x >= 0 && z >= 0 && (x == 0 || z <= grid.height.getNum() / x);
}

bool meshFits(const SoQuadMesh& mesh, std::int64_t points) {
  const std::int64_t rows = mesh.verticesPerColumn.getValue(), columns = mesh.verticesPerRow.getValue();
  const std::int64_t start = mesh.startIndex.getValue();
  return rows >= 0 && columns >= 0 && start >= 0 && start <= points &&
         (columns == 0 || rows <= (points - start) / columns);
}

bool pointsFit(SoCallbackAction* action, const SoNode* shape) {
  if (const auto* faces = as<SoVRMLIndexedFaceSet>(shape)) return vrmlFacesFit(*faces);
  if (const auto* grid = as<SoVRMLElevationGrid>(shape)) return gridFits(*grid);
  if (const auto* faces = as<SoIndexedFaceSet>(shape)) return indicesFit(faces->coordIndex, pointCount(action, faces));
  if (const auto* strips = as<SoIndexedTriangleStripSet>(shape))
    return indicesFit(strips->coordIndex, pointCount(action, strips));
  if (const auto* faces = as<SoFaceSet>(shape))
    return lengthsFit(faces->numVertices, faces->startIndex.getValue(), pointCount(action, faces));
  if (const auto* strips = as<SoTriangleStripSet>(shape))
    return lengthsFit(strips->numVertices, strips->startIndex.getValue(), pointCount(action, strips));
  if (const auto* mesh = as<SoQuadMesh>(shape)) return meshFits(*mesh, pointCount(action, mesh));
  return true;
}

template <class... Nodes>
bool isAny(const SoNode* node) {
  return (node->isOfType(Nodes::getClassTypeId()) || ...);
}

// Coin reads a binding's index for every corner or face, however few there are. The default, a single -1, stands for the
// corners' own indices.
void lengthen(SoMFInt32& indices, const SoMFInt32& corners) {
  const bool standard = indices.getNum() == 0 || (indices.getNum() == 1 && indices[0] < 0);
  for (int i = standard ? 0 : indices.getNum(); i < corners.getNum(); ++i)
    indices.set1Value(i, standard ? corners[i] : 0);
}

constexpr int kFewest = 3;  ///< corners of a face

const SoMFInt32* cornersOf(const SoNode& shape) {
  if (const auto* faces = as<SoIndexedFaceSet>(&shape)) return &faces->coordIndex;
  if (const auto* faces = as<SoVRMLIndexedFaceSet>(&shape)) return &faces->coordIndex;
  return nullptr;
}

/// The entries that make every face with corners have enough of them, each face with the -1 that ends it: its last corner counts again. So faces keep
/// their numbers, by which materials may be bound.
std::vector<int> entriesOfFullFaces(const SoMFInt32& corners) {
  std::vector<int> kept;
  for (int i = 0, first = 0; i <= corners.getNum(); ++i) {
    if (i < corners.getNum() && corners[i] >= 0) continue;
    for (int k = first; k < i; ++k) kept.push_back(k);
    for (int k = i - first; k > 0 && k < kFewest; ++k) kept.push_back(i - 1);
    if (i > first && i < corners.getNum()) kept.push_back(i);
    first = i + 1;
  }
  return kept;
}

void rearrange(SoMFInt32& indices, const std::vector<int>& entries) {
  std::vector<std::int32_t> kept;
  for (const int entry : entries) kept.push_back(indices[entry]);
  indices.setNum(static_cast<int>(kept.size()));
  indices.setValues(0, static_cast<int>(kept.size()), kept.data());
}

}  // namespace

bool hasShortFaces(const SoNode& shape) {
  const SoMFInt32* corners = cornersOf(shape);
  if (corners == nullptr) return false;
  bool isShort = false;
  for (int i = 0, first = 0; i <= corners->getNum(); ++i) {
    if (i < corners->getNum() && (*corners)[i] >= 0) continue;
    const bool enough = i - first >= kFewest;
    if (enough && isShort) return true;
    isShort = isShort || !enough;
    first = i + 1;
  }
  return false;
}

void fillShortFaces(SoNode* shape) {
  shape->enableNotify(FALSE);
  std::vector<SoMFInt32*> lists;
  if (shape->isOfType(SoIndexedFaceSet::getClassTypeId())) {
    auto* faces = static_cast<SoIndexedFaceSet*>(shape);
    lists = {&faces->materialIndex, &faces->normalIndex, &faces->textureCoordIndex, &faces->coordIndex};
  } else if (shape->isOfType(SoVRMLIndexedFaceSet::getClassTypeId())) {
    auto* faces = static_cast<SoVRMLIndexedFaceSet*>(shape);
    lists = {&faces->colorIndex, &faces->normalIndex, &faces->texCoordIndex, &faces->coordIndex};
  } else {
    return;
  }
  const std::vector<int> entries = entriesOfFullFaces(*lists.back());
  const int count = lists.back()->getNum();
  for (SoMFInt32* list : lists)
    if (list->getNum() >= count) rearrange(*list, entries);  // shorter ones are not by corners
}

Result<void> checkGraph(SoNode* root) {
  std::unordered_map<SoNode*, Mark> marks = {{root, {}}};
  std::vector<Step> stack = {{root}};
  while (!stack.empty()) {
    SoNode* node = stack.back().node;
    if (stack.back().next < childCount(node)) {
      SoNode* child = (*node->getChildren())[stack.back().next++];
      const auto [known, isNew] = marks.try_emplace(child);
      if (!isNew && known->second.open)
        return fail(ErrorCode::input, "a node contains itself", child->getName().getString());
      if (isNew)
        stack.push_back({child});
      else
        marks[node].nodes += known->second.nodes;
      continue;
    }
    stack.pop_back();
    marks[node].open = false;
    if (!stack.empty()) marks[stack.back().node].nodes += marks[node].nodes;
    if (marks[node].nodes > kMaxNodes)
      return fail(ErrorCode::input, "is too large: millions of nodes once all uses are followed");
  }
  return {};
}

ShapeVerdict judge(SoCallbackAction* action, const SoNode* shape) {
  if (isAny<SoLineSet, SoIndexedLineSet, SoPointSet, SoIndexedPointSet, SoVRMLIndexedLineSet, SoVRMLPointSet, SoImage,
            SoNurbsCurve, SoIndexedNurbsCurve>(shape))
    return ShapeVerdict::withoutArea;
  if (isAny<SoNurbsSurface, SoIndexedNurbsSurface>(shape)) return ShapeVerdict::nurbs;
  if (!pointsFit(action, shape)) return ShapeVerdict::broken;
  return ShapeVerdict::read;
}

// Normals and texture coordinates play no part here, so their bindings are emptied rather than trusted.
void secureBindings(SoNode* shape) {
  shape->enableNotify(FALSE);
  if (shape->isOfType(SoIndexedShape::getClassTypeId())) {
    auto* indexed = static_cast<SoIndexedShape*>(shape);
    lengthen(indexed->materialIndex, indexed->coordIndex);
    indexed->normalIndex.setValue(-1);
    indexed->textureCoordIndex.setValue(-1);
  }
  if (shape->isOfType(SoVertexShape::getClassTypeId()))
    if (SoNode* own = static_cast<SoVertexShape*>(shape)->vertexProperty.getValue();
        own != nullptr && own->isOfType(SoVertexProperty::getClassTypeId())) {
      static_cast<SoVertexProperty*>(own)->normal.setNum(0);
      static_cast<SoVertexProperty*>(own)->texCoord.setNum(0);
    }
  if (shape->isOfType(SoVRMLIndexedFaceSet::getClassTypeId())) {
    auto* faces = static_cast<SoVRMLIndexedFaceSet*>(shape);
    if (faces->colorIndex.getNum() > 0) lengthen(faces->colorIndex, faces->coordIndex);
    faces->normal.setValue(nullptr);
    faces->normalIndex.setNum(0);
    faces->texCoord.setValue(nullptr);
    faces->texCoordIndex.setNum(0);
  }
}

struct LongBindings::Saved {
  struct Field {
    SoMFInt32* field;
    std::vector<std::int32_t> indices;
    SbBool wasDefault, notified;
  };
  SoIndexedShape* shape;
  std::vector<Field> fields;
};

LongBindings::LongBindings(SoNode* node) {
  if (!node->isOfType(SoIndexedShape::getClassTypeId())) return;
  auto* shape = static_cast<SoIndexedShape*>(node);
  saved_ = std::make_unique<Saved>(Saved{shape, {}});
  shape->ref();
  for (SoMFInt32* field : {&shape->materialIndex, &shape->normalIndex, &shape->textureCoordIndex}) {
    if (field->getNum() >= shape->coordIndex.getNum()) continue;
    const std::int32_t* values = field->getValues(0);
    saved_->fields.push_back(
        {field, {values, values + field->getNum()}, field->isDefault(), field->enableNotify(FALSE)});
    lengthen(*field, shape->coordIndex);
  }
}

LongBindings::LongBindings(LongBindings&&) noexcept = default;
LongBindings& LongBindings::operator=(LongBindings&& other) noexcept {
  saved_.swap(other.saved_);
  return *this;
}

LongBindings::~LongBindings() {
  if (saved_ == nullptr) return;
  for (const Saved::Field& saved : saved_->fields) {
    saved.field->setNum(static_cast<int>(saved.indices.size()));
    saved.field->setValues(0, static_cast<int>(saved.indices.size()), saved.indices.data());
    saved.field->setDefault(saved.wasDefault);
    saved.field->enableNotify(saved.notified);
  }
  saved_->shape->unref();
}

}  // namespace umbrage::inventor

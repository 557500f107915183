#include "umbrage/io/reader/inventor_check.hpp"

#include <Inventor/SbName.h>
#include <Inventor/VRMLnodes/SoVRMLCoordinate.h>
#include <Inventor/VRMLnodes/SoVRMLElevationGrid.h>
#include <Inventor/VRMLnodes/SoVRMLIndexedFaceSet.h>
#include <Inventor/VRMLnodes/SoVRMLIndexedLineSet.h>
#include <Inventor/VRMLnodes/SoVRMLPointSet.h>
#include <Inventor/elements/SoCoordinateElement.h>
#include <Inventor/misc/SoChildList.h>
#include <Inventor/nodes/SoFaceSet.h>
#include <Inventor/nodes/SoIndexedFaceSet.h>
#include <Inventor/nodes/SoIndexedLineSet.h>
#include <Inventor/nodes/SoIndexedPointSet.h>
#include <Inventor/nodes/SoIndexedTriangleStripSet.h>
#include <Inventor/nodes/SoLineSet.h>
#include <Inventor/nodes/SoPointSet.h>
#include <Inventor/nodes/SoQuadMesh.h>
#include <Inventor/nodes/SoTriangleStripSet.h>
#include <Inventor/nodes/SoVertexProperty.h>

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace umbrage::io::reader {
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

}  // namespace

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

ShapeFitness fitnessOf(SoCallbackAction* action, const SoNode* shape) {
  if (as<SoLineSet>(shape) || as<SoIndexedLineSet>(shape) || as<SoPointSet>(shape) || as<SoIndexedPointSet>(shape) ||
      as<SoVRMLIndexedLineSet>(shape) || as<SoVRMLPointSet>(shape))
    return ShapeFitness::withoutArea;
  return pointsFit(action, shape) ? ShapeFitness::good : ShapeFitness::broken;
}

}  // namespace umbrage::io::reader

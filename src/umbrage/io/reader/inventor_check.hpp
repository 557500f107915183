#pragma once

#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/nodes/SoNode.h>

#include "umbrage/base/error.hpp"

// What Coin's traversal takes on trust and a hostile file breaks.
namespace umbrage::io::reader {

/// Errors: a node contains itself; following every use of every node, there are more nodes than can be gone through.
[[nodiscard]] Result<void> checkGraph(SoNode* root);

enum class ShapeFitness { good, withoutArea, broken };
/// withoutArea: points and lines. broken: a face set that names points it does not have. To be asked before Coin enters a shape.
[[nodiscard]] ShapeFitness fitnessOf(SoCallbackAction* action, const SoNode* shape);

}  // namespace umbrage::io::reader

#pragma once

#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/nodes/SoNode.h>

#include <memory>

#include "umbrage/base/error.hpp"

// What Coin's traversal takes on trust and a hostile (or merely unusual) file breaks.
namespace umbrage::inventor {

/// Errors: a node contains itself; following every use of every node, there are more nodes than can be gone through.
[[nodiscard]] Result<void> checkGraph(SoNode* root);

/// What is to be done with a shape. Asked before Coin enters it.
enum class ShapeVerdict {
  read,         ///< fit to be read
  withoutArea,  ///< points, lines, pictures: nothing here
  broken,       ///< a face set that names points it does not have
  nurbs         ///< surfaces for which Coin wants an OpenGL context
};
[[nodiscard]] ShapeVerdict judge(SoCallbackAction* action, const SoNode* shape);

/// For as long as this lives, an indexed shape has indices of material, normal and texture coordinates for every corner, as Coin reads them, however few it names: those that are
/// missing are the corners' own where it names none, else 0. Nobody is told, and afterwards the shape is as it was.
class LongBindings {
 public:
  explicit LongBindings(SoNode* shape);
  LongBindings(LongBindings&&) noexcept;
  LongBindings& operator=(LongBindings&&) noexcept;
  ~LongBindings();

 private:
  struct Saved;
  std::unique_ptr<Saved> saved_;
};

/// Whether a face with fewer than three corners stands before others: Coin tells the triangles of none that come after it. It draws them where it draws by vertex arrays,
/// which hangs on their number and bindings, and else not.
[[nodiscard]] bool hasShortFaces(const SoNode& shape);

/// Gives such faces three corners, so that they are triangles without area, and takes out those without any; with what the corners name. It changes the node, without
/// telling anybody: for copies, and graphs that are read once and thrown away.
void fillShortFaces(SoNode* shape);

/// Makes bindings that Coin would read beyond the end of long enough, and empties those of normals and texture coordinates. It changes the
/// node, without telling anybody: for graphs that are read once and thrown away.
void secureBindings(SoNode* shape);

}  // namespace umbrage::inventor

#include "coin/models.hpp"

#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/actions/SoGetBoundingBoxAction.h>
#include <Inventor/actions/SoSearchAction.h>
#include <Inventor/nodes/SoCamera.h>
#include <Inventor/nodes/SoGroup.h>

#include <fmt/format.h>
#include <algorithm>

#include "coin/scenes.hpp"
#include "support/test_data.hpp"
#include "umbrage/inventor/full_path.hpp"

namespace umbrage::coin::test {
namespace {

// The test's own camera sees everything.
void removeCameras(SoNode* root) {
  for (;;) {
    SoSearchAction search;
    search.setType(SoCamera::getClassTypeId());
    search.setSearchingAll(TRUE);
    search.apply(root);
    if (search.getPath() == nullptr) return;
    const inventor::FullPath path(*search.getPath());
    if (path.length() < 2) return;
    SoNode* parent = path.node(path.length() - 2);
    if (!parent->isOfType(SoGroup::getClassTypeId())) return;
    static_cast<SoGroup*>(parent)->removeChild(path.tail());
  }
}

/// A model's surroundings, in its own measure.
std::string surroundings(const SbBox3f& box, int lights) {
  const SbVec3f c = box.getCenter();
  const float r = std::max(0.5f * (box.getMax() - box.getMin()).length(), 1e-3f);
  const auto at = [&](float x, float y, float z) {
    return fmt::format("{} {} {}", c[0] + r * x, c[1] + r * y, c[2] + r * z);
  };
  std::string text = fmt::format("PointLight {{ location {} }}\n", at(0.9f, 1.3f, 0.8f));
  if (lights > 1)
    text += "DirectionalLight { direction 0.5 -0.6 -0.7 color 0.3 0.8 0.4 }\n" +
            fmt::format("SpotLight {{ location {} direction 1.1 -1.6 -0.9 cutOffAngle 0.6 color 0.9 0.4 0.4 }}\n",
                        at(-1.1f, 1.6f, 0.9f));
  const float low = box.getMin()[1] -
                    0.02f * r;  // below floors that models have: in one plane with them, chance would say what is seen
  return text + fmt::format(
                    "Separator {{ Coordinate3 {{ point [ {} {} {}, {} {} {}, {} {} {}, {} {} {} ] }} "
                    "IndexedFaceSet {{ coordIndex [ 0, 1, 2, 3, -1 ] }} }}\n",
                    c[0] - 4 * r, low, c[2] - 4 * r, c[0] - 4 * r, low, c[2] + 4 * r, c[0] + 4 * r, low, c[2] + 4 * r,
                    c[0] + 4 * r, low, c[2] - 4 * r);
}

std::string cameraFor(const SbBox3f& box) {
  const SbVec3f c = box.getCenter();
  const float r = std::max(0.5f * (box.getMax() - box.getMin()).length(), 1e-3f);
  return fmt::format(
      "PerspectiveCamera {{ position {} {} {} orientation -1 0 0 0.52 nearDistance {} farDistance {} heightAngle 0.785 "
      "}}\n",
      c[0], c[1] + 1.5f * r, c[2] + 2.6f * r, 0.05f * r, 20 * r);
}

}  // namespace

std::vector<std::filesystem::path> modelFiles() {
  return support::filesBelow(support::testData() / "inventor", {".iv", ".wrl"});
}

Ref<> readModel(const std::filesystem::path& file) {
  startCoin();
  SoInput input;
  SoSeparator* model = input.openFile(file.c_str(), TRUE) ? SoDB::readAll(&input) : nullptr;
  if (model == nullptr) return nullptr;
  auto held = hold(model);
  removeCameras(model);
  return held;
}

Ref<> aroundModel(SoSeparator* model, int lights) {
  SoGetBoundingBoxAction bounds(SbViewportRegion(320, 240));
  bounds.apply(model);
  const SbBox3f box = bounds.getBoundingBox();
  if (box.isEmpty()) return nullptr;
  auto root = sceneOf(room("", surroundings(box, lights), "", cameraFor(box)));
  groupOf(root.get())->addChild(model);
  return root;
}

}  // namespace umbrage::coin::test

#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/actions/SoGetBoundingBoxAction.h>
#include <Inventor/actions/SoSearchAction.h>
#include <Inventor/nodes/SoCamera.h>
#include <Inventor/nodes/SoGroup.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "coin/scenes.hpp"
#include "coin/stage.hpp"
#include "coin/truth.hpp"
#include "support/test_data.hpp"
#include "umbrage/inventor/full_path.hpp"

// The Inventor and VRML files of the test data that load, under one light and three, drawn by Coin with shadows.
namespace umbrage::coin::test {
namespace {

// Of the pixels that see a surface, at most this share may be far from a true edge: the bound of all techniques (tests/conformance).
constexpr double kWorstShare = 1e-5;

std::filesystem::path dataFolder() { return support::testData() / "inventor"; }

SoSeparator* read(const std::filesystem::path& file) {
  SoInput input;
  return input.openFile(file.c_str(), TRUE) ? SoDB::readAll(&input) : nullptr;
}

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

// Faces that name more materials than there are: Coin reads beyond its arrays when it draws them, so its picture is whatever was there.
bool isDrawnByChance(const std::filesystem::path& file) {
  return file.parent_path().filename() == "oiv_compliance" &&
         (file.stem() == "indexedfaceset" || file.stem() == "indexedtrianglestripset");
}

/// One model under so many lights; false when there is nothing in it that casts.
bool judgeModel(Stage& stage, SoSeparator* model, int lights, const std::filesystem::path& file) {
  const std::string name = file.stem().string();
  SoGetBoundingBoxAction bounds(SbViewportRegion(320, 240));
  bounds.apply(model);
  const SbBox3f box = bounds.getBoundingBox();
  if (box.isEmpty()) return false;
  const auto root = sceneOf(room("", surroundings(box, lights), "", cameraFor(box)));
  auto* group = groupOf(root.get());
  group->addChild(model);
  const auto picture = stage.draw(root.get());
  if (group->work().extractions < 2) return false;
  EXPECT_FALSE(group->lastError()) << name << ": " << group->lastError()->text();
  const Strayed s = strayed(group->report());
  EXPECT_LE(double(s.far), kWorstShare * double(s.covered)) << name << ": " << s.differing << " differ";
  if (!isDrawnByChance(file)) expectCoinsOwnPicture(stage, root.get(), *group, picture);
  std::printf("%-48s %d lights %8zu covered %5zu differing %3zu far %2zu passes\n", name.c_str(), lights, s.covered,
              s.differing, s.far, group->report().passes);
  save(picture, fmt::format("model_{}_{}", name, lights));
  group->removeChild(model);
  return true;
}

class Models : public testing::TestWithParam<int> {};

TEST_P(Models, HaveTheShadowsOfRaysInCoinsOwnLight) {
  const auto files = support::filesBelow(dataFolder(), {".iv", ".wrl"});
  if (files.empty()) GTEST_SKIP() << "no test data at " << dataFolder();
  const auto stage = Stage::make(320, 240);
  if (!stage) GTEST_SKIP() << "no OpenGL here";
  std::size_t judged = 0, read = 0;
  for (const auto& file : files) {
    SCOPED_TRACE(file.filename().string());
    SoSeparator* model = test::read(file);
    if (model == nullptr) continue;
    const auto held = hold(model);
    ++read;
    removeCameras(model);
    judged += judgeModel(*stage, model, GetParam(), file);
  }
  std::printf("%zu files, %zu load, %zu cast\n", files.size(), read, judged);
  EXPECT_GT(judged, 0u);
}

INSTANTIATE_TEST_SUITE_P(Lights, Models, testing::Values(1, 3));

}  // namespace
}  // namespace umbrage::coin::test

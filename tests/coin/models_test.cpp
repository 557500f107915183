#include <gtest/gtest.h>

#include <fmt/format.h>
#include <cstdio>

#include "coin/models.hpp"
#include "coin/scenes.hpp"
#include "coin/stage.hpp"
#include "coin/truth.hpp"

// The Inventor and VRML files of the test data that load, under one light and three, drawn by Coin with shadows.
namespace umbrage::coin::test {
namespace {

// Of the pixels that see a surface, at most this share may be far from a true edge: the bound of all techniques (tests/conformance).
constexpr double kWorstShare = 1e-5;

// Faces that name more materials, or normals, than there are: Coin reads beyond its arrays when it draws them (valgrind shows it), so its picture is
// whatever was there.
bool isDrawnByChance(const std::filesystem::path& file) {
  return file.parent_path().filename() == "oiv_compliance" &&
         (file.stem() == "indexedfaceset" || file.stem() == "indexedtrianglestripset" ||
          file.stem() == "normalbinding");
}

/// One model under so many lights; false when there is nothing in it that casts.
bool judgeModel(Stage& stage, SoSeparator* model, int lights, const std::filesystem::path& file) {
  const std::string name = file.stem().string();
  const auto root = aroundModel(model, lights);
  if (root == nullptr) return false;
  auto* group = groupOf(root.get());
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
  const auto files = modelFiles();
  if (files.empty()) GTEST_SKIP() << "no test data";
  const auto stage = Stage::make(320, 240);
  if (!stage) GTEST_SKIP() << "no OpenGL here";
  std::size_t judged = 0, read = 0;
  for (const auto& file : files) {
    SCOPED_TRACE(file.filename().string());
    const auto model = readModel(file);
    if (model == nullptr) continue;
    ++read;
    judged += judgeModel(*stage, model.get(), GetParam(), file);
  }
  std::printf("%zu files, %zu load, %zu cast\n", files.size(), read, judged);
  EXPECT_GT(judged, 0u);
}

INSTANTIATE_TEST_SUITE_P(Lights, Models, testing::Values(1, 3));

}  // namespace
}  // namespace umbrage::coin::test

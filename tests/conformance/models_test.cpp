#include <gtest/gtest.h>

#ifdef UMBRAGE_HAVE_IO
#include <cstdio>
#include <cstdlib>

#include "conformance/judge.hpp"
#include "conformance/models.hpp"
#include "support/test_data.hpp"

namespace umbrage::conformance {
namespace {

// The whole collection is for scripts/sweep; here every so many files of a folder, the same ones every time.
constexpr std::size_t kFilesPerFolder = 12;
// Of the pixels that see a surface, at most this share may be far from a true edge.
constexpr double kWorstShare = 1e-5;

std::vector<std::filesystem::path> spread(const std::vector<std::filesystem::path>& files) {
  std::vector<std::filesystem::path> some;
  const std::size_t step = files.size() / kFilesPerFolder + 1;
  for (std::size_t i = 0; i < files.size(); i += step) some.push_back(files[i]);
  return some;
}

void judgeModel(const shadow::TechniqueEntry& entry, const Case& c,
                const std::shared_ptr<const shadow::Geometry>& geometry) {
  if (entry.traits.needsClosed && geometry->casters.report.topology != mesh::Topology::closed) return;
  if (truthFor(entry, *geometry).traits.name == entry.traits.name) return;
  auto judge = Judge::make(entry, geometry);
  if (!judge) {
    ASSERT_EQ(judge.error().code, ErrorCode::device) << judge.error().text();
    std::printf("%-12s cannot run here: %s\n", entry.traits.name.c_str(), judge.error().text().c_str());
    return;
  }
  Tally tally;
  for (const NamedView& view : c.views) {
    const auto verdicts = judge->judge(view, c.lights);
    ASSERT_TRUE(verdicts.has_value()) << verdicts.error().text();
    for (const Verdict& v : *verdicts) tally.add(v);
  }
  std::printf("%-12s %-32s %7zu triangles %8zu covered %5zu differing %3zu far\n", entry.traits.name.c_str(),
              c.name.c_str(), geometry->surfaces.triangles.size(), tally.covered, tally.differing, tally.far);
  EXPECT_LE(double(tally.far), kWorstShare * double(tally.covered)) << entry.traits.name << " on " << c.name;
}

class RealModels : public testing::TestWithParam<std::string> {};

TEST_P(RealModels, DifferFromTheTruthInAtMostOnePixelOf100000) {
  const auto folder = support::testData() / GetParam();
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no test data at " << folder;
  std::size_t loaded = 0;
  for (const auto& path : spread(modelFiles(folder))) {
    const auto c = modelCase(path);
    if (!c) continue;
    ++loaded;
    const auto geometry = shadow::makeGeometry(c->scene);
    const auto all = allTechniques();
    for (std::size_t i = 1; i < all.size(); ++i) judgeModel(all[i], *c, geometry);
  }
  EXPECT_GT(loaded, 0u);
}

INSTANTIATE_TEST_SUITE_P(Folders, RealModels, testing::Values("mesh", "architecture", "inventor", "gltf"),
                         [](const testing::TestParamInfo<std::string>& row) { return row.param; });

}  // namespace
}  // namespace umbrage::conformance
#endif

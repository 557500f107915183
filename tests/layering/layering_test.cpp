#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "house_plan.hpp"

namespace umbrage::layering {
namespace {

using testing::IsEmpty;
using testing::SizeIs;
namespace fs = std::filesystem;

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<fs::path> sources() {
  const fs::path root = UMBRAGE_SOURCE_DIR;
  std::vector<fs::path> found;
  for (const char* folder : {"src", "apps", "examples", "benchmarks", "tests"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const auto extension = entry.path().extension();
      if (extension == ".cpp" || extension == ".hpp") found.push_back(fs::relative(entry.path(), root));
    }
  }
  return found;
}

TEST(Layering, EverySourceKeepsToThePlanOfTheHouse) {
  const HousePlan plan = readHousePlan(UMBRAGE_HOUSE_PLAN);
  ASSERT_GE(plan.rooms.size(), 6u);
  const auto files = sources();
  ASSERT_GE(files.size(), 50u);
  for (const fs::path& file : files) {
    for (const Violation& v : findViolations(plan, file.string(), contents(fs::path(UMBRAGE_SOURCE_DIR) / file))) {
      ADD_FAILURE() << v.file << ":" << v.line << ": " << v.what;
    }
  }
}

TEST(Layering, NoSourceIsLong) {
  for (const fs::path& file : sources()) {
    const std::string text = contents(fs::path(UMBRAGE_SOURCE_DIR) / file);
    EXPECT_LE(std::ranges::count(text, '\n'), 500) << file;
  }
}

TEST(Layering, EveryRoomIsInTheTableOfTheArchitecture) {
  const std::string text = contents(fs::path(UMBRAGE_SOURCE_DIR) / "ARCHITECTURE.md");
  for (const Room& room : readHousePlan(UMBRAGE_HOUSE_PLAN).rooms)
    EXPECT_THAT(text, testing::HasSubstr("| `" + room.name + "` | `" + room.folder + "` |"));
}

// The rules themselves, on planted faults in a small house.
class PlantedFaults : public testing::Test {
 protected:
  static HousePlan smallHouse() {
    HousePlan plan;
    plan.rooms.push_back({"base", "base", {"base"}, {"base"}, {"error.hpp"}});
    plan.rooms.push_back({"gl", "gl", {"gl", "base"}, {"gl", "base"}, {"pass.hpp"}});
    plan.rooms.push_back({"trace", "trace", {"trace", "base"}, {"trace", "base", "gl"}, {"occlusion.hpp"}});
    plan.rooms.push_back({"techniques_gl", "techniques/gl", {"techniques_gl", "gl", "base"}, {"techniques_gl"}, {}});
    return plan;
  }
  static std::vector<Violation> check(const std::string& path, std::string_view text) {
    return findViolations(smallHouse(), path, text);
  }
};

TEST_F(PlantedFaults, CleanFilesPass) {
  EXPECT_THAT(
      check("src/umbrage/gl/pass.cpp", "#include \"umbrage/base/error.hpp\"\n#include <vector>\nglDrawArrays(1);\n"),
      IsEmpty());
  EXPECT_THAT(check("src/umbrage/trace/occlusion.cpp",
                    "#include <embree3/rtcore.h>\n#include \"umbrage/trace/detail/x.hpp\"\n"),
              IsEmpty());
  EXPECT_THAT(check("src/umbrage/trace/trace_test.cpp", "#include \"umbrage/gl/pass.hpp\"\n#include <gtest/gtest.h>\n"),
              IsEmpty());
  EXPECT_THAT(check("src/umbrage/techniques/gl/registry.cpp",
                    "#include \"umbrage/techniques/gl/zfail/zfail.hpp\"\nopenGlTechniques();"),
              IsEmpty());
}

TEST_F(PlantedFaults, CommentsAreNotCode) {
  EXPECT_THAT(check("src/umbrage/base/error.cpp",
                    "// glClear(1)\n/* #include <epoxy/gl.h>\n glClear(1) */\nint i;  // glEnd()\n"),
              IsEmpty());
  EXPECT_THAT(check("src/umbrage/base/error.cpp", "auto s = \"// no comment\"; glClear(1);\n"), SizeIs(1));
}

TEST_F(PlantedFaults, ForeignRoom) {
  EXPECT_THAT(check("src/umbrage/base/error.cpp", "#include \"umbrage/gl/pass.hpp\"\n"), SizeIs(1));
  EXPECT_THAT(check("src/umbrage/trace/occlusion.cpp", "#  include \"umbrage/gl/pass.hpp\"\n"), SizeIs(1));
  EXPECT_THAT(check("src/umbrage/trace/occlusion.cpp", "#include <umbrage/gl/pass.hpp>\n"), SizeIs(1));
  EXPECT_THAT(check("src/umbrage/trace/occlusion.cpp", "#include \"umbrage/nowhere/x.hpp\"\n"), SizeIs(1));
  EXPECT_THAT(check("src/umbrage/nowhere/x.cpp", ""), SizeIs(1));
}

TEST_F(PlantedFaults, DetailOfAnotherRoom) {
  EXPECT_THAT(check("src/umbrage/gl/pass.cpp", "#include \"umbrage/base/detail/x.hpp\"\n"), SizeIs(1));
  EXPECT_THAT(check("apps/cli/main.cpp", "#include \"umbrage/base/detail/x.hpp\"\n"), SizeIs(1));
  EXPECT_THAT(check("src/umbrage/gl/pass.cpp", "#include \"../base/x.hpp\"\n"), SizeIs(1));
  EXPECT_THAT(check("src/umbrage/gl/pass.hpp", "#include \"umbrage/gl/detail/x.hpp\"\n"), SizeIs(1));
}

TEST_F(PlantedFaults, ForeignLibraryOutsideItsRoom) {
  EXPECT_THAT(check("src/umbrage/techniques/gl/registry.cpp", "#include <epoxy/gl.h>\n"), SizeIs(1));
  EXPECT_THAT(check("src/umbrage/gl/pass.cpp", "#include <embree3/rtcore.h>\n"), SizeIs(1));
  EXPECT_THAT(check("src/umbrage/base/error.cpp", "#include <gtest/gtest.h>\n"), SizeIs(1));
  EXPECT_THAT(check("src/umbrage/base/error.cpp", "#include <unheard_of/library.h>\n"), SizeIs(1));
  EXPECT_THAT(check("src/umbrage/trace/occlusion.hpp", "#include <embree3/rtcore.h>\n"), SizeIs(1))
      << "in an installed header";
}

TEST_F(PlantedFaults, OpenGlOutsideGl) {
  EXPECT_THAT(check("src/umbrage/trace/occlusion.cpp", "  glClear(GL_COLOR_BUFFER_BIT);\n"), SizeIs(1));
  EXPECT_THAT(check("apps/cli/main.cpp", "x = glGetError();\n"), SizeIs(1));
}

TEST_F(PlantedFaults, TechniqueIncludesTechnique) {
  EXPECT_THAT(
      check("src/umbrage/techniques/gl/zpass/zpass.cpp", "#include \"umbrage/techniques/gl/zfail/zfail.hpp\"\n"),
      SizeIs(1));
}

}  // namespace
}  // namespace umbrage::layering

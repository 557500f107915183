#include <gmock/gmock.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "verify_fixture.hpp"

// Rules about sites on the command line, and the tallest volumes that they let stand.
namespace umbrage::cli_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
using Json = nlohmann::json;

using Inverse = VerifyTest;

TEST_F(Inverse, JapansSite) {
  const auto site =
      write("site.geojson", R"({"type":"Polygon","crs":null,"coordinates":[[[-3,-3],[3,-3],[3,3],[-3,3],[-3,-3]]]})");
  const std::vector<std::string> tokyo = {"--lat",  "35.68",      "--lon", "139.7",
                                          "--date", "2026-01-01", "--tz",  "Asia/Tokyo"};
  const Ran low = run({"verify", writeBox("low.off", 6), "--preset", "japan-4-2.5", "--site", site}, tokyo);
  EXPECT_EQ(low.code, 0) << low.err;
  EXPECT_THAT(low.out, AllOf(HasSubstr("from 5 m to 10 m"), HasSubstr("farther than 10 m")));
  const auto wide = write("wide.off",
                          "OFF\n8 6 0\n-30 -2 0\n30 -2 0\n30 2 0\n-30 2 0\n-30 -2 25\n30 -2 25\n30 2 25\n-30 2 25\n"
                          "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n");
  const Ran high = run({"verify", wide, "--preset", "japan-4-2.5", "--site", site}, tokyo);
  EXPECT_EQ(high.code, 1) << high.err;
  EXPECT_THAT(high.out, HasSubstr("points on lines, which have no area, fail"));
  const auto elsewhere =
      write("else.geojson", R"({"type":"Polygon","crs":null,"coordinates":[[[50,50],[60,50],[60,60],[50,50]]]})");
  const Ran none = run({"verify", wide, "--preset", "japan-4-2.5", "--site", elsewhere}, tokyo);
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.err, HasSubstr("no part that casts"));
}

// With the same options, and no others, the volume that is written passes; a hundredth more does not.
TEST_F(Inverse, TheTallestVolumePassesBySameOptions) {
  const auto site =
      write("site.geojson",
            R"({"type":"Polygon","crs":null,"coordinates":[[[-15,-45],[15,-45],[15,-20],[-15,-20],[-15,-45]]]})");
  const std::vector<std::string> asked{"--preset", "japan-3-2", "--site", site,         "--lat", "35.68",
                                       "--lon",    "139.7",     "--date", "2026-01-01", "--tz",  "Asia/Tokyo"};
  const Ran grown = run(
      {"envelope", writeBox("house.off", 10), "--inverse", "--cell", "10", "--max-height", "60", "-o", file("inv.obj")},
      asked);
  ASSERT_EQ(grown.code, 0) << grown.err;
  const Ran passes = run({"verify", file("inv.obj")}, asked);
  EXPECT_EQ(passes.code, 0) << passes.out << passes.err;
  std::istringstream lines(read("inv.obj"));
  std::string raised;
  for (std::string line; std::getline(lines, line);) {
    double x = 0.0, y = 0.0, z = 0.0;
    if (std::sscanf(line.c_str(), "v %lf %lf %lf", &x, &y, &z) == 3)
      line = "v " + std::to_string(x) + " " + std::to_string(1.01 * y) + " " + std::to_string(z);
    raised += line + "\n";
  }
  const Ran fails = run({"verify", write("raised.obj", raised)}, asked);
  EXPECT_EQ(fails.code, 1) << fails.out << fails.err;
}

TEST_F(Inverse, TheTallestVolume) {
  const auto house = writeBox("house.off", 3);
  const auto site = write(
      "site.geojson", R"({"type":"Polygon","crs":null,"coordinates":[[[-8,-16],[8,-16],[8,-8],[-8,-8],[-8,-16]]]})");
  const auto window = write("w.csv", "x,y,z,nx,ny,nz\n0,-1,1.5,0,-1,0\n");
  for (const char* name : {"v.geojson", "v.glb", "v.svg"}) {
    const Ran ran = run({"envelope", house, "--inverse", "--preset", "china-dahan-3", "--site", site, "--points",
                         window, "--cell", "4", "--max-height", "60", "-o", file(name)},
                        kBeijing);
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.out, AllOf(StartsWith(file(name)), HasSubstr("8 columns"), HasSubstr("it passes as it is")));
  }
  const Json map = Json::parse(read("v.geojson"));
  ASSERT_EQ(map.at("features").size(), 8u);
  double lowest = 1e9;
  for (const Json& feature : map.at("features"))
    lowest = std::min(lowest, feature.at("properties").at("height").get<double>());
  EXPECT_GT(lowest, 1.5);
  EXPECT_LT(lowest, 60.0);
  // What was written passes by itself, beside the house.
  EXPECT_EQ(umbrage({"info", file("v.glb")}).code, 0);
  const Ran wanted = run(
      {"envelope", house, "--inverse", "--preset", "china-dahan-3", "--points", window, "-o", file("x.svg")}, kBeijing);
  EXPECT_EQ(wanted.code, 2);
  EXPECT_THAT(wanted.err, HasSubstr("--site"));
  const Ran plain = run({"envelope", house, "--preset", "china-dahan-3", "-o", file("x.svg")}, kBeijing);
  EXPECT_EQ(plain.code, 2);
  EXPECT_THAT(plain.err, HasSubstr("--inverse"));
}

}  // namespace
}  // namespace umbrage::cli_test

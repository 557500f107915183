#include <gmock/gmock.h>

#include <algorithm>

#include "program.hpp"
#include "umbrage/base/sha256.hpp"

// What every figure rests on must stand in every file that holds one.
namespace umbrage::cli_test {
namespace {

using testing::HasSubstr;

class Ledger : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    box_ = writeBox();
    hash_ = *sha256OfFile(box_);
  }
  // A place, a clock, a unit and a north of their own, so that each must have gone all the way through.
  Ran run(const std::string& command, const std::string& scene, std::vector<std::string> more) const {
    std::vector<std::string> words{command,      scene,  "--lat",         "48.2",    "--lon", "-16.37", "--date",
                                   "2026-09-18", "--tz", "Europe/Vienna", "--north", "12.5",  "--unit", "ft"};
    words.insert(words.end(), more.begin(), more.end());
    return umbrage(words);
  }
  void expectLedger(const std::string& name, const std::string& receivers, const std::string& hash) const {
    const std::string text = read(name);
    ASSERT_FALSE(text.empty()) << name;
    const std::vector<std::pair<const char*, std::string>> items = {
        {"place", "48.2000 N, 16.3700 W"},
        {"date", "2026-09-18"},
        {"clock", "Europe/Vienna, UTC+02:00"},
        {"limb or centre", "centre of the disc"},
        {"refraction", "geometric (no refraction)"},
        {"declination", "(ERFA)"},
        {"north", "true north 12.5 degrees clockwise of +Y"},
        {"unit", "1 unit of the file = 0.3048 m"},
        {"reference system", "no reference system"},
        {"receivers", receivers},
        {"version", "Umbrage " UMBRAGE_VERSION ", "},
        {"versions of what it uses", "; ERFA "},
        {"release of the time zones", ", tzdata 2"},
        {"input", "SHA-256 " + hash}};
    for (const auto& [what, item] : items)
      EXPECT_NE(text.find(item), std::string::npos) << name << " does not state the " << what << ": " << item;
  }
  std::string box_, hash_;
};

TEST_F(Ledger, OfHours) {
  for (const char* name : {"h.csv", "h.png", "h.glb", "h.tif"}) {
    const Ran ran = run("hours", box_, {"--grid", "1", "--plane", "0.25", "-o", file(name)});
    ASSERT_EQ(ran.code, 0) << ran.err;
    expectLedger(name == std::string("h.csv") ? "h.csv.ledger.txt" : name, "horizontal, at height 0.25", hash_);
  }
}

TEST_F(Ledger, OfPointsHoldsTheirFileToo) {
  const std::string points = write("p.csv", "x,y,z,nx,ny,nz\n0,0,3,0,0,1\n");
  ASSERT_EQ(run("hours", box_, {"--points", points, "-o", file("h.csv")}).code, 0);
  expectLedger("h.csv.ledger.txt", "1 points of p.csv, where they are, SHA-256 " + *sha256OfFile(points), hash_);
}

TEST_F(Ledger, OfMaps) {
  const std::vector<std::vector<std::string>> commands = {
      {"outline", "--at", "12:00"}, {"envelope", "--from", "09:00", "--to", "15:00"}, {"isochrones", "--hours", "1"}};
  for (const auto& command : commands)
    for (const std::string kind : {".geojson", ".dxf", ".svg"}) {
      std::vector<std::string> more(command.begin() + 1, command.end());
      more.insert(more.end(), {"--plane", "0.25", "-o", file(command[0] + kind)});
      const Ran ran = run(command[0], box_, more);
      ASSERT_EQ(ran.code, 0) << ran.err;
      expectLedger(command[0] + kind, "horizontal, at height 0.25", hash_);
    }
}

TEST_F(Ledger, OfTerrain) {
  const auto raster = write("r.asc", "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n4 5 6\n");
  const Ran ran = run("terrain", raster, {"--above", "5", "-o", file("t.asc")});
  ASSERT_EQ(ran.code, 0) << ran.err;
  expectLedger("t.asc.txt", "1.524 m above the middle of every cell", *sha256OfFile(raster));
}

TEST_F(Ledger, OfProfiles) {
  const Ran ran = run("profile", box_,
                      {"--from", "11:00", "--to", "13:00", "--step", "60", "--technique", "ray_traced", "--size",
                       "160x120", "--ground", "-0.25", "-o", file("p.png")});
  ASSERT_EQ(ran.code, 0) << ran.err;
  for (const char* name : {"p.png", "p-hours.png", "p.gif"}) expectLedger(name, "ground at height -0.25", hash_);
}

}  // namespace
}  // namespace umbrage::cli_test

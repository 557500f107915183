#include <gmock/gmock.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "program.hpp"

// Sun hours: tables, pictures, models, and what is wrong with requests.
namespace umbrage::cli_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class Hours : public CliTest {
 protected:
  Ran run(const std::vector<std::string>& more, const std::string& date = "2026-09-18") const {
    std::vector<std::string> words{"hours", box_,     "--lat", "48.2", "--lon",
                                   "16.37", "--date", date,    "--tz", "Europe/Vienna"};
    words.insert(words.end(), more.begin(), more.end());
    return umbrage(words);
  }
  void SetUp() override {
    CliTest::SetUp();
    box_ = writeBox();
  }
  std::vector<std::string> lines(const std::string& name) const {
    std::vector<std::string> all;
    std::istringstream in(read(name));
    for (std::string line; std::getline(in, line);) all.push_back(line);
    return all;
  }
  std::string box_;
};

TEST_F(Hours, PointsFromAFile) {
  // Above the box; on its wall to the north, where the sun comes when it rises and sets; before it, far enough to the south.
  const std::string points = write("p.csv", "x,y,z,nx,ny,nz\n0,0,3,0,0,1\n0,1,1,0,1,0\r\n 0, -50 ,0,0,0,1\n");
  const Ran ran = run({"--points", points, "-o", file("h.csv")});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const auto rows = lines("h.csv");
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0], "hours,longest,intervals");
  EXPECT_THAT(rows[1], StartsWith("12.2603,12.2603,06:40:26-18:56:03"));
  EXPECT_EQ(rows[2], "0.4740,0.2501,06:40:26-06:55:26;18:42:37-18:56:03");
  EXPECT_EQ(rows[3], rows[1]);
  EXPECT_THAT(read("h.csv.ledger.txt"), HasSubstr("Europe/Vienna, UTC+02:00 (CEST)"));
  EXPECT_THAT(read("h.csv.ledger.txt"), HasSubstr("declination moving"));
}

TEST_F(Hours, GridsInEveryKind) {
  for (const char* name : {"g.csv", "g.png", "g.glb", "g.tif"}) {
    const Ran ran = run({"--grid", "0.5", "--plane", "0.5", "-o", file(name)});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_GT(read(name).size(), 200u) << name;
  }
  EXPECT_THAT(read("g.png"), StartsWith("\x89PNG"));
  EXPECT_THAT(read("g.glb"), StartsWith("glTF"));
  EXPECT_THAT(read("g.tif"), StartsWith("II*"));
  EXPECT_EQ(lines("g.csv")[0], "x,y,z,nx,ny,nz,hours,longest,intervals");
  EXPECT_EQ(run({"--grid", "0.5", "--faces", "*", "-o", file("f.glb")}).code, 0);
  EXPECT_EQ(run({"--grid", "0.5", "--on", "*", "-o", file("o.csv")}).code, 0);
  // On the roof of the box nothing hides the sun.
  EXPECT_THAT(lines("o.csv")[1], HasSubstr(",2,0,0,1,12.2603,12.2603,"));
}

TEST_F(Hours, SeveralDaysRunsAndSamples) {
  const std::string points = write("p.csv", "x,y,z,nx,ny,nz\n0,0,3,0,0,1\n");
  ASSERT_EQ(run({"--points", points, "-o", file("d.csv"), "--until", "2026-09-20", "--from", "09:00", "--to", "17:00",
                 "--at-least", "60"})
                .code,
            0);
  EXPECT_EQ(lines("d.csv")[0].substr(0, 48), "hours,longest,intervals,runs,run_hours,month_01,");
  EXPECT_THAT(lines("d.csv")[1],
              StartsWith("24.0000,8.0000,2026-09-18 09:00:00-17:00:00;2026-09-19 09:00:00-17:00:00;"));
  EXPECT_THAT(lines("d.csv")[1], HasSubstr(",3,24.0000,"));
  ASSERT_EQ(run({"--points", points, "-o", file("s.csv"), "--sampled", "15"}).code, 0);
  EXPECT_THAT(lines("s.csv")[1], StartsWith("12.2500,"));
  EXPECT_THAT(read("s.csv.ledger.txt"), HasSubstr("sampled every 15 min"));
}

TEST_F(Hours, AYearTellsBothClocks) {
  const std::string points = write("p.csv", "x,y,z,nx,ny,nz\n0,0,3,0,0,1\n");
  ASSERT_EQ(run({"--points", points, "-o", file("y.csv"), "--year"}).code, 0);
  EXPECT_THAT(read("y.csv.ledger.txt"), HasSubstr("Europe/Vienna, UTC+01:00 (CET), then UTC+02:00 (CEST)\n"));
  EXPECT_THAT(read("y.csv.ledger.txt"), HasSubstr("2026-01-01 to 2026-12-31, 365 days"));
}

TEST_F(Hours, RefractionAndTheUpperLimbLengthenTheDay) {
  const std::string points = write("p.csv", "x,y,z,nx,ny,nz\n0,0,3,0,0,1\n");
  ASSERT_EQ(run({"--points", points, "-o", file("r.csv"), "--refraction", "--sun", "upper"}).code, 0);
  EXPECT_GT(std::stod(lines("r.csv")[1]), 12.38);
  EXPECT_THAT(read("r.csv.ledger.txt"), HasSubstr("upper limb of the disc, with refraction"));
}

TEST_F(Hours, WhatIsWrongIsSaidAndNothingWritten) {
  const auto files0 = files();
  const std::string bad = write("bad.csv", "x,y,z,nx,ny,nz\n0,0,3,0,0,1\n1,2,three,0,0,1\n");
  const Ran number = run({"--points", bad, "-o", file("h.csv")});
  EXPECT_EQ(number.code, 3);
  EXPECT_THAT(number.err, HasSubstr("bad.csv, line 3: 'three' is no number"));
  EXPECT_THAT(run({"--points", write("few.csv", "x,y,z\n1,2,3\n"), "-o", file("h.csv")}).err,
              HasSubstr("few.csv, line 1"));
  EXPECT_EQ(run({"--points", write("none.csv", "x,y,z,nx,ny,nz\n0,0,0,0,0,0\n"), "-o", file("h.csv")}).code, 3);
  EXPECT_EQ(run({"-o", file("h.csv")}).code, 2);
  EXPECT_EQ(run({"--grid", "1", "-o", file("h.xls")}).code, 2);
  EXPECT_EQ(run({"--grid", "1", "--faces", "*", "-o", file("h.png")}).code, 2);
  EXPECT_EQ(run({"--grid", "1", "--faces", "nobody", "-o", file("h.csv")}).code, 2);
  EXPECT_EQ(run({"--grid", "0.00001", "-o", file("h.csv")}).code, 2);
  EXPECT_EQ(run({"--grid", "1", "-o", file("h.csv"), "--until", "2026-09-01"}).code, 2);
  EXPECT_FALSE(exists("h.csv"));
  EXPECT_FALSE(exists("h.png"));
}

TEST_F(Hours, PolarNightAndDay) {
  const std::string points = write("p.csv", "x,y,z,nx,ny,nz\n0,0,3,0,0,1\n");
  const auto at78 = [&](const std::string& date) {
    return umbrage({"hours", box_, "--lat", "78", "--lon", "15", "--date", date, "--tz", "UTC", "--points", points,
                    "-o", file("n.csv")});
  };
  const Ran night = at78("2026-12-21");
  EXPECT_EQ(night.code, 0);
  EXPECT_THAT(night.err, HasSubstr("below the horizon"));
  EXPECT_EQ(lines("n.csv")[1], "0.0000,0.0000,");
  const Ran day = at78("2026-06-21");
  EXPECT_THAT(day.err, HasSubstr("up all the time"));
  EXPECT_EQ(lines("n.csv")[1], "24.0000,24.0000,00:00:00-24:00:00");
}

// In a room of its own in which the system's time zones are hidden; where none may be made the test is skipped.
TEST_F(Hours, WithoutTimeZoneDataTheReasonIsSaid) {
  const auto inRoom = [&](const std::string& command) {
    const std::string whole = "unshare -rm sh -c 'mount -t tmpfs none /usr/share/zoneinfo && " + command + "' >" +
                              file("out.txt") + " 2>" + file("err.txt");
    const int status = std::system(whole.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  if (inRoom("true") != 0) GTEST_SKIP() << "no room of its own can be made here (unshare)";
  const auto hours = [&](const std::string& zone) {
    return inRoom(UMBRAGE_PROGRAM " hours " + box_ + " --lat 48.2 --lon 16.37 --date 2026-09-18 --grid 1 --tz " + zone +
                  " -o " + file("h.csv"));
  };
  EXPECT_EQ(hours("Europe/Vienna"), 2);
  EXPECT_THAT(read("err.txt"), AllOf(HasSubstr("this system has no time zone data"), HasSubstr("tzdata"),
                                     HasSubstr("+HH:MM and 'solar' work")));
  EXPECT_FALSE(exists("h.csv"));
  EXPECT_EQ(hours("+02:00"), 0) << read("err.txt");
  EXPECT_EQ(hours("solar"), 0) << read("err.txt");
}

// A wall from south to north across a plain, with a hole beside it.
std::string rasterOfAWall() {
  std::string text = "ncols 40\nnrows 30\nxllcorner 147700\nyllcorner 6398500\ncellsize 1\nNODATA_value -9999\n";
  for (int row = 0; row < 30; ++row)
    for (int column = 0; column < 40; ++column)
      text += std::string(row == 3 && column == 30              ? "-9999"
                          : column == 20 && row > 5 && row < 25 ? "12"
                                                                : "0") +
              (column == 39 ? "\n" : " ");
  return text;
}

class HoursOnARaster : public CliTest {
 protected:
  static Ran run(const std::string& command, const std::string& raster, const std::vector<std::string>& more) {
    std::vector<std::string> words{command,  raster,       "--crs", "EPSG:3007",
                                   "--date", "2026-09-18", "--tz",  "Europe/Stockholm",
                                   "--from", "10:00",      "--to",  "16:00"};
    words.insert(words.end(), more.begin(), more.end());
    return umbrage(words);
  }
  std::vector<std::string> lines(const std::string& name) const {
    std::vector<std::string> all;
    std::istringstream in(read(name));
    for (std::string line; std::getline(in, line);) all.push_back(line);
    return all;
  }
};

TEST_F(HoursOnARaster, CellsGetWhatTerrainSays) {
  const auto wall = write("wall.asc", rasterOfAWall());
  const Ran ran = run("hours", wall, {"--grid", "1", "-o", file("h.csv")});
  ASSERT_EQ(ran.code, 0) << ran.err;
  ASSERT_EQ(run("terrain", wall, {"-o", file("t.asc")}).code, 0);
  EXPECT_THAT(read("h.csv.ledger.txt"), HasSubstr("Receivers: grid of 1 on the raster's surface, 0.01 above it"));
  EXPECT_THAT(read("h.csv.ledger.txt"), HasSubstr("EPSG:3007"));
  std::vector<double> terrain;
  const auto grid = lines("t.asc");
  for (std::size_t i = 6; i < grid.size(); ++i) {
    std::istringstream row(grid[i]);
    for (double value = 0.0; row >> value;)
      if (value >= 0.0) terrain.push_back(value);
  }
  const auto rows = lines("h.csv");
  ASSERT_EQ(rows.size(), 40u * 30u - 1u + 1u);
  ASSERT_EQ(terrain.size(), 40u * 30u - 1u);
  EXPECT_THAT(rows[1], StartsWith("147700.5,6398529.5,0.01,0,0,1,"));
  for (std::size_t i = 0; i < terrain.size(); ++i) {
    std::vector<std::string> words;
    std::istringstream in(rows[i + 1]);
    for (std::string word; std::getline(in, word, ',');) words.push_back(word);
    EXPECT_NEAR(std::stod(words.at(6)), terrain[i], 2e-4) << rows[i + 1];
  }
}

TEST_F(HoursOnARaster, GeoTiffLiesWhereTheRasterDoes) {
  const auto wall = write("wall.asc", rasterOfAWall());
  ASSERT_EQ(run("hours", wall, {"--grid", "1", "-o", file("h.tif")}).code, 0);
  // Read back as a raster: the same reference system and place, the hole where it was, up to six hours high.
  const Ran info = umbrage({"info", file("h.tif")});
  EXPECT_THAT(info.out, HasSubstr("EPSG:3007"));
  EXPECT_THAT(info.out, AllOf(HasSubstr("bounds       (147700, 6.3985e+06, "),
                              HasSubstr(" to (147740, 6.39853e+06, 6)"), HasSubstr("size         39 x 29 x ")));
  EXPECT_THAT(info.err + info.out, HasSubstr("1 of 1200 cells have no height"));
}

TEST_F(HoursOnARaster, EveryKindAndEveryWayOfLaying) {
  const auto wall = write("wall.asc", rasterOfAWall());
  for (const char* name : {"h.png", "h.glb", "h.tif", "h.csv"})
    EXPECT_EQ(run("hours", wall, {"--grid", "2", "-o", file(name)}).code, 0) << name;
  ASSERT_EQ(run("hours", wall, {"--grid", "2", "--above", "1.5", "-o", file("h.csv")}).code, 0);
  EXPECT_THAT(lines("h.csv")[1], HasSubstr(",1.5,0,0,1,"));
  ASSERT_EQ(run("hours", wall, {"--grid", "2", "--on", "terrain", "-o", file("h.csv")}).code, 0);
  EXPECT_THAT(lines("h.csv")[1], HasSubstr(",0,0,0,1,"));
  ASSERT_EQ(run("hours", wall, {"--grid", "2", "--plane", "20", "-o", file("h.csv")}).code, 0);
  EXPECT_THAT(lines("h.csv")[1], HasSubstr(",20,0,0,1,6.0000,"));
  const auto points = write("p.csv", "x,y,z,nx,ny,nz\n0,0,3,0,0,1\n");
  EXPECT_EQ(run("hours", wall, {"--points", points, "--above", "1", "-o", file("h.csv")}).code, 2);
  EXPECT_EQ(run("hours", wall, {"--grid", "2", "--faces", "*", "--above", "1", "-o", file("h.csv")}).code, 2);
}

TEST_F(HoursOnARaster, OfARealCity) {
  const auto raster = testData() / "city/goteborg/DSM_KRbig.tif";
  if (testData().empty() || !std::filesystem::exists(raster)) GTEST_SKIP() << "no models (UMBRAGE_TEST_DATA)";
  const Ran ran = umbrage({"hours", raster.string(), "--date", "2026-09-18", "--tz", "Europe/Stockholm", "--grid", "1",
                           "-o", file("h.tif")});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("52182 points: 0.000 to 12.369 h of sun"));
  const Ran here = umbrage({"info", file("h.tif")}), there = umbrage({"info", raster.string()});
  EXPECT_THAT(here.out, HasSubstr("Z up, 1 unit = 1 m, EPSG:3007"));
  EXPECT_THAT(here.out, HasSubstr("bounds       (147720, 6.39856e+06, 0)"));
  EXPECT_THAT(there.out, HasSubstr("bounds       (147720, 6.39856e+06, 0)"));
}

}  // namespace
}  // namespace umbrage::cli_test

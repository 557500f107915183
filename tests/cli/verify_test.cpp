#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "verify_fixture.hpp"

// Verdicts of regulations on the command line: exit codes, evidence, refusals.
namespace umbrage::cli_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using Json = nlohmann::json;

using Verify = VerifyTest;

TEST_F(Verify, ListsAndPrintsItsPresets) {
  const Ran list = umbrage({"verify", "--list-presets"});
  EXPECT_EQ(list.code, 0) << list.err;
  for (const char* name :
       {"japan-4-2.5", "china-dahan-2", "korea", "en17037-high", "bre209", "din5034-1", "tno-light", "poland", "nsw",
        "montreal-parks", "vancouver", "boston-parks", "san-francisco-1", "nyc-ceqr"})
    EXPECT_THAT(list.out, HasSubstr(name));
  const Ran text = umbrage({"verify", "--print-preset", "korea"});
  EXPECT_EQ(text.code, 0);
  EXPECT_EQ(Json::parse(text.out).at("name"), "korea");
  EXPECT_EQ(umbrage({"verify", "--print-preset", "chosun"}).code, 2);
}

TEST_F(Verify, ExitCodeIsTheVerdict) {
  const auto low = writeBox("low.off", 2), high = writeBox("high.off", 40);
  const Ran passes = run({"verify", low, "--preset", "china-dahan-2", "--points", points()}, kBeijing);
  EXPECT_EQ(passes.code, 0) << passes.err;
  EXPECT_THAT(passes.out, AllOf(StartsWith("PASS  china-dahan-2"), HasSubstr("100.0 % of 2 receivers"),
                                HasSubstr("GB 50180-2018"), HasSubstr("Checked against:"),
                                HasSubstr("bjtu-tod-research.com"), HasSubstr("Uncertain in this preset:")));
  const auto shed = write("shed.csv", "x,y,z,nx,ny,nz\n0,1.05,0.5,0,-1,0\n");
  const Ran fails = run({"verify", high, "--preset", "china-dahan-2", "--points", shed}, kBeijing);
  EXPECT_EQ(fails.code, 1) << fails.err;
  EXPECT_THAT(fails.out, AllOf(StartsWith("FAIL"), HasSubstr("deciding")));
}

TEST_F(Verify, EvidenceIsATableAMapAndJson) {
  const auto box = writeBox("box.off", 20);
  const Ran table = run({"verify", box, "--preset", "bre209", "--areas", park(), "-o", file("e.csv")},
                        {"--lat", "51.5", "--lon", "0", "--date", "2026-03-21", "--tz", "Europe/London"});
  EXPECT_THAT(table.code, testing::AnyOf(0, 1)) << table.err;
  EXPECT_THAT(table.err, HasSubstr("without --baseline"));
  const std::string csv = read("e.csv");
  EXPECT_THAT(csv, StartsWith("group,requirement,x,y,z,"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 48);
  EXPECT_THAT(read("e.csv.ledger.txt"), AllOf(HasSubstr("SHA-256"), HasSubstr("BR 209"), HasSubstr("2026-03-21"),
                                              HasSubstr("centre of the disc")));
  const auto before = writeBox("before.off", 5);
  const Ran map = run({"verify", box, "--baseline", before, "--preset", "nyc-ceqr", "--areas", park(), "--json", "-o",
                       file("e.geojson")},
                      kNewYork);
  EXPECT_EQ(map.code, 1) << map.err;
  const Json verdict = Json::parse(map.out), evidence = Json::parse(read("e.geojson"));
  EXPECT_EQ(verdict.at("passes"), false);
  EXPECT_EQ(verdict.at("new_shadow").size(), 4u);
  const Json& march = verdict.at("new_shadow").at(0);
  EXPECT_EQ(march.at("date"), "2026-03-21");
  const Json& visit = march.at("areas").at(0).at("visits").at(0);
  EXPECT_LT(visit.at("enters").get<std::string>(), visit.at("leaves").get<std::string>());
  EXPECT_GT(march.at("areas").at(0).at("area_hours").get<double>(), 0.0);
  bool shadows = false, failing = false;
  for (const Json& feature : evidence.at("features")) {
    const auto layer = feature.at("properties").at("layer").get<std::string>();
    shadows = shadows || layer.starts_with("new shadow, 2026-");
    failing = failing || layer == "fails";
  }
  EXPECT_TRUE(shadows && failing);
  for (const char* subject : {"Rule", "Source", "Verdict", "Place", "Date", "Clock", "Sun", "North", "Unit",
                              "Receivers", "Casters", "Input", "Baseline", "Made by", "Checked", "Uncertain"})
    EXPECT_TRUE(evidence.at("umbrage").contains(subject)) << subject;
  // None of several texts is lost: a member of its own for each.
  ASSERT_GE(verdict.at("checked").size(), 3u);
  EXPECT_EQ(evidence.at("umbrage").at("Checked"), verdict.at("checked").at(0));
  EXPECT_EQ(evidence.at("umbrage").at("Checked 3"), verdict.at("checked").at(2));
  // The same input gives the same bytes.
  const std::string first = read("e.geojson");
  EXPECT_EQ(run({"verify", box, "--baseline", before, "--preset", "nyc-ceqr", "--areas", park(), "--json", "-o",
                 file("e.geojson")},
                kNewYork)
                .out,
            map.out);
  EXPECT_EQ(read("e.geojson"), first);
}

TEST_F(Verify, SharesOfNewShadowAreInTheTableToo) {
  const Ran ran = run({"verify", writeBox("box.off", 20), "--baseline", writeBox("before.off", 5), "--preset",
                       "san-francisco-1", "--areas", park(), "-o", file("e.csv"), "--json"},
                      kNewYork);
  EXPECT_EQ(ran.code, 1) << ran.err;
  const double share = Json::parse(ran.out).at("findings").at(0).at("new_share");
  const std::string csv = read("e.csv");
  const auto last = csv.rfind(",0.01\n"), before = csv.rfind(',', last - 1);
  ASSERT_NE(last, std::string::npos) << csv;
  EXPECT_NEAR(std::stod(csv.substr(before + 1)), share, 1e-9);
}

// A spreadsheet runs what begins like a formula.
// Points have no square metres, and a day is no year.
TEST_F(Verify, SharesOfNewShadowAreOfTheSunThatIsLookedAt) {
  const auto box = writeBox("box.off", 20), before = writeBox("before.off", 5);
  Json rule = {{"name", "mine"}, {"title", "t"}, {"source", "s"}, {"receivers", {{"kind", "points"}}}};
  const auto ranFor = [&](const char* kind, const Json& days, const std::string& option, const std::string& file) {
    rule["receivers"]["kind"] = kind;
    rule["requirements"] = {{{"name", "r"}, {"days", days}, {"at_most_new_share", 0.9}}};
    const Ran ran =
        run({"verify", box, "--baseline", before, "--preset", write("mine.json", rule.dump()), option, file}, kNewYork);
    EXPECT_EQ(ran.code, 0) << ran.err;
    return ran.out;
  };
  const Json day = {{"dates", {"03-21"}}}, days = {{"dates", {"03-21", "12-21"}}},
             year = {{"from", "03-01"}, {"to", "02-29"}};
  EXPECT_THAT(ranFor("points", day, "--points", points()),
              testing::ContainsRegex("% of the sun of 2026-03-21 is newly shaded [(][0-9]+:[0-9:]+ in all[)]"));
  EXPECT_THAT(ranFor("points", days, "--points", points()), HasSubstr("% of the sun of 2 days is newly shaded"));
  EXPECT_THAT(ranFor("areas", day, "--areas", park()),
              testing::ContainsRegex("% of the sun of 2026-03-21 is newly shaded [(][0-9.]+ m2 h[)]"));
  EXPECT_THAT(ranFor("points", year, "--points", points()), HasSubstr("% of the year's sun is newly shaded"));
}

// Coordinates of maps have six digits before the point alone.
TEST_F(Verify, PlacesAreToldApart) {
  const auto far = write("far.csv", "x,y,z,nx,ny,nz\n85002.7123,5800010.12,1.93333,0,-1,0\n");
  const auto outputOf = [&](const std::string& name) {
    return run({"verify", writeBox(), "--preset", "china-dahan-2", "--points", far, "-o", file(name)}, kBeijing);
  };
  const Ran page = outputOf("page.html");
  EXPECT_EQ(page.code, 0) << page.err;
  EXPECT_THAT(page.out, HasSubstr(" at 85002.712,5800010.12,1.933 ["));
  EXPECT_THAT(read("page.html"), HasSubstr("85002.712, 5800010.12, 1.933"));
  const Json map = Json::parse(read("page.geojson"));
  bool found = false;
  for (const Json& feature : map.at("features"))
    found = found || feature.at("properties").value("at", "") == "85002.712,5800010.12,1.933";
  EXPECT_TRUE(found);
  // A millimetre, whatever the scene's unit is.
  const auto small = write("mm.csv", "x,y,z,nx,ny,nz\n8502.7123,-0.1,1500,0,-1,0\n");
  const Ran ran = run({"verify", writeBox(), "--unit", "mm", "--preset", "china-dahan-2", "--points", small}, kBeijing);
  EXPECT_THAT(ran.out, HasSubstr(" at 8503,0,1500 [")) << ran.err;
}

// A strip of 0.4 m along the border is new shadow though it reaches no middle of a cell.
TEST_F(Verify, NoNewShadowIsHeldByOutlines) {
  const auto town = [&](const char* name, const char* wall) {
    return write(name,
                 std::string(R"({"type":"FeatureCollection","crs":null,"features":[)") + wall + R"({"type":"Feature",
      "properties":{"name":"house","height":15},"geometry":{"type":"Polygon","coordinates":[[[-30,10],[30,10],[30,22],[-30,22],[-30,10]]]}}]})");
  };
  const auto now = town("now.geojson", R"({"type":"Feature","properties":{"name":"wall","height":4.68},
    "geometry":{"type":"Polygon","coordinates":[[[-300,-40],[300,-40],[300,-25],[-300,-25],[-300,-40]]]}},)");
  const auto before = town("before.geojson", "");
  const auto park =
      write("p.geojson", R"({"type":"Feature","crs":null,"properties":{"name":"park"},"geometry":{"type":"Polygon",
      "coordinates":[[[-30,-20],[30,-20],[30,0],[-30,0],[-30,-20]]]}})");
  const std::vector<std::string> words{
      "verify", now,     "--preset", "vancouver", "--areas",           park,     "--baseline", before, "--lat",
      "49.25",  "--lon", "-123.1",   "--tz",      "America/Vancouver", "--date", "2026-01-01"};
  const Ran text = umbrage(words);
  EXPECT_EQ(text.code, 1) << text.err;
  EXPECT_THAT(text.out, AllOf(StartsWith("FAIL"), HasSubstr("exact outlines show new shadow on 3 days"),
                              HasSubstr("most on 2026-09-22"), HasSubstr("New shadow on 2026-09-22")));
  const Json json = Json::parse(run(words, {"--json"}).out);
  EXPECT_EQ(json.at("findings").at(0).at("outlines").at("days"), 3);
  EXPECT_EQ(run(words, {"-o", file("o.csv")}).code, 1);
  EXPECT_THAT(read("o.csv"), HasSubstr("-6.0000000,2026-09-22,10:00:00-16:00:00"));
  EXPECT_EQ(run(words, {"-o", file("o.html")}).code, 1);
  EXPECT_THAT(read("o.html"), HasSubstr("the exact outlines show new shadow"));
}

TEST_F(Verify, SharesTellNoneAndAllFromTheRest) {
  Json rule = Json::parse(umbrage({"verify", "--print-preset", "bre209"}).out);
  rule["requirements"][0].erase("or_former_times");
  rule["requirements"][0]["share"] = 1;
  const auto mine = write("mine.json", rule.dump());
  const auto wide =
      write("wide.geojson", R"({"type":"Feature","properties":{"name":"field"},"geometry":{"type":"Polygon",
      "coordinates":[[[-60,-60],[60,-60],[60,60],[-60,60],[-60,-60]]]},"crs":null})");
  const std::vector<std::string> london{"--lat", "51.5", "--lon", "0", "--date", "2026-03-21", "--tz", "Europe/London"};
  const Ran few = run({"verify", writeBox("low.off", 0.2), "--preset", mine, "--areas", wide}, london);
  EXPECT_EQ(few.code, 1) << few.err;
  EXPECT_THAT(few.out, HasSubstr("99.97 % of 14400 receivers by area pass, 100.0 % wanted"));
}

// Nothing of a yard behind a wall ever had two hours: nothing has to have them now.
TEST_F(Verify, WhatPassesHasNothingNegativeToSpare) {
  const auto yard =
      write("yard.geojson", R"({"type":"Feature","properties":{"name":"yard"},"geometry":{"type":"Polygon",
      "coordinates":[[[-0.5,1.1],[0.5,1.1],[0.5,1.6],[-0.5,1.6],[-0.5,1.1]]]},"crs":null})");
  const auto tower = write("tower.off",
                           "OFF\n8 6 0\n-90 -2 0\n90 -2 0\n90 1 0\n-90 1 0\n-90 -2 90\n90 -2 90\n90 1 90\n-90 1 90\n"
                           "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n");
  const std::vector<std::string> words{"verify",     tower,           "--preset", "bre209",     "--areas", yard,
                                       "--baseline", tower,           "--lat",    "51.5",       "--lon",   "0",
                                       "--tz",       "Europe/London", "--date",   "2026-01-01", "--grid",  "0.25"};
  const Ran ran = umbrage(words);
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, AllOf(HasSubstr("nothing has to pass; the best: 0:"), HasSubstr("(0.0 % before)"),
                             Not(HasSubstr("to spare"))));
  const Json json = Json::parse(run(words, {"--json"}).out);
  EXPECT_FALSE(json.at("findings").at(0).contains("margin_hours"));
}

TEST_F(Verify, NothingOfWhatIsGivenIsIgnored) {
  const auto box = writeBox("box.off", 6), before = writeBox("before.off", 2);
  const auto site =
      write("site.geojson", R"({"type":"Polygon","crs":null,"coordinates":[[[-3,-3],[3,-3],[3,3],[-3,3],[-3,-3]]]})");
  const auto refused = [&](const std::vector<std::string>& words, const char* says) {
    const Ran ran = run(words, kBeijing);
    EXPECT_EQ(ran.code, 2) << says;
    EXPECT_THAT(ran.err, HasSubstr(says));
  };
  refused({"verify", box, "--preset", "china-dahan-2", "--points", points(), "--height", "2"}, "--height is for areas");
  refused({"verify", box, "--preset", "japan-4-2.5", "--site", site, "--baseline", before}, "leave out --baseline");
  refused({"envelope", before, "--inverse", "--preset", "china-dahan-2", "--points", points(), "--site", site,
           "--baseline", before, "-o", file("v.obj")},
          "leave out --baseline");
  // On points and areas new shadow is told whatever the rule asks.
  const Ran told =
      run({"verify", box, "--preset", "china-dahan-2", "--points", points(), "--baseline", before}, kBeijing);
  EXPECT_THAT(told.out, HasSubstr("New shadow on "));
}

TEST_F(Verify, AboveAllRoofsNothingCasts) {
  const auto box = writeBox("box.off", 6);
  const std::vector<std::string> london{"--lat", "51.5", "--lon", "0", "--date", "2026-03-21", "--tz", "Europe/London"};
  const Ran high = run({"verify", box, "--preset", "bre209", "--areas", park(), "--plane", "6"}, london);
  EXPECT_THAT(high.err, HasSubstr("nothing in the scene rises above 6"));
  const Ran higher = run({"verify", box, "--preset", "bre209", "--areas", park(), "--height", "9"}, london);
  EXPECT_THAT(higher.err, HasSubstr("receivers lie at height 9"));
  const Ran below = run({"verify", box, "--preset", "bre209", "--areas", park(), "--plane", "5.9"}, london);
  EXPECT_THAT(below.err, Not(HasSubstr("nothing in the scene")));
}

TEST_F(Verify, NamesInTablesAreNoFormulas) {
  const auto area = write("area.geojson", R"json({"type":"Feature","properties":{"name":"=HYPERLINK(\"http://a\")"},
      "geometry":{"type":"Polygon","coordinates":[[[-4,2],[4,2],[4,8],[-4,2]]]},"crs":null})json");
  Json rule = Json::parse(umbrage({"verify", "--print-preset", "bre209"}).out);
  for (const auto& [name, cell] : {std::pair("-2+3", "\"'-2+3\""), std::pair(" @SUM(A1)", "\"' @SUM(A1)\""),
                                   std::pair("+1", "\"'+1\""), std::pair("2 h, or more", "\"2 h, or more\"")}) {
    rule["requirements"][0]["name"] = name;
    const Ran ran = run({"verify", writeBox("box.off", 20), "--preset", write("mine.json", rule.dump()), "--areas",
                         area, "-o", file("e.csv")},
                        kNewYork);
    EXPECT_THAT(ran.code, testing::AnyOf(0, 1)) << ran.err;
    const std::string csv = read("e.csv"), row = csv.substr(csv.find('\n') + 1);
    EXPECT_THAT(row, StartsWith("\"'=HYPERLINK(\"\"http://a\"\")\"," + std::string(cell) + ",")) << name;
    EXPECT_THAT(row, Not(HasSubstr("'-1"))) << "numbers stay";
  }
}

// The layer of what fails ends at the area's border, also where cells reach beyond it.
TEST_F(Verify, WhatFailsOnTheMapIsAPartOfItsArea) {
  const auto area = write("area.geojson", R"({"type":"FeatureCollection","crs":null,"features":[
      {"type":"Feature","properties":{"name":"dark"},"geometry":{"type":"Polygon","coordinates":[[[-4,2],[4.3,2],[0.7,5.9],[-4,2]]]}},
      {"type":"Feature","properties":{"name":"dark"},"geometry":{"type":"Polygon","coordinates":[[[-30,-1],[0,-40],[30,-1],[-30,-1]]]}}]})");
  const Ran ran = run({"verify", writeBox("box.off", 40), "--baseline", writeBox("low.off", 3), "--preset", "nyc-ceqr",
                       "--areas", area, "--grid", "1.7", "-o", file("e.geojson"), "--json"},
                      kNewYork);
  EXPECT_EQ(ran.code, 1) << ran.err;
  const Json findings = Json::parse(ran.out).at("findings"), map = Json::parse(read("e.geojson"));
  std::vector<double> areas, failing;
  for (const Json& feature : map.at("features")) {
    const Json& p = feature.at("properties");
    if (p.at("layer") == "areas") {
      areas.push_back(p.at("area_m2"));
      EXPECT_EQ(p.at(findings.at(0).at("requirement").get<std::string>()), "fails");
    }
    if (p.at("layer") == "fails") failing.push_back(p.at("area_m2"));
  }
  ASSERT_EQ(areas.size(), 2u);
  ASSERT_EQ(failing.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const double share = 1.0 - findings.at(i).at("share").get<double>();
    EXPECT_LE(failing[i], areas[i] + 1e-6);
    EXPECT_NEAR(failing[i] / areas[i], share, share == 1.0 ? 1e-6 : 0.1) << i;
  }
  EXPECT_LT(failing[1], 0.99 * areas[1]);
}

// Where the sun counts at no time, a limit on shadow would hold of itself; a polygon elsewhere has no shadow at all.
TEST_F(Verify, NothingHoldsOfItself) {
  const auto box = writeBox("box.off", 20), before = writeBox("before.off", 5);
  const auto vancouver = [&](const std::string& areas, const std::string& zone) {
    return umbrage({"verify", box, "--baseline", before, "--preset", "vancouver", "--areas", areas, "--lat", "40.71",
                    "--lon", "-74", "--date", "2026-01-01", "--tz=" + zone});
  };
  const Ran night = vancouver(park(), "+09:00");
  EXPECT_EQ(night.code, 2) << night.out;
  EXPECT_THAT(night.err, HasSubstr("the sun counts at no time"));
  EXPECT_THAT(vancouver(park(), "+02:00").err, HasSubstr("h away from the sun's at this longitude"));
  EXPECT_THAT(vancouver(park(), "-05:00").err, Not(HasSubstr("away from the sun's")));
  const auto elsewhere = write("elsewhere.geojson", R"({"type":"Polygon","coordinates":
    [[[52000,4],[52004,4],[52004,8],[52000,8],[52000,4]]],"crs":null})");
  const Ran far = vancouver(elsewhere, "-05:00");
  EXPECT_EQ(far.code, 3) << far.out;
  EXPECT_THAT(far.err, HasSubstr("52 km from the scene"));
}

TEST_F(Verify, NearItsThresholdItTellsOfOtherConventions) {
  const Ran always = run(
      {"verify", writeBox(), "--preset", "china-dahan-2", "--points", points(), "--sensitivity", "always"}, kBeijing);
  for (const char* name : {"clock", "refraction", "limb", "declination"})
    EXPECT_THAT(always.out, HasSubstr(std::string("\n  ") + name));
  EXPECT_THAT(always.out, HasSubstr("Asia/Shanghai instead of true solar time"));
  const Ran far = run({"verify", writeBox(), "--preset", "china-dahan-2", "--points", points()}, kBeijing);
  EXPECT_THAT(far.out, Not(HasSubstr("instead of")));
}

TEST_F(Verify, NamesMayBeAsLongAsTheFileSystemHasThem) {
  const auto outputOf = [&](std::size_t length, const std::string& extension) {
    const std::string name = std::string(length - extension.size(), 'a') + extension;
    return run({"verify", writeBox(), "--preset", "china-dahan-2", "--points", points(), "-o", file(name)}, kBeijing);
  };
  for (const char* extension : {".html", ".csv", ".svg"}) {
    const Ran ran = outputOf(300, extension);
    EXPECT_EQ(ran.code, 3) << extension;
    EXPECT_THAT(ran.err, HasSubstr("File name too long")) << extension;
  }
  // The ledger beside it would be too long.
  const Ran beside = outputOf(255, ".csv");
  EXPECT_EQ(beside.code, 3);
  EXPECT_THAT(beside.err, HasSubstr("File name too long"));
  const Ran longest = outputOf(255, ".svg");
  EXPECT_EQ(longest.code, 0) << longest.err;
}

TEST_F(Verify, ExtensionsMayBeInCapitals) {
  for (const char* name : {"e.CSV", "e.Svg", "e.GEOJSON"}) {
    const Ran ran =
        run({"verify", writeBox(), "--preset", "china-dahan-2", "--points", points(), "-o", file(name)}, kBeijing);
    EXPECT_EQ(ran.code, 0) << name << ran.err;
    EXPECT_TRUE(exists(name));
  }
  EXPECT_TRUE(exists("e.CSV.ledger.txt"));
  const Ran page =
      run({"verify", writeBox(), "--preset", "china-dahan-2", "--points", points(), "-o", file("page.HTML")}, kBeijing);
  EXPECT_EQ(page.code, 0) << page.err;
  EXPECT_THAT(read("page.HTML"), HasSubstr("</html>"));
  EXPECT_TRUE(exists("page.csv") && exists("page.gif"));
}

TEST_F(Verify, ARuleOfOnesOwn) {
  const auto box = writeBox();
  Json rule = Json::parse(umbrage({"verify", "--print-preset", "china-dahan-2"}).out);
  rule["name"] = "mine", rule["requirements"][0]["at_least_hours"] = 7.99;
  const auto shed = write("shed.csv", "x,y,z,nx,ny,nz\n0,1.05,0.5,0,-1,0\n");
  const Ran ran = run({"verify", box, "--preset", write("mine.json", rule.dump()), "--points", shed}, kBeijing);
  EXPECT_EQ(ran.code, 1) << ran.err;
  EXPECT_THAT(ran.out, StartsWith("FAIL  mine"));
  rule["requirements"][0]["at_least_hours"] = 9;
  const Ran contradiction =
      run({"verify", box, "--preset", write("mine.json", rule.dump()), "--points", points()}, kBeijing);
  EXPECT_EQ(contradiction.code, 3);
  EXPECT_THAT(contradiction.err, AllOf(HasSubstr("mine.json"), HasSubstr("requirements[0]"),
                                       HasSubstr("9 h are wanted of a window of 8 h")));
}

TEST_F(Verify, RefusalsSayWhy) {
  const auto box = writeBox();
  const auto refused = [&](std::vector<std::string> words, const std::vector<std::string>& where, int code,
                           const std::string& says) {
    words.insert(words.begin(), {"verify", box});
    const Ran ran = run(words, where);
    EXPECT_EQ(ran.code, code) << says << ran.err;
    EXPECT_EQ(ran.out, "") << says;
    EXPECT_THAT(ran.err, HasSubstr(says));
  };
  const auto around =
      write("site.geojson", R"({"type":"Polygon","crs":null,"coordinates":[[[-3,-3],[3,-3],[3,3],[-3,3],[-3,-3]]]})");
  const std::vector<std::string> sydney = {"--lat",  "-33.9",      "--lon", "151",
                                           "--date", "2026-01-01", "--tz",  "Australia/Sydney"};
  refused({"--preset", "china-dahan-9", "--points", points()}, kBeijing, 2, "china-dahan-3");
  refused({"--preset", "none.json", "--points", points()}, kBeijing, 3, "none.json");
  refused({"--preset", "china-dahan-2", "--points", points()}, sydney, 2, "northern hemisphere");
  refused({"--preset", "nsw", "--points", points()}, kBeijing, 2, "southern hemisphere");
  refused({"--preset", "japan-3-2"}, kBeijing, 2, "--site");
  refused({"--preset", "bre209"}, kBeijing, 2, "--areas");
  refused({"--preset", "korea"}, kBeijing, 2, "--points");
  refused({"--preset", "korea", "--areas", park()}, kBeijing, 2, "not at --areas");
  refused({"--preset", "bre209", "--points", points()}, kBeijing, 2, "not at --points");
  refused({"--preset", "bre209", "--areas", park(), "--windows", "*"}, kBeijing, 2,
          "--areas AREAS.geojson; not at --windows");
  refused({"--preset", "korea", "--points", points(), "--site", park()}, kBeijing, 2, "--windows PART; not at --site");
  refused({"--preset", "bre209", "--areas", park(), "--site", park()}, kBeijing, 2,
          "--areas AREAS.geojson; not at --site");
  refused({"--preset", "japan-3-2", "--site", park(), "--areas", park()}, kBeijing, 2,
          "--site SITE.geojson; not at --areas");
  refused({"--preset", "japan-3-2", "--site", park(), "--points", points()}, kBeijing, 2, "not at --points");
  // Too many points are refused before there is any.
  refused({"--preset", "bre209", "--areas", park(), "--grid", "1e-6"}, kBeijing, 2, "take larger steps (--grid)");
  refused({"--preset", "japan-3-2", "--site", around, "--grid", "1e-6"}, kBeijing, 2, "take larger steps (--grid)");
  refused({"--preset", "korea", "--windows", "*", "--grid", "1e-6"}, kBeijing, 2, "take larger steps");
  refused({"--preset", "vancouver", "--areas", park()}, kNewYork, 2, "--baseline");
  refused({"--preset", "en17037-high", "--points", points()}, kBeijing, 2, "--country");
  refused({"--preset", "en17037-high", "--country", "XY", "--points", points()}, kBeijing, 2, "DE");
  refused({"--preset", "korea", "--points", points(), "--windows", "*"}, kBeijing, 2, "exclude each other");
  refused({"--preset", "korea", "--points", points(), "-o", file("e.png")}, kBeijing, 2, ".geojson");
  refused({"--preset", "korea", "--points", points(), "-o", file("p.csv")}, kBeijing, 2, "p.csv");
  refused({"--points", points()}, kBeijing, 2, "--preset");
  const auto degrees = write("d.geojson", R"({"type":"Polygon","coordinates":[[[16,48],[17,48],[17,49],[16,48]]]})");
  refused({"--preset", "bre209", "--areas", degrees}, kBeijing, 3, "reference system");
  const auto other = write("other.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  refused({"--preset", "nyc-ceqr", "--areas", park(), "--baseline", other}, kNewYork, 3, "one frame");
  EXPECT_THAT(files(), ElementsAre("box.off", "d.geojson", "other.obj", "p.csv", "park.geojson", "site.geojson"));
}

}  // namespace
}  // namespace umbrage::cli_test

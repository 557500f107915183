#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "program.hpp"

// Maps: outlines of shadows and what their files hold.
namespace umbrage::cli_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;
using Json = nlohmann::json;

const std::vector<std::string> kVienna = {"--lat",  "48.2",       "--lon", "16.37",
                                          "--date", "2026-09-18", "--tz",  "Europe/Vienna"};

class Maps : public CliTest {
 protected:
  static Ran run(std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return umbrage(words);
  }
  std::string writeSquare() const {
    return write("square.geojson", R"({"type":"FeatureCollection","features":[{"type":"Feature","id":"b7",
      "properties":{"height":10},"geometry":{"type":"Polygon","coordinates":
      [[[16.37,48.2],[16.371,48.2],[16.371,48.201],[16.37,48.201],[16.37,48.2]]]}}]})");
  }
};

double planeArea(const Json& ring) {
  double area = 0.0;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    const double x0 = ring[i][0].get<double>() - ring[0][0].get<double>(),
                 y0 = ring[i][1].get<double>() - ring[0][1].get<double>();
    const double x1 = ring[i + 1][0].get<double>() - ring[0][0].get<double>(),
                 y1 = ring[i + 1][1].get<double>() - ring[0][1].get<double>();
    area += 0.5 * (x0 * y1 - x1 * y0);
  }
  return area;
}

TEST_F(Maps, OutlineOfABox) {
  // The sun of the contract's table: elevation 42.406, azimuth 163.413 at 12:00. The box is 2 x 2 x 2.
  const Ran ran = run({"outline", writeBox(), "--at", "12:00", "-o", file("out.geojson")}, kVienna);
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Json map = Json::parse(read("out.geojson"));
  EXPECT_TRUE(map.at("crs").is_null());
  const Json& feature = map.at("features").at(0);
  const double reach = 2.0 / std::tan(42.406 * M_PI / 180), turn = 163.413 * M_PI / 180;
  const double expected = 4.0 + 2.0 * reach * (std::abs(std::sin(turn)) + std::abs(std::cos(turn)));
  EXPECT_NEAR(feature.at("properties").at("area_m2").get<double>(), expected, 2e-3);
  EXPECT_NEAR(planeArea(feature.at("geometry").at("coordinates").at(0)),
              feature.at("properties").at("area_m2").get<double>(), 1e-6);
  EXPECT_EQ(feature.at("properties").at("time"), "12:00");
  for (const char* subject :
       {"Place", "Date", "Clock", "Sun", "Plane", "North", "Unit", "Input", "Made by", "Coordinates"})
    EXPECT_TRUE(map.at("umbrage").contains(subject)) << subject;
  EXPECT_THAT(map.at("umbrage").at("Input").get<std::string>(), HasSubstr("SHA-256"));
}

TEST_F(Maps, DegreesInDegreesOut) {
  const Ran ran = umbrage({"outline", writeSquare(), "--date", "2026-09-18", "--tz", "Europe/Vienna", "--at", "12:00",
                           "--at", "09:00", "-o", file("out.geojson")});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Json map = Json::parse(read("out.geojson"));
  EXPECT_FALSE(map.contains("crs"));
  ASSERT_EQ(map.at("features").size(), 2U);
  const Json& first = map.at("features").at(0);
  EXPECT_EQ(first.at("properties").at("time"), "09:00");
  EXPECT_EQ(first.at("properties").at("name"), "b7");
  const Json& ring = first.at("geometry").at("coordinates").at(0);
  EXPECT_EQ(ring.front(), ring.back());
  EXPECT_GT(planeArea(ring), 0.0);
  // In the morning the shadow falls towards the west-north-west, and the south-eastern corner stays.
  double west = 180.0, south = 90.0, east = -180.0;
  for (const Json& p : ring) {
    west = std::min(west, p[0].get<double>());
    east = std::max(east, p[0].get<double>());
    south = std::min(south, p[1].get<double>());
  }
  EXPECT_LT(west, 16.3698);
  EXPECT_NEAR(east, 16.371, 1e-9);
  EXPECT_NEAR(south, 48.2, 1e-9);
}

TEST_F(Maps, PartsOfACityJsonBuildingShareOneOutline) {
  // Two cubes of 2 m side by side are one house, a third stands alone 20 m off.
  const auto cube = [](int first) {
    std::string faces;
    for (const auto& f : {"0,3,2,1", "4,5,6,7", "0,1,5,4", "1,2,6,5", "2,3,7,6", "3,0,4,7"}) {
      std::string ring;
      for (const char* c = f; *c != 0; c += c[1] == 0 ? 1 : 2)
        ring += (ring.empty() ? "" : ",") + std::to_string(first + *c - '0');
      faces += (faces.empty() ? "[[" : ",[[") + ring + "]]";
    }
    return R"("geometry":[{"type":"Solid","lod":"2","boundaries":[[)" + faces + "]]}]";
  };
  std::string vertices;
  for (const int x : {0, 2, 20})
    for (const int z : {0, 2})
      for (const auto& [dx, dy] : {std::pair(0, 0), {2, 0}, {2, 2}, {0, 2}})
        vertices += (vertices.empty() ? "[" : ",[") + std::to_string(x + dx) + "," + std::to_string(dy) + "," +
                    std::to_string(z) + "]";
  const auto city = write("houses.city.json", R"({"type":"CityJSON","version":"2.0","CityObjects":{
    "west":{"type":"BuildingPart","parents":["house"],)" +
                                                  cube(0) + R"(},
    "east":{"type":"BuildingPart","parents":["house"],)" +
                                                  cube(8) + R"(},
    "house":{"type":"Building","children":["west","east"]},
    "shed":{"type":"Building",)" + cube(16) + R"(}},"vertices":[)" +
                                                  vertices + "]}");
  const std::vector<std::string> when = {"--at", "12:00", "-o", file("out.geojson")};
  std::vector<std::string> words = {"outline", city};
  words.insert(words.end(), when.begin(), when.end());
  const Ran ran = run(words, kVienna);
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Json features = Json::parse(read("out.geojson")).at("features");
  ASSERT_EQ(features.size(), 2U);
  const double reach = 2.0 / std::tan(42.406 * M_PI / 180), turn = 163.413 * M_PI / 180;
  const auto area = [&](double width) {
    return width * 2.0 + reach * (2.0 * std::abs(std::sin(turn)) + width * std::abs(std::cos(turn)));
  };
  std::map<std::string, Json> named;
  for (const Json& feature : features) named[feature.at("properties").at("name").get<std::string>()] = feature;
  ASSERT_TRUE(named.contains("house") && named.contains("shed"));
  EXPECT_EQ(named.at("house").at("geometry").at("type"), "Polygon");
  EXPECT_NEAR(named.at("house").at("properties").at("area_m2").get<double>(), area(4.0), 2e-3);
  EXPECT_NEAR(named.at("shed").at("properties").at("area_m2").get<double>(), area(2.0), 2e-3);
  words[0] = "envelope";
  words.erase(words.begin() + 2, words.begin() + 4);
  ASSERT_EQ(run(words, kVienna).code, 0);
  EXPECT_EQ(Json::parse(read("out.geojson")).at("features").size(), 2U);
}

TEST_F(Maps, BuildingsOfARealCityAreWhole) {
  const auto city = testData() / "city/DH_01_subs.city.json";
  if (testData().empty() || !std::filesystem::exists(city)) GTEST_SKIP() << "no models (UMBRAGE_TEST_DATA)";
  const Ran ran = umbrage({"outline", city.string(), "--date", "2026-06-21", "--tz", "Europe/Amsterdam", "--lat", "52",
                           "--lon", "4.3", "--at", "12:00", "-o", file("out.geojson")});
  ASSERT_EQ(ran.code, 0) << ran.err;
  // 9 objects with a shape: 8 parts of 3 buildings, and a building.
  const Json features = Json::parse(read("out.geojson")).at("features");
  ASSERT_EQ(features.size(), 4U);
  for (const Json& feature : features)
    EXPECT_THAT(feature.at("properties").at("name").get<std::string>(), StartsWith("GUID_"));
}

TEST_F(Maps, EveryFormat) {
  const auto box = writeBox();
  for (const char* name : {"out.geojson", "out.dxf", "out.svg"}) {
    const Ran ran = run(
        {"outline", box, "--from", "10:00", "--to", "12:00", "--step", "60", "--merged", "-o", file(name)}, kVienna);
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.out, AllOf(StartsWith(file(name)), HasSubstr("11:00")));
    const std::string first = read(name);
    EXPECT_EQ(
        run({"outline", box, "--from", "10:00", "--to", "12:00", "--step", "60", "--merged", "-o", file(name)}, kVienna)
            .code,
        0);
    EXPECT_EQ(read(name), first) << "same input, same bytes";
  }
  EXPECT_THAT(read("out.dxf"), AllOf(HasSubstr("AC1009"), HasSubstr("POLYLINE"), HasSubstr("SHA-256")));
  EXPECT_THAT(read("out.svg"), AllOf(StartsWith("<svg"), HasSubstr("layer-2"), HasSubstr("SHA-256")));
  EXPECT_THAT(files(), ElementsAre("box.off", "out.dxf", "out.geojson", "out.svg"));
}

TEST_F(Maps, RefusalsSayWhy) {
  const auto box = writeBox();
  const auto refused = [&](const std::vector<std::string>& words, int code, const std::string& part) {
    const Ran ran = umbrage(words);
    EXPECT_EQ(ran.code, code) << part;
    EXPECT_THAT(ran.err, HasSubstr(part));
  };
  const std::string out = file("out.svg");
  refused({"outline", box, "--lat", "48.2", "--lon", "16.37", "--date", "2026-09-18", "--tz", "Europe/Vienna", "--at",
           "02:00", "-o", out},
          2, "below the horizon");
  refused({"outline", box, "--lat", "70", "--lon", "20", "--date", "2026-12-21", "--tz", "solar", "--at", "12:00", "-o",
           out},
          2, "does not rise");
  refused({"outline", box, "--date", "2026-09-18", "--tz", "solar", "--at", "12:00", "-o", out}, 2, "no georeference");
  refused({"outline", box, "--lat", "48", "--date", "2026-09-18", "--tz", "solar", "--at", "12:00", "-o", out}, 2,
          "--lon");
  refused({"outline", box, "--lat", "48", "--lon", "16", "--date", "2026-09-18", "--tz", "solar", "-o", out}, 2,
          "--at");
  refused({"outline", box, "--lat", "48", "--lon", "16", "--date", "2026-09-18", "--tz", "solar", "--at", "12:00", "-o",
           file("out.png")},
          2, ".geojson");
  const auto metres =
      write("metres.geojson", R"({"type":"Feature","properties":{"height":3},"geometry":{"type":"Polygon",
    "coordinates":[[[0,0],[20,0],[20,15],[0,0]]]}})");
  refused({"outline", metres, "--lat", "48", "--lon", "16", "--date", "2026-09-18", "--tz", "solar", "--at", "12:00",
           "-o", out},
          3, "--crs local");
  EXPECT_THAT(files(), ElementsAre("box.off", "metres.geojson"));
}

TEST_F(Maps, EnvelopeHoldsEveryMoment) {
  const auto box = writeBox();
  const Ran ran =
      run({"envelope", box, "--from", "10:00", "--to", "15:00", "--merged", "-o", file("out.geojson")}, kVienna);
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Json map = Json::parse(read("out.geojson"));
  const double whole = map.at("features").at(0).at("properties").at("area_m2").get<double>();
  EXPECT_THAT(map.at("umbrage").at("Error bound").get<std::string>(), HasSubstr("within"));
  ASSERT_EQ(
      run({"outline", box, "--from", "10:00", "--to", "15:00", "--step", "30", "--merged", "-o", file("out.geojson")},
          kVienna)
          .code,
      0);
  for (const Json& feature : Json::parse(read("out.geojson")).at("features"))
    EXPECT_LT(feature.at("properties").at("area_m2").get<double>(), whole);
  const Ran night = run({"envelope", box, "--from", "01:00", "--to", "03:00", "-o", file("out.geojson")}, kVienna);
  EXPECT_EQ(night.code, 2);
  EXPECT_THAT(night.err, HasSubstr("never 3 degrees above the horizon"));
  const Ran day = run({"envelope", box, "-o", file("out.geojson")}, kVienna);
  EXPECT_EQ(day.code, 0);
  EXPECT_THAT(day.err, HasSubstr("--min-elevation"));
}

TEST_F(Maps, Isochrones) {
  const auto box = writeBox();
  const Ran ran = run({"isochrones", box, "--hours", "2,1", "--shadow", "-o", file("out.geojson")}, kVienna);
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("of 10000 random points none"));
  const Json map = Json::parse(read("out.geojson"));
  ASSERT_EQ(map.at("features").size(), 2U);
  const auto property = [&](std::size_t i, const char* name) {
    return map.at("features").at(i).at("properties").at(name).get<double>();
  };
  EXPECT_EQ(property(0, "hours"), 1.0);
  EXPECT_EQ(property(1, "hours"), 2.0);
  EXPECT_GT(property(0, "area_m2"), property(1, "area_m2"));
  EXPECT_THAT(map.at("umbrage").at("Error bound").get<std::string>(), HasSubstr("within 0.1 m"));
  EXPECT_EQ(run({"isochrones", box, "--hours", "0", "-o", file("x.svg")}, kVienna).code, 2);
  EXPECT_EQ(run({"isochrones", box, "--hours", "1,two", "-o", file("x.svg")}, kVienna).code, 2);
  const Ran night =
      run({"isochrones", box, "--hours", "1", "--from", "00:00", "--to", "03:00", "-o", file("x.svg")}, kVienna);
  EXPECT_EQ(night.code, 2);
  EXPECT_THAT(night.err, HasSubstr("below the horizon"));
}

TEST_F(Maps, TerrainInTiles) {
  std::string raster = "ncols 40\nnrows 30\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
  for (int row = 0; row < 30; ++row)
    for (int column = 0; column < 40; ++column)
      raster += std::string(column == 20 && row > 5 && row < 25 ? "12" : "0") + (column == 39 ? "\n" : " ");
  const auto wall = write("wall.asc", raster);
  const Ran ran = run({"terrain", wall, "--tile", "16", "--every", "2", "-o", file("out.asc")}, kVienna);
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("20 x 15 values, 6 tiles"));
  EXPECT_THAT(read("out.asc"), StartsWith("ncols 20\nnrows 15\nxllcorner -0.5\nyllcorner 0.5\ncellsize 2\n"));
  EXPECT_THAT(read("out.asc.txt"), AllOf(HasSubstr("SHA-256"), HasSubstr("at least 5 degrees high")));
  EXPECT_EQ(run({"terrain", writeBox(), "-o", file("x.asc")}, kVienna).code, 3);
  EXPECT_EQ(run({"terrain", wall, "--every", "1.5", "-o", file("x.asc")}, kVienna).code, 2);
  EXPECT_EQ(run({"terrain", wall, "--from", "00:00", "--to", "02:00", "-o", file("x.asc")}, kVienna).code, 2);
}

// A file of which nothing was left gives no map of an open field.
TEST_F(Maps, WithoutCastersThereIsNoFigure) {
  const auto sunken = write("sunken.geojson", R"({"type":"Feature","properties":{"height":-10},"geometry":
    {"type":"Polygon","coordinates":[[[16.37,48.2],[16.371,48.2],[16.371,48.201],[16.37,48.2]]]}})");
  const auto points = write("p.csv", "x,y,z,nx,ny,nz\n0,0,3,0,0,1\n");
  const std::vector<std::vector<std::string>> commands = {
      {"hours", "--grid", "1", "-o", file("o.csv")},
      {"hours", "--points", points, "-o", file("o.csv")},
      {"outline", "--at", "12:00", "-o", file("o.geojson")},
      {"envelope", "-o", file("o.geojson")},
      {"isochrones", "--hours", "1", "-o", file("o.geojson")},
      {"profile", "--from", "11:00", "--to", "12:00", "--step", "60", "-o", file("o.png")}};
  const std::vector<std::string> nowhere(kVienna.begin() + 4, kVienna.end());
  for (const auto& command : commands)
    for (const auto& where : {kVienna, nowhere}) {
      std::vector<std::string> words = {command[0], sunken};
      words.insert(words.end(), command.begin() + 1, command.end());
      const Ran ran = run(words, where);
      EXPECT_EQ(ran.code, 3) << command[0];
      EXPECT_THAT(ran.err, AllOf(HasSubstr("1 of 1 feature dropped: a height that is negative"),
                                 HasSubstr("error: " + sunken + ": has nothing that casts shadows")));
    }
  EXPECT_THAT(files(), ElementsAre("p.csv", "sunken.geojson"));
}

TEST_F(Maps, PolarDaysAndNights) {
  const auto raster = write("r.asc", "ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 1\n0 0 0\n0 2 0\n0 0 0\n");
  const std::vector<std::string> night = {"--lat", "78", "--lon", "15", "--date", "2026-12-21", "--tz", "UTC"};
  const std::vector<std::string> day = {"--lat", "78", "--lon", "15", "--date", "2026-06-21", "--tz", "UTC"};
  const Ran dark = run({"terrain", raster, "-o", file("o.asc")}, night);
  EXPECT_EQ(dark.code, 2);
  EXPECT_THAT(dark.err, HasSubstr("never 5 degrees above the horizon from 00:00 to 24:00 (--min-elevation); it does "
                                  "not rise on that day"));
  for (const auto& words : {std::vector<std::string>{"envelope", writeBox(), "-o", file("o.geojson")},
                            {"isochrones", writeBox(), "--hours", "1", "-o", file("o.geojson")},
                            {"outline", writeBox(), "--at", "12:00", "-o", file("o.geojson")}}) {
    const Ran ran = run(words, night);
    EXPECT_EQ(ran.code, 2);
    EXPECT_THAT(ran.err, HasSubstr("it does not rise on that day"));
  }
  EXPECT_FALSE(exists("o.geojson"));
  const Ran whole = run({"envelope", writeBox(), "-o", file("o.geojson")}, day);
  EXPECT_EQ(whole.code, 0);
  EXPECT_THAT(whole.out, HasSubstr("00:00 to 24:00 "));
  EXPECT_EQ(run({"terrain", raster, "-o", file("o.asc")}, day).code, 0);
  EXPECT_THAT(read("o.asc"), HasSubstr("24.0000"));
}

TEST_F(Maps, ClocksThatChangeAreTold) {
  const auto raster = write("r.asc", "ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 1\n0 0 0\n0 2 0\n0 0 0\n");
  const std::vector<std::string> spring = {"--lat",  "48.2",       "--lon", "16.37",
                                           "--date", "2026-03-29", "--tz",  "Europe/Vienna"};
  const std::vector<std::string> autumn = {"--lat",  "48.2",       "--lon", "16.37",
                                           "--date", "2026-10-25", "--tz",  "Europe/Vienna"};
  const std::string both = "UTC+01:00 (CET), then UTC+02:00 (CEST)";
  ASSERT_EQ(run({"terrain", raster, "-o", file("o.asc")}, spring).code, 0);
  EXPECT_THAT(read("o.asc.txt"), HasSubstr(both));
  ASSERT_EQ(run({"isochrones", writeBox(), "--hours", "1", "-o", file("o.geojson")}, spring).code, 0);
  EXPECT_THAT(read("o.geojson"), HasSubstr(both));
  const Ran left = run({"terrain", raster, "--from", "02:30", "-o", file("o.asc")}, spring);
  EXPECT_EQ(left.code, 2);
  EXPECT_THAT(left.err, HasSubstr("does not exist in Europe/Vienna"));
  const Ran twice = run({"terrain", raster, "--from", "02:30", "-o", file("o.asc")}, autumn);
  EXPECT_EQ(twice.code, 0);
  EXPECT_THAT(twice.err, HasSubstr("02:30"));
  const Ran back = run({"terrain", raster, "--from", "10:00", "--to", "09:00", "-o", file("o.asc")}, autumn);
  EXPECT_THAT(back.err, HasSubstr("the period from 10:00 to 09:00 is empty or runs backwards"));
}

TEST_F(Maps, TerrainReceiversStandAsHighAsAsked) {
  // A ridge along the middle column: above it the sun is seen all the time, and at its foot never less than from the foot's surface.
  std::string raster = "ncols 21\nnrows 5\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 21; ++column)
      raster += std::string(column == 10 ? "6" : "0") + (column == 20 ? "\n" : " ");
  const auto ridge = write("ridge.asc", raster);
  const auto hours = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"terrain", ridge, "-o", file("out.asc")};
    words.insert(words.end(), more.begin(), more.end());
    const Ran ran = run(words, kVienna);
    EXPECT_EQ(ran.code, 0) << ran.err;
    std::vector<double> values;
    std::istringstream in(read("out.asc"));
    for (std::string line; std::getline(in, line);)
      if (line.find_first_of("abcdefghijklmnopqrstuvwxyz") == std::string::npos) {
        std::istringstream row(line);
        for (double value = 0.0; row >> value;) values.push_back(value);
      }
    return values;
  };
  const auto ground = hours({});
  EXPECT_THAT(read("out.asc.txt"), HasSubstr("Receivers: 0.01 m above the middle of every cell, facing up"));
  const auto eyes = hours({"--above", "7"});
  EXPECT_THAT(read("out.asc.txt"), HasSubstr("Receivers: 7 m above the middle of every cell"));
  const auto feet = hours({"--above", "7", "--unit", "ft"});
  EXPECT_THAT(read("out.asc.txt"), HasSubstr("Receivers: 2.1336 m above the middle of every cell"));
  ASSERT_EQ(ground.size(), 21u * 5u);
  ASSERT_EQ(eyes.size(), ground.size());
  const double up = eyes.front();
  EXPECT_GT(up, 10.0);
  for (std::size_t i = 0; i < eyes.size(); ++i) {
    EXPECT_EQ(eyes[i], up) << "above everything";
    EXPECT_EQ(feet[i], up) << "in feet as in metres, nothing is higher";
    EXPECT_LE(ground[i], up);
  }
  EXPECT_LT(ground[21 * 2 + 8], 0.7 * up) << "beside the ridge";
  EXPECT_EQ(run({"terrain", ridge, "--above", "-1", "-o", file("x.asc")}, kVienna).code, 2);
}

TEST_F(Maps, AFarPlaceIsWorthAWarning) {
  const Ran ran = run({"outline", writeSquare(), "--at", "12:00", "-o", file("out.svg")},
                      {"--lat", "35", "--lon", "139", "--date", "2026-09-18", "--tz", "solar"});
  EXPECT_EQ(ran.code, 0);
  EXPECT_THAT(ran.err, HasSubstr("km from where the scene says"));
}

TEST_F(Maps, TrueNorthIsWorthAWarning) {
  const auto rotterdam = write("r.geojson", R"({"type":"FeatureCollection","crs":{"type":"name","properties":
    {"name":"urn:ogc:def:crs:EPSG::28992"}},"features":[{"type":"Feature","properties":{"height":20},"geometry":
    {"type":"Polygon","coordinates":[[[91000,435700],[91010,435700],[91010,435710],[91000,435700]]]}}]})");
  const std::vector<std::string> when = {"--date", "2026-06-21", "--tz", "Europe/Amsterdam",
                                         "--at",   "12:00",      "-o",   file("out.geojson")};
  const Ran plain = run({"outline", rotterdam}, when);
  EXPECT_THAT(plain.err, AllOf(HasSubstr("0.73 degrees"), HasSubstr("--north true")));
  const std::string before = read("out.geojson");
  const Ran asked = run({"outline", rotterdam, "--north", "true"}, when);
  EXPECT_THAT(asked.err, IsEmpty());
  EXPECT_NE(read("out.geojson"), before);
}

}  // namespace
}  // namespace umbrage::cli_test

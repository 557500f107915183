#include "umbrage/geo/projection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>

namespace umbrage::geo {
namespace {

TEST(Projection, localMetresAreMetres) {
  const auto local = Projection::make(localCrs({139.7, 35.55}));
  ASSERT_TRUE(local) << local.error().text();
  EXPECT_FALSE(local->isGeographic());
  // The radii of curvature of WGS84 at this latitude, in closed form.
  const double a = 6378137.0, e2 = 0.00669437999014132, s = std::sin(35.55 * M_PI / 180.0);
  const double meridian = a * (1 - e2) / std::pow(1 - e2 * s * s, 1.5), vertical = a / std::sqrt(1 - e2 * s * s);
  const double step = 1e-3 * M_PI / 180.0;
  const auto north = local->fromDegrees({139.7, 35.551}), east = local->fromDegrees({139.701, 35.55});
  ASSERT_TRUE(north && east);
  EXPECT_NEAR(north->x, 0.0, 1e-6);
  EXPECT_NEAR(north->y, meridian * step, 1e-4);
  EXPECT_NEAR(east->x, vertical * std::cos(35.55 * M_PI / 180.0) * step, 1e-5);
  EXPECT_NEAR(local->trueNorth({0, 0})->degrees(), 0.0, 1e-6);
}

TEST(Projection, thereAndBack) {
  for (const char* name : {"EPSG:28992", "EPSG:7415", "EPSG:3035", "EPSG:32633", "EPSG:4326", "OGC:CRS84"}) {
    const auto projection = Projection::make(name);
    ASSERT_TRUE(projection) << projection.error().text();
    const auto xy = projection->fromDegrees({4.4, 51.9});
    ASSERT_TRUE(xy);
    const auto place = projection->toDegrees(*xy);
    EXPECT_NEAR(place->longitude, 4.4, 1e-8) << name;
    EXPECT_NEAR(place->latitude, 51.9, 1e-8) << name;
  }
}

TEST(Projection, knownPlaces) {
  // The origin of the Dutch grid, the tower of Onze Lieve Vrouwe in Amersfoort: 52.155174 N 5.387206 E on Bessel, about 100 m
  // from that on WGS84.
  const auto dutch = Projection::make("EPSG:28992");
  ASSERT_TRUE(dutch);
  const auto tower = dutch->toDegrees({155000, 463000});
  EXPECT_LT(distance(*tower, {5.387206, 52.155174}), 150.0);
  EXPECT_NEAR(dutch->trueNorth({155000, 463000})->degrees(), 0.0, 0.01);
  // West of the central meridian true north lies clockwise of the grid's.
  EXPECT_GT(dutch->trueNorth({90000, 435500})->degrees(), 0.5);
  EXPECT_DOUBLE_EQ(dutch->metresPerUnit(), 1.0);
  EXPECT_TRUE(Projection::make("EPSG:4326")->isGeographic());
  EXPECT_NEAR(Projection::make("EPSG:2263")->metresPerUnit(), 0.3048006096, 1e-9);  // New York, US survey feet
}

TEST(Projection, distanceOfADegree) {
  EXPECT_NEAR(distance({0, 0}, {0, 1}), 111195, 1);
  EXPECT_NEAR(distance({179.5, 60}, {-179.5, 60}), 55597, 2);
}

TEST(Projection, namesInTheWild) {
  EXPECT_EQ(shortName("urn:ogc:def:crs:EPSG::28992"), "EPSG:28992");
  EXPECT_EQ(shortName("https://www.opengis.net/def/crs/EPSG/0/7415"), "EPSG:7415");
  EXPECT_EQ(shortName("urn:ogc:def:crs:OGC:1.3:CRS84"), "OGC:CRS84");
  EXPECT_EQ(shortName("local"), "local");
}

TEST(Projection, refusesWhatItDoesNotKnow) {
  for (const char* name :
       {"EPSG:99999999", "local", "", "+proj=nonsense +ellps=WGS84", "+proj=pipeline +step +proj=tmerc",
        "+init=/etc/passwd", "file:/etc/passwd", "+proj=hgridshift +grids=/etc/passwd"})
    EXPECT_FALSE(Projection::make(name)) << name;
  EXPECT_EQ(Projection::make("EPSG:5773").error().code, ErrorCode::unsupported);  // heights above a geoid
}

TEST(Projection, saysWhenItsDataAreMissing) {
  ::setenv("PROJ_LIB", "/nowhere", 1);
  ::setenv("PROJ_DATA", "/nowhere", 1);
  const auto dutch = Projection::make("EPSG:28992");
  const auto local = Projection::make(localCrs({4, 52}));
  ::unsetenv("PROJ_LIB");
  ::unsetenv("PROJ_DATA");
  ASSERT_FALSE(dutch);
  EXPECT_NE(dutch.error().message.find("proj.db"), std::string::npos) << dutch.error().text();
  EXPECT_TRUE(local) << "needs no data";
}

}  // namespace
}  // namespace umbrage::geo

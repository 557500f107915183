#pragma once

#include <string>
#include <vector>

#include "program.hpp"

namespace umbrage::cli_test {

/// What tests of verdicts share: places, points, a park.
class VerifyTest : public CliTest {
 protected:
  static Ran run(std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return umbrage(words);
  }
  std::string points() const { return write("p.csv", "x,y,z,nx,ny,nz\n0,14,1.5,0,-1,0\n0,3,1.5,0,-1,0\n"); }
  // A box of 2 m by 2 m about the origin; a park north of it.
  std::string park() const {
    return write("park.geojson", R"({"type":"Feature","properties":{"name":"park"},"geometry":{"type":"Polygon",
      "coordinates":[[[-4,2],[4,2],[4,8],[-4,8],[-4,2]]]},"crs":null})");
  }
  const std::vector<std::string> kBeijing = {"--lat",  "39.9",       "--lon", "116.4",
                                             "--date", "2026-01-01", "--tz",  "Asia/Shanghai"};
  const std::vector<std::string> kNewYork = {"--lat",  "40.71",      "--lon", "-74",
                                             "--date", "2026-01-01", "--tz",  "-05:00"};
};

}  // namespace umbrage::cli_test

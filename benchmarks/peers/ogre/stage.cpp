#include "stage.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <tuple>
#include <utility>

namespace umbrage::peers {
namespace {

std::istream& operator>>(std::istream& in, Point& p) { return in >> p[0] >> p[1] >> p[2]; }

Part readPart(std::istream& in) {
  Part part;
  std::string name;
  std::size_t corners = 0, triangles = 0;
  in >> name >> part.casts >> corners >> triangles;
  for (Point p{}; corners-- > 0 && in >> p;) part.corners.push_back(p);
  for (std::array<unsigned, 3> t{}; triangles-- > 0 && in >> t[0] >> t[1] >> t[2];) part.triangles.push_back(t);
  return part;
}

StageShot readShot(std::istream& in) {
  StageShot shot;
  in >> shot.name >> shot.eye >> shot.target >> shot.fovY >> shot.light;
  return shot;
}

std::pair<long, long> squareOf(const Part& part, double side) {
  double x = 0, y = 0;
  for (const Point& p : part.corners) x += p[0], y += p[1];
  const double n = double(part.corners.size());
  return {std::lround(std::floor(x / n / side)), std::lround(std::floor(y / n / side))};
}

void append(Part& to, const Part& part) {
  const auto first = static_cast<unsigned>(to.corners.size());
  to.corners.insert(to.corners.end(), part.corners.begin(), part.corners.end());
  for (const auto& t : part.triangles) to.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

}  // namespace

const StageShot* Stage::shot(const std::string& name) const {
  const auto at = std::find_if(shots.begin(), shots.end(), [&](const StageShot& s) { return s.name == name; });
  return at == shots.end() ? nullptr : &*at;
}

std::optional<Stage> readStage(const std::string& path) {
  std::ifstream in(path);
  Stage stage;
  for (std::string word; in >> word;) {
    if (word == "mesh")
      stage.parts.push_back(readPart(in));
    else if (word == "shot")
      stage.shots.push_back(readShot(in));
    else
      return std::nullopt;
    if (!in) return std::nullopt;
  }
  if (stage.parts.empty() || stage.shots.empty()) return std::nullopt;
  return stage;
}

std::vector<Part> merged(const std::vector<Part>& parts, double side, std::size_t limit) {
  if (side <= 0.0) return parts;
  std::vector<Part> all;
  std::map<std::tuple<bool, long, long>, std::size_t> open;  // the part of a square that still takes more
  for (const Part& part : parts) {
    const auto [x, y] = squareOf(part, side);
    const auto [at, fresh] = open.try_emplace({part.casts, x, y}, all.size());
    if (fresh || all[at->second].corners.size() + part.corners.size() > limit) {
      at->second = all.size();
      all.push_back({part.casts, {}, {}});
    }
    append(all[at->second], part);
  }
  return all;
}

}  // namespace umbrage::peers

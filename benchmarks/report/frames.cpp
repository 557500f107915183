#include "report/frames.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "median.hpp"

namespace umbrage::benchmarks {
namespace {

using Json = nlohmann::ordered_json;

FrameTimes::Shot readShot(const Json& j) {
  FrameTimes::Shot shot{j.at("scene"), j.at("shot"), j.at("triangles"), {}, {}};
  for (const Json& c : j.at("contestants")) {
    shot.times[c.at("name")] = c.at("ms").get<std::vector<double>>();
    shot.phases[c.at("name")] = c.at("phases").get<std::map<std::string, double>>();
  }
  return shot;
}

FrameTimes read(const Json& j) {
  FrameTimes all;
  for (const auto& [name, value] : j.at("facts").items()) all.facts.emplace_back(name, value);
  all.rounds = j.at("rounds");
  for (const Json& shot : j.at("shots")) {
    all.shots.push_back(readShot(shot));
    for (const Json& c : shot.at("contestants"))
      if (std::find(all.contestants.begin(), all.contestants.end(), c.at("name")) == all.contestants.end())
        all.contestants.push_back(c.at("name"));
  }
  return all;
}

const std::vector<double>* timesOf(const FrameTimes::Shot& shot, const std::string& contestant) {
  const auto at = shot.times.find(contestant);
  return at == shot.times.end() || at->second.empty() ? nullptr : &at->second;
}

}  // namespace

Result<FrameTimes> readFrameTimes(const std::filesystem::path& path) {
  try {
    std::ifstream in(path);
    return read(Json::parse(in));
  } catch (const Json::exception& e) {
    return fail(ErrorCode::input, e.what(), path.string());
  }
}

double medianTime(const FrameTimes::Shot& shot, const std::string& contestant) {
  const auto* times = timesOf(shot, contestant);
  return times == nullptr ? std::numeric_limits<double>::quiet_NaN() : median(*times);
}

double ratio(const FrameTimes::Shot& shot, const std::string& one, const std::string& other) {
  const auto *a = timesOf(shot, one), *b = timesOf(shot, other);
  if (a == nullptr || b == nullptr) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> ratios;
  for (std::size_t i = 0; i < std::min(a->size(), b->size()); ++i) ratios.push_back((*a)[i] / (*b)[i]);
  return median(ratios);
}

}  // namespace umbrage::benchmarks

// A chart from JSON, as SVG: umbrage_plot CHART.json OUT.svg
//   {"kind": "lines", "title": "..", "subtitle": "..", "x": {"label": "..", "log": true}, "y": {"label": "..", "log": true},
//    "series": [{"name": "..", "points": [[x, y], ..]}, ..]}
//   {"kind": "bars", "title": "..", "subtitle": "..", "value": {"label": "..", "log": false}, "groups": ["..", ..],
//    "series": [{"name": "..", "values": [v or null, ..]}, ..]}
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>

#include "plot/chart.hpp"
#include "umbrage/base/file.hpp"

namespace umbrage::benchmarks {
namespace {

using nlohmann::json;

Axis axis(const json& j) { return {j.value("label", ""), j.value("log", false)}; }

LineChart lines(const json& j) {
  LineChart chart{j.value("title", ""), j.value("subtitle", ""), axis(j.at("x")), axis(j.at("y")), {}};
  for (const json& s : j.at("series")) chart.series.push_back({s.at("name"), s.at("points")});
  return chart;
}

BarChart bars(const json& j) {
  BarChart chart{j.value("title", ""), j.value("subtitle", ""), axis(j.at("value")), j.at("groups"), {}};
  for (const json& s : j.at("series")) {
    chart.series.push_back({s.at("name"), {}});
    for (const json& v : s.at("values"))
      chart.series.back().values.push_back(v.is_number() ? v.get<double>() : std::numeric_limits<double>::quiet_NaN());
  }
  return chart;
}

}  // namespace
}  // namespace umbrage::benchmarks

int main(int argc, char** argv) {
  using namespace umbrage::benchmarks;
  if (argc != 3) {
    std::cerr << "usage: umbrage_plot CHART.json OUT.svg\n";
    return 2;
  }
  try {
    std::ifstream in(argv[1]);
    const json chart = json::parse(in);
    const std::string picture = chart.at("kind") == "lines" ? svg(lines(chart)) : svg(bars(chart));
    if (const auto done = umbrage::writeFile(argv[2], picture); !done) {
      std::cerr << done.error().text() << "\n";
      return EXIT_FAILURE;
    }
  } catch (const json::exception& e) {
    std::cerr << argv[1] << ": " << e.what() << "\n";
    return EXIT_FAILURE;
  }
}

// Silhouette finders x sizes x shapes x kinds of light, all in one run: each round asks every finder about the same lights, so that what
// disturbs the machine disturbs all of them; the least of the rounds counts. One thread unless said otherwise. Prints tables.
//   umbrage_silhouette_benchmark [--quick] [--json FILE] [--markdown FILE] [--charts DIR]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <map>
#include <random>
#include <thread>

#include "plot/chart.hpp"
#include "support/finder_meshes.hpp"
#include "umbrage/base/file.hpp"
#include "umbrage/samples/samples.hpp"
#include "umbrage/shadow/finders/finder.hpp"
#include "umbrage/shadow/finders/many_lights.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::benchmarks {
namespace {

using shadow::CasterSet;
using shadow::FinderKind;
using Casters = std::shared_ptr<const CasterSet>;

constexpr int kLights = 24, kRounds = 9, kSuns = 400;
constexpr std::array kFinders{FinderKind::bruteForce, FinderKind::bruteForceSimd, FinderKind::hextree,
                              FinderKind::hough, FinderKind::potentiallyVisible};

double milliseconds(const auto& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// What other programs on the machine did not disturb.
double least(const std::vector<double>& values) { return *std::min_element(values.begin(), values.end()); }

struct Row {
  std::string shape, light, finder;
  std::size_t triangles, edges;
  double build, query, tested, found, bytesPerEdge;
};

std::vector<Vec4> lightsFor(const CasterSet& casters, bool points) {
  std::mt19937 random(7);
  const auto unit = [&] { return double(random() >> 8) * 0x1p-23 - 1.0; };
  std::vector<Vec4> lights;
  while (lights.size() < kLights) {
    const double x = unit(), y = unit(), z = unit();
    const Vec3 d = glm::normalize(Vec3(x, y, 0.1 + std::abs(z)));
    lights.push_back(points ? Vec4(casters.bounds.centre() + 1.5 * casters.bounds.radius() * d, 1.0) : Vec4(d, 0.0));
  }
  return lights;
}

struct Asked {
  std::unique_ptr<shadow::SilhouetteFinder> finder;
  double build = 0.0;
};

std::vector<Asked> build(const Casters& casters) {
  std::vector<Asked> all;
  for (const FinderKind kind : kFinders) {
    Asked asked;
    std::vector<double> times;
    for (int i = 0; i < (kind == FinderKind::potentiallyVisible ? 1 : 3); ++i)
      times.push_back(milliseconds([&] { asked.finder = shadow::makeFinder(kind, casters, {.threads = 1}); }));
    asked.build = least(times);
    all.push_back(std::move(asked));
  }
  return all;
}

void ask(const std::string& shape, const Casters& casters, std::vector<Row>& rows) {
  const std::vector<Asked> all = build(casters);
  for (const bool points : {true, false}) {
    const auto lights = lightsFor(*casters, points);
    std::vector<std::vector<double>> times(all.size());
    std::vector<std::array<double, 2>> counts(all.size());
    for (int round = 0; round < kRounds; ++round) {
      for (std::size_t f = 0; f < all.size(); ++f) {
        counts[f] = {};
        times[f].push_back(milliseconds([&] {
                             for (const Vec4& light : lights) {
                               const auto found = all[f].finder->find(light);
                               counts[f][0] += double(found.tested), counts[f][1] += double(found.edges.size());
                             }
                           }) /
                           kLights);
      }
    }
    for (std::size_t f = 0; f < all.size(); ++f) {
      if (all[f].finder->kind() == FinderKind::potentiallyVisible && !points) continue;
      rows.push_back({shape, points ? "point" : "directional", std::string(shadow::name(all[f].finder->kind())),
                      casters->triangles.size(), casters->edges.size(), all[f].build, least(times[f]),
                      counts[f][0] / kLights, counts[f][1] / kLights,
                      double(all[f].finder->memory()) / double(casters->edges.size())});
      const Row& r = rows.back();
      std::printf("%-6s %8zu %-11s %-19s %9.3f ms  tested %9.0f  found %8.0f  built in %8.1f ms  %6.1f bytes an edge\n",
                  r.shape.c_str(), r.triangles, r.light.c_str(), r.finder.c_str(), r.query, r.tested, r.found, r.build,
                  r.bytesPerEdge);
      std::fflush(stdout);
    }
  }
}

// --- many suns ---------------------------------------------------------------------------------------------------------------

struct Batch {
  std::string shape;
  std::size_t triangles;
  unsigned threads;
  double oneByOne, hextree, kept, visited;  ///< milliseconds for all suns
};

// Days through a year, hours through a day.
std::vector<Vec4> suns() {
  constexpr double kPi = 3.14159265358979;
  std::vector<Vec4> directions;
  for (int i = 0; i < kSuns; ++i) {
    const double declination = 0.41 * std::sin(2.0 * kPi * (i / 20) / 20.0), hour = (i % 20 - 9.5) / 20.0 * 0.9 * kPi,
                 latitude = 0.84;
    const double up =
        std::sin(latitude) * std::sin(declination) + std::cos(latitude) * std::cos(declination) * std::cos(hour);
    const double south =
        std::sin(latitude) * std::cos(declination) * std::cos(hour) - std::cos(latitude) * std::sin(declination);
    directions.emplace_back(glm::normalize(Vec3(-std::cos(declination) * std::sin(hour), -south, std::max(up, 0.02))),
                            0.0);
  }
  return directions;
}

void askMany(const std::string& shape, const Casters& casters, std::vector<Batch>& rows) {
  const auto directions = suns();
  const auto brute = shadow::makeFinder(FinderKind::bruteForce, casters),
             tree = shadow::makeFinder(FinderKind::hextree, casters);
  const unsigned processors = std::max(1u, std::thread::hardware_concurrency());
  for (const unsigned threads : {1u, processors}) {
    const shadow::ManyLights many(casters, {.threads = threads});
    std::array<std::vector<double>, 4> times;
    for (int round = 0; round < 5; ++round) {
      if (round < 3) {
        times[0].push_back(milliseconds([&] {
          for (const Vec4& d : directions) (void)brute->find(d);
        }));
        times[1].push_back(milliseconds([&] {
          for (const Vec4& d : directions) (void)tree->find(d);
        }));
      }
      times[2].push_back(milliseconds([&] { (void)many.find(directions); }));
      times[3].push_back(milliseconds([&] { many.visit(directions, [](std::size_t, const shadow::FoundEdges&) {}); }));
    }
    rows.push_back({shape, casters->triangles.size(), threads, least(times[0]), least(times[1]), least(times[2]),
                    least(times[3])});
    const Batch& b = rows.back();
    std::printf(
        "%d suns, %-8s %8zu triangles, %u threads: brute force %7.1f ms, hextree %7.1f ms, ManyLights::find %6.1f ms "
        "(%.1fx), "
        "::visit %6.1f ms (%.1fx)\n",
        kSuns, b.shape.c_str(), b.triangles, threads, b.oneByOne, b.hextree, b.kept, b.oneByOne / b.kept, b.visited,
        b.oneByOne / b.visited);
    if (processors == 1) break;
  }
}

// --- what is written ----------------------------------------------------------------------------------------------------------

std::string json(const std::vector<Row>& rows, const std::vector<Batch>& batches) {
  std::string out = "{\"queries\": [";
  for (const Row& r : rows)
    out += fmt::format(
        "{}\n  {{\"shape\": \"{}\", \"light\": \"{}\", \"finder\": \"{}\", \"triangles\": {}, \"edges\": {}, "
        "\"build_ms\": {:.3f}, "
        "\"query_ms\": {:.5f}, \"tested\": {:.1f}, \"found\": {:.1f}, \"bytes_per_edge\": {:.2f}}}",
        &r == rows.data() ? "" : ",", r.shape, r.light, r.finder, r.triangles, r.edges, r.build, r.query, r.tested,
        r.found, r.bytesPerEdge);
  out += "\n], \"suns\": [";
  for (const Batch& b : batches)
    out += fmt::format(
        "{}\n  {{\"shape\": \"{}\", \"triangles\": {}, \"threads\": {}, \"suns\": {}, \"brute_force_ms\": {:.2f}, "
        "\"hextree_ms\": {:.2f}, \"many_find_ms\": {:.2f}, \"many_visit_ms\": {:.2f}}}",
        &b == batches.data() ? "" : ",", b.shape, b.triangles, b.threads, kSuns, b.oneByOne, b.hextree, b.kept,
        b.visited);
  return out + "\n]}\n";
}

std::string chartOf(const std::vector<Row>& rows, const std::string& shape, const std::string& light) {
  LineChart chart{fmt::format("One query, {} meshes, {} light", shape, light),
                  "one thread, the least of nine rounds; all finders return the same edges",
                  {"triangles", true},
                  {"milliseconds", true},
                  {}};
  for (const FinderKind kind : kFinders) {
    LineChart::Series series{std::string(shadow::name(kind)), {}};
    for (const Row& r : rows)
      if (r.shape == shape && r.light == light && r.finder == series.name)
        series.points.emplace_back(double(r.triangles), r.query);
    if (!series.points.empty()) chart.series.push_back(series);
  }
  return svg(chart);
}

const Row* rowOf(const std::vector<Row>& rows, const Row& like, FinderKind kind) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const Row& r) {
    return r.shape == like.shape && r.light == like.light && r.triangles == like.triangles &&
           r.finder == shadow::name(kind);
  });
  return found == rows.end() ? nullptr : &*found;
}

// The largest mesh of each shape as a table, and the suns.
std::string markdown(const std::vector<Row>& rows, const std::vector<Batch>& batches) {
  std::string out =
      "| mesh | light | finder | query, ms | x brute_force_simd | tested / found | found | built in, brute_force_simd "
      "queries | bytes an edge |\n"
      "|---|---|---|--:|--:|--:|--:|--:|--:|\n";
  for (const Row& r : rows) {
    const Row* simd = rowOf(rows, r, FinderKind::bruteForceSimd);
    if (r.triangles < 5'000 || simd == nullptr) continue;
    out += fmt::format("| {} {} | {} | {} | {:.3f} | {:.2f} | {:.2f} | {:.0f} | {:.0f} | {:.1f} |\n", r.shape,
                       shortNumber(double(r.triangles)), r.light, r.finder, r.query, simd->query / r.query,
                       r.tested / r.found, r.found, r.build / simd->query, r.bytesPerEdge);
  }
  out += fmt::format(
      "\n| {} suns | threads | brute_force, ms | hextree, ms | ManyLights::find, ms | ManyLights::visit, ms | visit x "
      "brute_force |\n"
      "|---|--:|--:|--:|--:|--:|--:|\n",
      kSuns);
  for (const Batch& b : batches)
    out += fmt::format("| {} {} | {} | {:.0f} | {:.0f} | {:.0f} | {:.0f} | {:.1f} |\n", b.shape,
                       shortNumber(double(b.triangles)), b.threads, b.oneByOne, b.hextree, b.kept, b.visited,
                       b.oneByOne / b.visited);
  return out;
}

bool save(const std::string& path, const std::string& content) {
  const auto written = writeFile(path, content);
  if (!written) std::fprintf(stderr, "%s\n", written.error().text().c_str());
  return written.has_value();
}

int run(bool quick, const std::string& jsonFile, const std::string& markdownFile, const std::string& chartFolder) {
  const std::map<std::string, shadow::test_meshes::Mesh (*)(std::uint32_t)> shapes{
      {"smooth", shadow::test_meshes::smooth},
      {"boxy", [](std::uint32_t n) { return shadow::test_meshes::boxy(n); }},
      {"soup", shadow::test_meshes::soup}};
  const std::vector<std::uint32_t> sizes =
      quick ? std::vector<std::uint32_t>{1'100, 10'000} : std::vector<std::uint32_t>{1'100, 10'000, 100'000, 1'000'000};
  std::vector<Row> rows;
  for (const auto& [shape, make] : shapes)
    for (const std::uint32_t size : sizes) ask(shape, std::make_shared<const CasterSet>(make(size).casters()), rows);
  std::vector<Batch> batches;
  const auto building = samples::make("building");
  if (building)
    askMany("building", std::make_shared<const CasterSet>(shadow::makeGeometry(*building)->casters), batches);
  if (!quick)
    askMany("smooth", std::make_shared<const CasterSet>(shadow::test_meshes::smooth(1'000'000).casters()), batches);
  bool good = jsonFile.empty() || save(jsonFile, json(rows, batches));
  if (!markdownFile.empty()) good = save(markdownFile, markdown(rows, batches)) && good;
  if (!chartFolder.empty())
    for (const auto& [shape, make] : shapes)
      for (const char* light : {"point", "directional"})
        good = save(fmt::format("{}/silhouettes_{}_{}.svg", chartFolder, shape, light), chartOf(rows, shape, light)) &&
               good;
  return good ? 0 : 1;
}

}  // namespace
}  // namespace umbrage::benchmarks

int main(int count, char** words) {
  bool quick = false;
  std::string json, markdown, charts;
  for (int i = 1; i < count; ++i) {
    if (std::strcmp(words[i], "--quick") == 0) {
      quick = true;
    } else if (std::strcmp(words[i], "--json") == 0 && i + 1 < count) {
      json = words[++i];
    } else if (std::strcmp(words[i], "--markdown") == 0 && i + 1 < count) {
      markdown = words[++i];
    } else if (std::strcmp(words[i], "--charts") == 0 && i + 1 < count) {
      charts = words[++i];
    } else {
      std::fprintf(stderr, "usage: %s [--quick] [--json FILE] [--markdown FILE] [--charts DIR]\n", words[0]);
      return 2;
    }
  }
  return umbrage::benchmarks::run(quick, json, markdown, charts);
}

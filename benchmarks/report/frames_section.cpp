// The section on frames of docs/results.md, on the standard output, and its pictures:
//   umbrage_frames_section FRAMES.json PICTURES-FOLDER
// The pictures' links are relative to the folder above PICTURES-FOLDER. Contestants whose names begin with "ogre" are Ogre's, each with
// other settings; the fastest in a view is the one we are held against.
//   umbrage_frames_section --settings FRAMES.json
// What Ogre's settings cost, beside those of the contestant "ogre".
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <iterator>

#include "plot/chart.hpp"
#include "report/frames.hpp"
#include "report/pictures.hpp"
#include "umbrage/base/file.hpp"

namespace umbrage::benchmarks {
namespace {

namespace fs = std::filesystem;
constexpr const char* kPeer = "ogre";
constexpr const char* kBare = "bare_rays";

std::string cell(double value) { return std::isnan(value) ? "" : shortNumber(value); }

bool isPeer(const std::string& contestant) { return contestant.starts_with(kPeer); }

std::vector<std::string> chosen(const FrameTimes& all, const std::function<bool(const std::string&)>& which) {
  std::vector<std::string> names;
  std::copy_if(all.contestants.begin(), all.contestants.end(), std::back_inserter(names), which);
  return names;
}

std::vector<std::string> ours(const FrameTimes& all) {
  return chosen(all, [](const std::string& name) { return !isPeer(name) && name != kBare; });
}

// The fastest of Ogre's settings in this shot; kPeer when none took part.
std::string fastestPeer(const FrameTimes::Shot& shot) {
  std::string best = kPeer;
  for (const auto& [name, times] : shot.times)
    if (isPeer(name) && !(medianTime(shot, best) <= medianTime(shot, name))) best = name;
  return best;
}

double timesFaster(const FrameTimes::Shot& shot, const std::string& name) {
  return ratio(shot, fastestPeer(shot), name);
}

// A table with a row for each shot and a column for each name.
std::string table(const FrameTimes& all, const std::vector<std::string>& names,
                  const std::function<std::string(const FrameTimes::Shot&, const std::string&)>& entry) {
  std::string out = "| view |", rule = "|---|";
  for (const auto& name : names) out += " " + name + " |", rule += "---:|";
  out += "\n" + rule + "\n";
  for (const auto& shot : all.shots) {
    out += "| " + shot.name + " |";
    for (const auto& name : names) out += " " + entry(shot, name) + " |";
    out += "\n";
  }
  return out;
}

// What our frames are made of: a row for each shot and technique that works in the phases of shadow volumes.
std::string phases(const FrameTimes& all) {
  constexpr const char* kNames[] = {"surface", "depth",   "facing", "tiles",   "silhouette", "useless",  "layers",
                                    "sides",   "extrude", "upload", "volumes", "lit",        "readback", "shading"};
  std::string out = "| view | technique |", rule = "|---|---|";
  for (const char* name : kNames) out += fmt::format(" {} |", name), rule += "---:|";
  out += "\n" + rule + "\n";
  for (const auto& shot : all.shots)
    for (const auto& technique : ours(all)) {
      const auto at = shot.phases.find(technique);
      if (at == shot.phases.end() || !at->second.contains("volumes")) continue;
      out += fmt::format("| {} | {} |", shot.name, technique);
      for (const char* name : kNames) {
        const auto phase = at->second.find(name);
        out += fmt::format(" {} |", phase == at->second.end() ? "" : fmt::format("{:.1f}", phase->second));
      }
      out += "\n";
    }
  return out;
}

std::string facts(const FrameTimes& all) {
  std::string out;
  for (const auto& [name, value] : all.facts) out += "- " + name + ": " + value + "\n";
  return out + fmt::format("- rounds: {}\n", all.rounds);
}

BarChart chart(const FrameTimes& all, const std::vector<std::string>& names,
               const std::function<double(const FrameTimes::Shot&, const std::string&)>& value) {
  BarChart made;
  for (const auto& shot : all.shots) made.groups.push_back(shot.name);
  for (const auto& name : names) {
    made.series.push_back({name, {}});
    for (const auto& shot : all.shots) made.series.back().values.push_back(value(shot, name));
  }
  return made;
}

BarChart timesChart(const FrameTimes& all) {
  BarChart made = chart(all, all.contestants, medianTime);
  made.title = "A frame at 1280 x 720";
  made.subtitle = "median milliseconds; bare_rays: Embree's shadow rays alone, without finding what is seen";
  made.value = {"milliseconds", false};
  return made;
}

BarChart ratioChart(const FrameTimes& all) {
  BarChart made = chart(all, ours(all), timesFaster);
  made.title = "Ogre's time divided by ours";
  made.subtitle = "median over the rounds of the ratio within a round; above 1 ours is faster";
  made.value = {"times faster than Ogre 1.12's stencil shadows", false};
  return made;
}

Result<std::string> section(const FrameTimes& all, const fs::path& measured, const fs::path& pictures) {
  const std::string folder = pictures.filename().string();
  std::string out = "## Frames\n\n" + facts(all) + "\n";
  if (auto done = writeFile(pictures / "results-frames.svg", svg(timesChart(all))); !done)
    return tl::unexpected(done.error());
  out += fmt::format("![Milliseconds a frame]({}/results-frames.svg)\n\nMedian milliseconds a frame:\n\n", folder);
  out += table(all, all.contestants, [](const auto& s, const auto& n) { return cell(medianTime(s, n)); });
  const auto taking = [&](const char* name) {
    return std::find(all.contestants.begin(), all.contestants.end(), name) != all.contestants.end();
  };
  if (taking(kPeer)) {
    if (auto done = writeFile(pictures / "results-against-ogre.svg", svg(ratioChart(all))); !done)
      return tl::unexpected(done.error());
    out += "\nOgre's time, with the faster of its two ways, divided by ours (above 1 ours is faster):\n\n";
    out += table(all, ours(all), [](const auto& s, const auto& n) { return cell(timesFaster(s, n)); });
    out += fmt::format("\n![Ogre's time divided by ours]({}/results-against-ogre.svg)\n", folder);
  }
  if (taking(kBare)) {
    out += "\nOur time for the whole frame divided by that of bare Embree shadow rays:\n\n";
    out += table(all, ours(all), [](const auto& s, const auto& n) { return cell(ratio(s, n, kBare)); });
  }
  out += "\nWhere the milliseconds of shadow volumes go:\n\n" + phases(all);
  std::vector<std::pair<fs::path, fs::path>> pairs;
  for (const auto& shot : all.shots)
    pairs.emplace_back(measured / (shot.name + "-zpass.png"), measured / (shot.name + "-ogre.ppm"));
  const auto sheet = writeSideBySide(pairs, pictures / "results-pictures.png");
  if (!sheet) return tl::unexpected(sheet.error());
  if (*sheet)
    out += fmt::format("\nWhat was drawn, left by zpass, right by Ogre:\n\n![The views]({}/results-pictures.png)\n",
                       folder);
  return out;
}

std::string settings(const FrameTimes& all) {
  return "\nOgre's time with other settings, divided by that of `ogre`:\n\n" +
         table(all, chosen(all, isPeer), [](const auto& s, const auto& n) { return cell(ratio(s, n, kPeer)); });
}

}  // namespace
}  // namespace umbrage::benchmarks

int main(int argc, char** argv) {
  using namespace umbrage::benchmarks;
  if (argc == 3 && std::string_view(argv[1]) == "--settings") {
    const auto all = readFrameTimes(argv[2]);
    if (!all)
      std::cerr << all.error().text() << "\n";
    else
      std::cout << settings(*all);
    return all ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  if (argc != 3) {
    std::cerr << "usage: umbrage_frames_section FRAMES.json PICTURES-FOLDER\n";
    return 2;
  }
  const std::filesystem::path file = argv[1];
  const auto all = readFrameTimes(file);
  const auto text = all ? section(*all, file.parent_path(), argv[2]) : tl::unexpected(all.error());
  if (!text) {
    std::cerr << text.error().text() << "\n";
    return EXIT_FAILURE;
  }
  std::cout << *text;
}

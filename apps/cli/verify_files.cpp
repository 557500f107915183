#include "verify_files.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "day_pictures.hpp"
#include "map.hpp"
#include "outputs.hpp"
#include "umbrage/base/file.hpp"
#include "verify_page.hpp"
#include "verify_words.hpp"

namespace umbrage::cli {
namespace {

constexpr std::string_view kPage = ".html";
constexpr std::chrono::minutes kStep{30};  // from picture to picture of a day
constexpr std::chrono::hours kDay{24};

std::string ledgerText(const std::vector<study::LedgerLine>& ledger) {
  std::string text;
  for (const study::LedgerLine& line : ledger) text += line.subject + ": " + line.text + "\n";
  return text;
}

// The day that brings most new shadow. REQUIRES: there is one.
const DayNews& worstDay(const std::vector<DayNews>& news) {
  const auto hours = [](const DayNews& day) {
    double sum = 0.0;
    for (const rules::AreaNews& area : day.news.areas) sum += area.areaHours;
    return sum;
  };
  return *std::max_element(news.begin(), news.end(),
                           [&](const DayNews& a, const DayNews& b) { return hours(a) < hours(b); });
}

VerdictReport withWorstDay(VerdictReport report) {
  if (report.news.size() > 1) report.news = {DayNews(worstDay(report.news))};
  return report;
}

/// Lines of one subject, numbered from the second on: in GeoJSON subjects are the names of members, and of two alike readers keep one.
void addLines(report::VectorMap& map, const std::string& subject, const std::vector<std::string>& lines) {
  for (std::size_t i = 0; i < lines.size(); ++i)
    map.ledger.push_back({i == 0 ? subject : fmt::format("{} {}", subject, i + 1), lines[i]});
}

/// A picture of several days is none, so it has the day that brings most; GeoJSON has them all.
Result<report::VectorMap> verdictMap(const VerdictFiles& files, const VerdictReport& report, bool allDays) {
  auto map = mapOf(files.scene, outline::castersOf(files.scene), files.plane, report.request.place, files.place, "", {},
                   files.casters);
  if (!map) return map;
  map->title = fmt::format("{}: {}", report.verdict.rule.name, report.verdict.passes ? "passes" : "fails");
  map->subtitle = shortName(std::filesystem::path(files.scene.source).filename().string());
  map->ledger = report.verdict.ledger;
  map->ledger.insert(map->ledger.begin() + 2, {"Verdict", report.verdict.passes ? "passes" : "fails"});
  addLines(*map, "Checked", report.verdict.rule.checked);
  addLines(*map, "Uncertain", report.verdict.rule.uncertain);
  addVerdict(*map, allDays ? report : withWorstDay(report), files.scene);
  map->aboutFeatures = report.areas.empty();  // points, mostly on walls
  return map;
}

std::vector<Output> tableOutputs(const std::string& path, const VerdictReport& report) {
  return {{path + ".ledger.txt",
           [&report](const std::string& p) { return writeFile(p, ledgerText(report.verdict.ledger)); }},
          {path, [&report](const std::string& p) { return writeFile(p, verdictCsv(report)); }}};
}

/// The day that decides the verdict. Where all days are added up, the one that brings most of those that are told of.
std::chrono::year_month_day dayOf(const VerdictReport& report) {
  if (const auto date = rules::decidingOf(report.verdict).date) return *date;
  return report.news.empty() ? report.request.date : worstDay(report.news).date;
}

Box3 receiversBox(const rules::TargetSet& set) {
  Box3 box;
  for (const rules::Target& target : set.targets) box.add(target.receiver.position);
  return box;
}

/// The day's pictures at whole half hours of its clock, from the first to the last moment that counts. None where the sun does not count.
Result<DayPictures> decidingDay(const VerdictFiles& files, const VerdictReport& report, const Console& console) {
  const auto date = dayOf(report);
  const auto counts = rules::countingOn(report.verdict.rule, decidingMeasure(report.verdict), date, report.request);
  if (counts.empty()) return DayPictures{};
  const auto clock = [&](sun::Instant instant) {
    return sun::clockAt(report.request.zone, report.request.place, instant).clock;
  };
  const auto first = clock(counts.front().from), last = clock(counts.back().to);
  const std::chrono::milliseconds step = kStep;
  study::Period period{report.request.place, report.request.zone, date};
  period.from = first.date == date ? (first.time + step - std::chrono::milliseconds(1)) / step * step
                                   : std::chrono::milliseconds(0);
  period.to = last.date == date ? last.time / step * step : std::chrono::milliseconds(kDay);
  period.step = step;
  if (period.from >= period.to) return DayPictures{};
  return picturesOf(files.scene, receiversBox(report.targets), period, console);
}

std::string stemOf(const std::string& page) { return page.substr(0, page.size() - kPage.size()); }

Result<void> writePage(const VerdictFiles& files, const VerdictReport& report, const Console& console) {
  auto page = verdictPage(report, files.scene);
  if (!page) return tl::unexpected(page.error());
  const auto everything = verdictMap(files, report, true);
  if (!everything) return tl::unexpected(everything.error());
  auto drawn = verdictMap(files, report, false);
  if (!drawn) return tl::unexpected(drawn.error());
  drawn->ledger.clear();  // the page has it
  page->maps.push_back({"On the map", report::svgText(*drawn)});
  const auto day = decidingDay(files, report, console);
  if (!day) return tl::unexpected(day.error());
  auto pictures = pagePictures(*day);
  if (!pictures) return tl::unexpected(pictures.error());
  page->pictures = std::move(*pictures);
  page->command = console.commandLine();
  const std::string stem = stemOf(files.output);
  std::vector<Output> outputs = tableOutputs(stem + ".csv", report);
  outputs.push_back(
      {stem + ".geojson", [&](const std::string& path) { return report::writeGeoJson(*everything, path); }});
  if (!day->pictures.empty())
    outputs.push_back(
        {stem + ".gif", [&](const std::string& path) { return report::writeGif(path, animationOf(*day)); }});
  for (const Output& output : outputs) page->evidence.push_back(std::filesystem::path(output.path).filename().string());
  outputs.push_back({files.output, [&](const std::string& path) { return writeFile(path, report::studyPage(*page)); }});
  return writeOutputs(outputs);
}

}  // namespace

Result<std::vector<std::string>> verdictFiles(const std::string& output) {
  if (auto known = checkExtension("-o", output, {".csv", ".geojson", ".dxf", ".svg", std::string(kPage)}); !known)
    return tl::unexpected(known.error());
  if (hasExtension(output, ".csv")) return std::vector{output, output + ".ledger.txt"};
  if (!hasExtension(output, kPage)) return std::vector{output};
  const std::string stem = stemOf(output);
  return std::vector{output, stem + ".csv", stem + ".csv.ledger.txt", stem + ".geojson", stem + ".gif"};
}

Result<void> writeVerdict(const VerdictFiles& files, const VerdictReport& report, const Console& console) {
  if (hasExtension(files.output, ".csv")) return writeOutputs(tableOutputs(files.output, report));
  if (hasExtension(files.output, kPage)) return writePage(files, report, console);
  const auto map = verdictMap(files, report, hasExtension(files.output, ".geojson"));
  if (!map) return tl::unexpected(map.error());
  MapOptions options;
  options.output = files.output;
  return write(*map, options);
}

}  // namespace umbrage::cli

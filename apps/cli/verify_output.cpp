#include "verify_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "console.hpp"
#include "umbrage/outline/combine.hpp"
#include "umbrage/report/colours.hpp"
#include "umbrage/rules/cells.hpp"
#include "umbrage/study/georeference.hpp"
#include "verify_words.hpp"

namespace umbrage::cli {
namespace {

using rules::Finding;
using rules::Measure;
using rules::ReceiverResult;
using rules::Requirement;
using rules::Verdict;

constexpr std::size_t kMostNamed = 10;  // receivers that fail, in the text
constexpr double kRoundness = 1e-4;     // of the distance of a band around a site: what rounding corners costs
constexpr double kMarker = 0.25;        // metres: half the side of the square that shows a point on the map

const char* passText(bool passes) { return passes ? "passes" : "fails"; }

std::string receiverText(const VerdictReport& r, const Finding& f, const ReceiverResult& result) {
  const Measure& m = requirementOf(r, f).anyOf[result.measure];
  std::string text =
      fmt::format("{} {}, {} {}; {} at {}", duration(result.value), quantity(m), comparison(m),
                  duration(result.threshold), sun::dateText(result.date), positionText(r, placeOf(r, result), ","));
  if (!result.spans.empty()) text += " [" + spansText(r, result.spans) + "]";
  return text;
}

std::string findingText(const VerdictReport& r, const Finding& f) {
  const Requirement& requirement = requirementOf(r, f);
  std::string text = fmt::format("  {}: {}: {}\n", f.group, requirement.name, passText(f.passes));
  if (f.newShare)
    return text +
           fmt::format("    {} of {} is newly shaded ({}), at most {:g} %\n", newShareText(*f.newShare),
                       sunOfDays(r, requirement.anyOf.front()), newShadowText(r, f.newAreaHours),
                       100.0 * *requirement.mostNew) +
           (f.outlines ? "    " + outlinesText(r, f) + "\n" : "");
  text += fmt::format("    {} of {} receivers{} pass, {} wanted", percent(f.share), f.receivers.size(),
                      r.targets.step > 0.0 ? " by area" : "", percent(f.wanted));
  if (f.formerShare) text += fmt::format(" ({} before)", percent(*f.formerShare));
  if (const std::string lines = failingLines(r, f); !lines.empty()) text += "; " + lines;
  if (f.outlines) return text + "\n    " + outlinesText(r, f) + "\n";
  text += fmt::format(
      "\n    {}: {}\n",
      std::isinf(f.margin) ? "nothing has to pass; the best" : "deciding, " + duration(f.margin, true) + " to spare",
      receiverText(r, f, f.receivers[*f.deciding]));
  std::size_t failing = 0;
  for (const ReceiverResult& result : f.receivers) {
    if (result.passes || &result == &f.receivers[*f.deciding]) continue;
    if (++failing <= kMostNamed && r.targets.step == 0.0) text += "    fails: " + receiverText(r, f, result) + "\n";
  }
  if (failing > 0 && (failing > kMostNamed || r.targets.step > 0.0))
    text += fmt::format("    {} more receivers fail\n", r.targets.step > 0.0 ? failing : failing - kMostNamed);
  return text;
}

std::string visitText(const VerdictReport& r, const rules::Visit& visit) {
  std::string text =
      fmt::format("    {}-{}  {}", clockOf(r, visit.span.from), clockOf(r, visit.span.to), shortName(visit.building));
  if (visit.most > 0.0) text += fmt::format(", at most {:.1f} m2 at {}", visit.most, clockOf(r, visit.mostAt));
  return text + "\n";
}

std::string newsText(const VerdictReport& r, const DayNews& day) {
  std::string text = fmt::format("New shadow on {} ({}):\n", sun::dateText(day.date), r.request.zone.name);
  for (const rules::AreaNews& area : day.news.areas) {
    const bool point = area.size == 0.0 && r.targets.step == 0.0;
    if (area.all.empty())
      text += fmt::format("  {}: none\n", area.area);
    else if (point)
      text += fmt::format("  {}: {}\n", area.area, duration(area.areaHours));
    else
      text += fmt::format("  {}: {:.2f} m2 h\n", area.area, area.areaHours);
    for (const rules::Visit& visit : area.visits) text += visitText(r, visit);
  }
  return text;
}

std::string switchesText(const VerdictReport& r) {
  const Verdict& v = r.verdict;
  if (v.switches.empty()) return {};
  std::string text =
      std::string(v.nearThreshold ? "Near a threshold. W" : "W") + "ith one convention turned at a time:\n";
  for (const rules::SwitchOutcome& s : v.switches)
    text += fmt::format("  {:<12} {} instead of {}: {}{}\n", s.name, s.instead, s.taken, passText(s.passes),
                        v.findings.front().newShare || std::isinf(s.margin)
                            ? ""
                            : fmt::format(", {} to spare", duration(s.margin, true)));
  return text;
}

std::string list(const char* title, const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += fmt::format("{}\n  - {}", text.empty() ? title : "", line);
  return text.empty() ? text : text + "\n";
}

// ---- JSON

Json spansJson(const VerdictReport& r, const std::vector<study::TimeSpan>& spans) {
  Json all = Json::array();
  for (const study::TimeSpan& span : spans)
    all.push_back({{"from", clockOf(r, span.from)}, {"to", clockOf(r, span.to)}});
  return all;
}

Json receiverJson(const VerdictReport& r, const Finding& f, const ReceiverResult& result) {
  const Measure& m = requirementOf(r, f).anyOf[result.measure];
  Json json = {{"position", toJson(placeOf(r, result))},
               {"passes", result.passes},
               {"hours", result.value},
               {"of", quantity(m)},
               {"comparison", comparison(m)},
               {"threshold_hours", result.threshold},
               {"margin_hours", result.margin},
               {"date", sun::dateText(result.date)},
               {"times", spansJson(r, result.spans)}};
  if (!m.name.empty()) json["measure"] = m.name;
  return json;
}

Json outlinesJson(const VerdictReport& r, const rules::NewOutlines& o) {
  return {{"days", o.days},
          {"area_hours", o.areaHours},
          {"date", sun::dateText(o.date)},
          {"area_hours_then", o.areaHoursThen},
          {"times", spansJson(r, o.spans)}};
}

Json findingJson(const VerdictReport& r, const Finding& f) {
  Json json = {{"requirement", requirementOf(r, f).name}, {"group", f.group}, {"passes", f.passes}};
  if (f.newShare) {
    json["new_share"] = *f.newShare, json[r.targets.step > 0.0 ? "new_area_hours" : "new_hours"] = f.newAreaHours;
    json["at_most"] = *requirementOf(r, f).mostNew;
    if (f.outlines) json["outlines"] = outlinesJson(r, *f.outlines);
    return json;
  }
  json["share"] = f.share, json["wanted_share"] = f.wanted;
  if (f.formerShare) json["former_share"] = *f.formerShare;
  if (std::isfinite(f.margin)) json["margin_hours"] = f.margin;
  if (f.outlines) json["outlines"] = outlinesJson(r, *f.outlines);
  json["deciding"] = receiverJson(r, f, f.receivers[*f.deciding]);
  // Grids are in the CSV and on the map.
  if (r.targets.step > 0.0)
    json["receivers"] = f.receivers.size();
  else
    for (const ReceiverResult& result : f.receivers) json["receivers"].push_back(receiverJson(r, f, result));
  return json;
}

Json visitJson(const VerdictReport& r, const rules::Visit& visit) {
  Json json = {{"enters", clockOf(r, visit.span.from)}, {"leaves", clockOf(r, visit.span.to)}};
  if (!visit.building.empty()) json["building"] = visit.building;
  if (visit.most > 0.0) json["most_m2"] = visit.most, json["most_at"] = clockOf(r, visit.mostAt);
  return json;
}

Json newsJson(const VerdictReport& r, const DayNews& day) {
  Json areas = Json::array();
  for (const rules::AreaNews& area : day.news.areas) {
    Json one = {{"area", area.area},
                {"m2", area.size},
                {"area_hours", area.areaHours},
                {"all", Json::array()},
                {"visits", Json::array()}};
    for (const rules::Visit& visit : area.all) one["all"].push_back(visitJson(r, visit));
    for (const rules::Visit& visit : area.visits) one["visits"].push_back(visitJson(r, visit));
    areas.push_back(std::move(one));
  }
  return {{"date", sun::dateText(day.date)}, {"added", day.news.added}, {"areas", std::move(areas)}};
}

// ---- map

std::size_t addLayer(report::VectorMap& map, const std::string& name, double t, bool heat, double opacity = 0.0) {
  for (std::size_t i = 0; i < map.layers.size(); ++i)
    if (map.layers[i].name == name) return i;
  map.layers.push_back({name, heat ? report::heatColour(t) : report::timeColour(t), opacity});
  return map.layers.size() - 1;
}

outline::Region square(const Vec2& centre, double half) {
  outline::Region region;
  region.polygons.push_back(
      {{centre - Vec2(half, half), centre + Vec2(half, -half), centre + Vec2(half, half), centre + Vec2(-half, half)},
       {}});
  region.area = 4.0 * half * half;
  return region;
}

void addPoints(report::VectorMap& map, const VerdictReport& r, const Finding& f, const scene::Scene& scene) {
  for (const ReceiverResult& result : f.receivers) {
    const Measure& m = requirementOf(r, f).anyOf[result.measure];
    report::MapFeature feature{
        addLayer(map, std::string("points that ") + (result.passes ? "pass" : "fail"), result.passes ? 0.2 : 0.9, true),
        square(study::mapPoint(placeOf(r, result), scene.up), kMarker / scene.metresPerUnit),
        {}};
    feature.properties = {{"requirement", requirementOf(r, f).name},
                          {"at", positionText(r, placeOf(r, result), ",")},
                          {"hours", result.value},
                          {"of", std::string(quantity(m))},
                          {"threshold_hours", result.threshold},
                          {"margin_hours", result.margin},
                          {"date", sun::dateText(result.date)},
                          {"times", spansText(r, result.spans)}};
    map.features.push_back(std::move(feature));
  }
}

// The part of an area, or of a band around a site, whose receivers fail.
outline::Region failingPart(const VerdictReport& r, const Finding& f, const std::vector<rules::CellMiddle>& cells,
                            double metresPerUnit) {
  const outline::Region& area = r.areas.at(f.groupIndex).region;
  if (r.verdict.rule.receivers != rules::ReceiverKind::site) return rules::cellsWithin(area, cells, r.targets.step);
  const rules::Band band = requirementOf(r, f).band.value_or(rules::Band{});
  const auto around = [&](double metres) {
    if (metres <= 0.0) return area;
    const double distance = metres / metresPerUnit;
    return outline::grown(area, distance, kRoundness * distance);
  };
  const outline::Region part = outline::without(rules::cellsOf(cells, r.targets.step), around(band.from));
  return band.to ? outline::common(part, around(*band.to)) : part;
}

// Those on lines around a site have no area.
void addFailingLines(report::VectorMap& map, const VerdictReport& r, const Finding& f,
                     const std::vector<outline::Region>& markers) {
  if (markers.empty()) return;
  report::MapFeature feature{addLayer(map, "fails", 0.9, true), outline::together(markers), {}};
  feature.properties = {
      {"requirement", requirementOf(r, f).name}, {"group", f.group}, {"points_on_lines", double(markers.size())}};
  map.features.push_back(std::move(feature));
}

void addFailing(report::VectorMap& map, const VerdictReport& r, const Finding& f, const scene::Scene& scene) {
  std::vector<rules::CellMiddle> cells;
  std::vector<outline::Region> markers;
  for (const ReceiverResult& result : f.receivers) {
    const Vec2 at = study::mapPoint(placeOf(r, result), scene.up);
    const bool onLine = r.targets.targets[result.target].weight == 0.0;
    if (!onLine) cells.push_back({at, !result.passes});
    if (onLine && !result.passes) markers.push_back(square(at, kMarker / scene.metresPerUnit));
  }
  addFailingLines(map, r, f, markers);
  outline::Region part = failingPart(r, f, cells, map.metresPerUnit);
  if (part.polygons.empty()) return;
  report::MapFeature feature{addLayer(map, "fails", 0.9, true), std::move(part), {}};
  feature.properties = {{"requirement", requirementOf(r, f).name},
                        {"group", f.group},
                        {"area_m2", feature.region.area * map.metresPerUnit * map.metresPerUnit}};
  map.features.push_back(std::move(feature));
}

void addMoments(report::VectorMap& map, const VerdictReport& r, const DayNews& day) {
  const double unit = map.metresPerUnit * map.metresPerUnit;
  const auto& moments = day.news.moments;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const std::string time = sun::dateText(day.date) + " " + clockOf(r, moments[i].at);
    if (moments[i].region.polygons.empty()) continue;
    const std::size_t layer = addLayer(map, "new shadow, " + time, (double(i) + 0.5) / double(moments.size()), false);
    for (const outline::Shadow& shadow : moments[i].byBuilding) {
      report::MapFeature feature{layer, shadow.region, {}};
      feature.properties = {{"building", shadow.name}, {"time", time}, {"area_m2", shadow.region.area * unit}};
      map.features.push_back(std::move(feature));
    }
  }
}

}  // namespace

std::string verdictText(const VerdictReport& r) {
  const Verdict& v = r.verdict;
  std::string text = fmt::format("{}  {}: {}\n", v.passes ? "PASS" : "FAIL", v.rule.name, v.rule.title);
  for (const Finding& f : v.findings) text += findingText(r, f);
  text += switchesText(r);
  for (const DayNews& day : r.news) text += newsText(r, day);
  text += list("Checked against:", v.rule.checked);
  text += list("Uncertain in this preset:", v.rule.uncertain);
  text += list("Notes:", v.rule.notes);
  return text + fmt::format("Source: {}\n", v.rule.source);
}

Json verdictJson(const VerdictReport& r) {
  const Verdict& v = r.verdict;
  Json json = {{"rule", v.rule.name},           {"title", v.rule.title},     {"source", v.rule.source},
               {"where", v.rule.where},         {"passes", v.passes},        {"near_threshold", v.nearThreshold},
               {"findings", Json::array()},     {"switches", Json::array()}, {"new_shadow", Json::array()},
               {"uncertain", v.rule.uncertain}, {"notes", v.rule.notes},     {"warnings", v.warnings},
               {"checked", v.rule.checked},     {"ledger", Json::object()}};
  for (const Finding& f : v.findings) json["findings"].push_back(findingJson(r, f));
  for (const rules::SwitchOutcome& s : v.switches)
    json["switches"].push_back({{"name", s.name},
                                {"taken", s.taken},
                                {"instead", s.instead},
                                {"passes", s.passes},
                                {"margin", std::isfinite(s.margin) ? Json(s.margin) : Json()}});
  for (const DayNews& day : r.news) json["new_shadow"].push_back(newsJson(r, day));
  for (const study::LedgerLine& line : v.ledger) json["ledger"][line.subject] = line.text;
  return json;
}

std::string csvText(const std::string& text) {
  // What spreadsheets take for the beginning of a formula, also behind blanks, is told to be text.
  const auto first = text.find_first_not_of(" \t\r\n");
  const bool formula = first != text.npos && std::string_view("=+-@").find(text[first]) != std::string_view::npos;
  std::string out = formula ? "\"'" : "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string verdictCsv(const VerdictReport& r) {
  std::string text =
      "group,requirement,x,y,z,nx,ny,nz,weight,from_site,passes,hours,threshold,margin,date,intervals,new_"
      "share,at_most\n";
  for (const Finding& f : r.verdict.findings) {
    // What is asked of shares is no matter of single receivers.
    if (f.newShare)
      text +=
          fmt::format("{},{},,,,,,,,,{},,,,,,{:.10g},{:.10g}\n", csvText(f.group), csvText(requirementOf(r, f).name),
                      f.passes ? 1 : 0, *f.newShare, *requirementOf(r, f).mostNew);
    else if (f.outlines)
      text += fmt::format("{},{},,,,,,,,,0,{:.7f},0.0000000,{:.7f},{},{},,\n", csvText(f.group),
                          csvText(requirementOf(r, f).name), -f.margin, f.margin, sun::dateText(f.outlines->date),
                          spansText(r, f.outlines->spans));
    for (const ReceiverResult& result : f.receivers) {
      const rules::Target& t = r.targets.targets[result.target];
      const Vec3 &p = t.receiver.position, &n = t.receiver.normal;
      text += fmt::format("{},{},{},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{},{:.7f},{:.7f},{:.7f},{},{},,\n",
                          csvText(f.group), csvText(requirementOf(r, f).name), p.x, p.y, p.z, n.x, n.y, n.z, t.weight,
                          t.fromSite, result.passes ? 1 : 0, result.value, result.threshold, result.margin,
                          sun::dateText(result.date), spansText(r, result.spans));
    }
  }
  return text;
}

void addVerdict(report::VectorMap& map, const VerdictReport& r, const scene::Scene& scene) {
  const bool site = r.verdict.rule.receivers == rules::ReceiverKind::site;
  std::vector<std::vector<const Finding*>> findings(r.areas.size());
  for (const Finding& f : r.verdict.findings)
    if (!r.areas.empty()) findings[f.groupIndex].push_back(&f);
  for (std::size_t i = 0; i < r.areas.size(); ++i) {
    const rules::Area& area = r.areas[i];
    report::MapFeature feature{addLayer(map, site ? "site" : "areas", 0.0, true, 0.25), area.region, {}};
    feature.properties = {{"name", area.name}, {"area_m2", area.region.area * map.metresPerUnit * map.metresPerUnit}};
    for (const Finding* f : findings[i])
      feature.properties.emplace_back(requirementOf(r, *f).name, std::string(passText(f->passes)));
    map.features.push_back(std::move(feature));
  }
  for (const Finding& f : r.verdict.findings)
    if (r.targets.step > 0.0)
      addFailing(map, r, f, scene);
    else
      addPoints(map, r, f, scene);
  for (const DayNews& day : r.news) addMoments(map, r, day);
}

}  // namespace umbrage::cli

#include "verify_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "console.hpp"
#include "umbrage/study/ledger.hpp"
#include "verify_words.hpp"

namespace umbrage::cli {
namespace {

using rules::Finding;
using rules::Measure;
using rules::ReceiverResult;

constexpr std::size_t kMostBars = 40;  // of one chart; all are in the table of the evidence

const Measure& measureOf(const VerdictReport& r, const Finding& f, const ReceiverResult& result) {
  return requirementOf(r, f).anyOf[result.measure];
}

bool countsSun(const Measure& m) {
  return m.statistic == rules::Statistic::sun || m.statistic == rules::Statistic::longestSun;
}

// Hours since the midnight that begins `date`, by the clock asked for.
double hourOf(const VerdictReport& r, std::chrono::year_month_day date, sun::Instant instant) {
  const auto clock = sun::clockAt(r.request.zone, r.request.place, instant).clock;
  const auto days = std::chrono::sys_days(clock.date) - std::chrono::sys_days(date);
  return std::chrono::duration<double, std::ratio<3600>>(clock.time).count() + 24.0 * double(days.count());
}

std::vector<report::DayPart> partsOf(const VerdictReport& r, std::chrono::year_month_day date,
                                     const std::vector<study::TimeSpan>& spans) {
  std::vector<report::DayPart> parts;
  for (const study::TimeSpan& span : spans) parts.push_back({hourOf(r, date, span.from), hourOf(r, date, span.to)});
  return parts;
}

std::string found(const VerdictReport& r, const Finding& f) {
  if (f.outlines) return outlinesText(r, f);
  if (f.newShare)
    return fmt::format("{} of {} newly shaded ({})", newShareText(*f.newShare),
                       sunOfDays(r, requirementOf(r, f).anyOf.front()), newShadowText(r, f.newAreaHours));
  if (f.receivers.size() == 1 && f.deciding) {
    const ReceiverResult& only = f.receivers[*f.deciding];
    return fmt::format("{} {}", duration(only.value), quantity(measureOf(r, f, only)));
  }
  std::string text = fmt::format("{} of {} receivers pass", percent(f.share), f.receivers.size());
  if (f.formerShare) text += fmt::format(" ({} before)", percent(*f.formerShare));
  if (const std::string lines = failingLines(r, f); !lines.empty()) text += "; " + lines;
  return text;
}

std::string asked(const VerdictReport& r, const Finding& f) {
  const rules::Requirement& requirement = requirementOf(r, f);
  if (requirement.mostNew) return fmt::format("at most {:g} %", 100.0 * *requirement.mostNew);
  std::string text;
  for (const Measure& m : requirement.anyOf) {
    const double hours = std::chrono::duration<double, std::ratio<3600>>(m.threshold).count();
    text += fmt::format("{}{} {} {}", text.empty() ? "" : ", or ", comparison(m), duration(hours), quantity(m));
  }
  if (f.receivers.size() > 1) text += fmt::format(", {} of them", percent(f.wanted));
  return text;
}

report::Criterion criterion(const VerdictReport& r, const Finding& f) {
  const std::string group = f.group.empty() ? "" : f.group + ": ";
  return {group + requirementOf(r, f).name, found(r, f), asked(r, f),
          f.newShare || std::isinf(f.margin) ? std::string() : duration(f.margin, true), f.passes};
}

std::string verdictSentence(const VerdictReport& r) {
  const auto& findings = r.verdict.findings;
  const auto failing = std::ranges::count_if(findings, [](const Finding& f) { return !f.passes; });
  if (findings.size() == 1) return fmt::format("{}: {}", findings[0].group, found(r, findings[0]));
  if (failing == 0) return fmt::format("all {} requirements hold", findings.size());
  return fmt::format("{} of {} requirements do not hold", failing, findings.size());
}

// The receivers of a chart, those with the least margin first.
std::vector<std::size_t> worstFirst(const Finding& f) {
  std::vector<std::size_t> order(f.receivers.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return f.receivers[i].margin; });
  if (order.size() > kMostBars) order.resize(kMostBars);
  return order;
}

report::DayBar barOf(const VerdictReport& r, const ReceiverResult& result, bool tellsDate) {
  report::DayBar bar;
  bar.name = positionText(r, placeOf(r, result), ", ");
  if (tellsDate) bar.name += ", " + sun::dateText(result.date);
  bar.figure = duration(result.value);
  bar.passes = result.passes;
  bar.parts = partsOf(r, result.date, result.spans);
  return bar;
}

// From the first to the last whole hour of what counts and what is shown.
report::DayPart axisOf(const report::DayChart& chart) {
  report::DayPart axis{24.0, 0.0};
  const auto widen = [&](const report::DayPart& part) {
    axis = {std::min(axis.from, std::floor(part.from)), std::max(axis.to, std::ceil(part.to))};
  };
  std::ranges::for_each(chart.counts, widen);
  for (const auto& bar : chart.bars) std::ranges::for_each(bar.parts, widen);
  return axis.from < axis.to ? axis : report::DayPart{6.0, 18.0};
}

Result<report::DayChart> chartOf(const VerdictReport& r, const Finding& f) {
  report::DayChart chart;
  const ReceiverResult& deciding = f.receivers[*f.deciding];
  const Measure& m = measureOf(r, f, deciding);
  const auto order = worstFirst(f);
  const bool oneDay = std::ranges::all_of(order, [&](std::size_t i) { return f.receivers[i].date == deciding.date; });
  chart.title = fmt::format("{}: {}", f.group, requirementOf(r, f).name);
  chart.shown = countsSun(m) ? "sun" : "shadow";
  chart.note =
      fmt::format("Bars are {} on {}, by the clock {}; what does not count is shaded.",
                  countsSun(m)                              ? "sun"
                  : m.statistic == rules::Statistic::shadow ? "shadow"
                                                            : "new shadow",
                  oneDay ? sun::dateText(deciding.date) : "the day that decides for each", r.request.zone.name);
  if (order.size() < f.receivers.size())
    chart.note += fmt::format(" The {} of {} receivers with the least to spare.", order.size(), f.receivers.size());
  const auto counting = rules::countingOn(r.verdict.rule, m, deciding.date, r.request);
  if (oneDay) chart.counts = partsOf(r, deciding.date, counting);
  for (const std::size_t i : order) chart.bars.push_back(barOf(r, f.receivers[i], !oneDay));
  chart.axis = axisOf(chart);
  if (!oneDay) chart.counts = {chart.axis};
  return chart;
}

report::PageTable newsTable(const VerdictReport& r, const DayNews& day) {
  report::PageTable table;
  table.title = fmt::format("New shadow on {}", sun::dateText(day.date));
  table.note =
      fmt::format("By the clock {}. Shadow that the baseline does not have, and whose it is.", r.request.zone.name);
  table.columns = {"where", "building", "enters", "leaves", "most", "in all"};
  for (const rules::AreaNews& area : day.news.areas) {
    const bool point = area.size == 0.0 && r.targets.step == 0.0;
    const auto all = point ? duration(area.areaHours) : fmt::format("{:.2f} m2 h", area.areaHours);
    if (area.visits.empty()) table.rows.push_back({area.area, "none", "", "", "", all});
    for (const rules::Visit& visit : area.visits)
      table.rows.push_back(
          {area.area, visit.building, clockOf(r, visit.span.from), clockOf(r, visit.span.to),
           visit.most > 0.0 ? fmt::format("{:.1f} m2 at {}", visit.most, clockOf(r, visit.mostAt)) : "", all});
  }
  return table;
}

void addOtherwise(report::StudyPage& page, const VerdictReport& r) {
  const rules::Verdict& v = r.verdict;
  page.whyOtherwise = v.nearThreshold ? "A margin is small, so conventions can decide. One is turned at a time."
                                      : "One is turned at a time.";
  for (const rules::SwitchOutcome& s : v.switches)
    page.otherwise.push_back(
        {s.name, s.taken, s.instead,
         v.findings.front().newShare || std::isinf(s.margin) ? std::string() : duration(s.margin, true), s.passes});
}

std::vector<std::pair<std::string, std::string>> sourcesOf(const rules::Rule& rule) {
  std::vector<std::pair<std::string, std::string>> list{{"source", rule.source}};
  for (const auto& line : rule.checked) list.emplace_back("checked against", line);
  for (const auto& line : rule.uncertain) list.emplace_back("uncertain", line);
  for (const auto& line : rule.notes) list.emplace_back("note", line);
  return list;
}

}  // namespace

Result<report::StudyPage> verdictPage(const VerdictReport& r, const scene::Scene& scene) {
  const rules::Verdict& v = r.verdict;
  report::StudyPage page;
  page.title = v.rule.title;
  page.subtitle =
      fmt::format("{} ({})", shortName(std::filesystem::path(scene.source).filename().string()), v.rule.where);
  page.passes = v.passes;
  page.verdict = verdictSentence(r);
  page.warnings = v.warnings;
  page.facts = {{"rule", v.rule.name},
                {"place", study::placeText(r.request.place)},
                {"receivers", r.targets.described},
                {"clock", r.request.zone.name}};
  for (const Finding& f : v.findings) page.criteria.push_back(criterion(r, f));
  addOtherwise(page, r);
  for (const Finding& f : v.findings) {
    if (!f.deciding || f.newShare) continue;
    auto chart = chartOf(r, f);
    if (!chart) return tl::unexpected(chart.error());
    page.charts.push_back(std::move(*chart));
  }
  for (const DayNews& day : r.news) page.tables.push_back(newsTable(r, day));
  page.sources = sourcesOf(v.rule);
  page.ledger = v.ledger;
  return page;
}

}  // namespace umbrage::cli

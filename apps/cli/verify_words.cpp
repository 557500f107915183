#include "verify_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace umbrage::cli {

std::string clockOf(const VerdictReport& r, sun::Instant instant) {
  const auto time = sun::clockAt(r.request.zone, r.request.place, instant).clock.time;
  const auto seconds = std::chrono::round<std::chrono::seconds>(time).count();
  return fmt::format("{:02}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

std::string spansText(const VerdictReport& r, const std::vector<study::TimeSpan>& spans) {
  std::string text;
  for (const study::TimeSpan& span : spans)
    text += fmt::format("{}{}-{}", text.empty() ? "" : ";", clockOf(r, span.from), clockOf(r, span.to));
  return text;
}

std::string duration(double hours, bool sign) {
  const auto seconds = std::llround(std::abs(hours) * 3600.0);
  return fmt::format("{}{}:{:02}:{:02}",
                     hours < 0 ? "-"
                     : sign    ? "+"
                               : "",
                     seconds / 3600, seconds / 60 % 60, seconds % 60);
}

const char* quantity(const rules::Measure& m) {
  switch (m.statistic) {
    case rules::Statistic::sun: return "of sun";
    case rules::Statistic::longestSun: return "of sun without break";
    case rules::Statistic::shadow: return "of shadow";
    case rules::Statistic::newShadow: return "of new shadow";
  }
  return "";
}
const char* comparison(const rules::Measure& m) {
  switch (m.comparison) {
    case rules::Comparison::atLeast: return "at least";
    case rules::Comparison::moreThan: return "more than";
    case rules::Comparison::atMost: return "at most";
    case rules::Comparison::lessThan: return "less than";
  }
  return "";
}
std::string positionText(const VerdictReport& r, const Vec3& position, std::string_view separator) {
  constexpr double kPlacesOfMetres = 3.0;
  const double places = std::ceil(kPlacesOfMetres + std::log10(r.metresPerUnit) - 1e-9);
  const int digits = int(std::clamp(places, 0.0, 12.0));
  std::string text;
  for (const double value : {position.x, position.y, position.z}) {
    std::string number = fmt::format("{:.{}f}", value, digits);
    if (digits > 0) number.erase(number.find_last_not_of('0') + 1);
    if (number.back() == '.') number.pop_back();
    if (number == "-0") number = "0";
    if (!text.empty()) text += separator;
    text += number;
  }
  return text;
}

std::string sunOfDays(const VerdictReport& r, const rules::Measure& m) {
  constexpr auto kYear = std::chrono::days(365);
  const auto dates = rules::datesOf(m, r.request);
  if (dates.size() == 1) return "the sun of " + sun::dateText(dates.front());
  const auto length = std::chrono::sys_days(dates.back()) - std::chrono::sys_days(dates.front()) + std::chrono::days(1);
  if (m.days.kind == rules::Days::Kind::range && length >= kYear) return "the year's sun";
  return fmt::format("the sun of {} days", dates.size());
}

std::string newShadowText(const VerdictReport& r, double hours) {
  return r.targets.step > 0.0 ? fmt::format("{:.1f} m2 h", hours) : duration(hours) + " in all";
}

const rules::Requirement& requirementOf(const VerdictReport& r, const rules::Finding& f) {
  return r.verdict.rule.requirements[f.requirement];
}
const rules::Measure& decidingMeasure(const rules::Verdict& verdict) {
  const rules::Deciding deciding = rules::decidingOf(verdict);
  return verdict.rule.requirements[verdict.findings[deciding.finding].requirement].anyOf[deciding.measure];
}
std::string percent(double share) {
  constexpr int kMostDigits = 9;
  std::string text;
  for (int digits = 1; digits <= kMostDigits; ++digits) {
    text = fmt::format("{:.{}f}", 100.0 * share, digits);
    const double shown = std::stod(text);
    if ((shown < 100.0 || share >= 1.0) && (shown > 0.0 || share <= 0.0)) break;
  }
  return text + " %";
}
std::string failingLines(const VerdictReport& r, const rules::Finding& f) {
  std::size_t points = 0, failing = 0;
  for (const rules::ReceiverResult& result : f.receivers) {
    if (r.targets.targets[result.target].weight > 0.0) continue;
    ++points, failing += result.passes ? 0 : 1;
  }
  return failing == 0 ? std::string()
                      : fmt::format("{} of {} points on lines, which have no area, fail", failing, points);
}
std::string newShareText(double share) {
  const std::string text = fmt::format("{:.4f}", 100.0 * share);
  return (share > 0.0 && text == "0.0000" ? fmt::format("{:.2g}", 100.0 * share) : text) + " %";
}
std::string outlinesText(const VerdictReport& r, const rules::Finding& f) {
  const rules::NewOutlines& o = *f.outlines;
  return fmt::format(
      "between the cells' middles the exact outlines show new shadow on {} {}, {:.4g} m2 h; most on {}, {:.4g} m2 h "
      "[{}]",
      o.days, o.days == 1 ? "day" : "days", o.areaHours, sun::dateText(o.date), o.areaHoursThen, spansText(r, o.spans));
}
const Vec3& placeOf(const VerdictReport& r, const rules::ReceiverResult& result) {
  return r.targets.targets[result.target].receiver.position;
}

}  // namespace umbrage::cli

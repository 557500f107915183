#include "umbrage/study/hours_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "umbrage/study/ledger.hpp"

namespace umbrage::study {
namespace {

using std::chrono::milliseconds;
using std::chrono::sys_days;

double hoursOf(milliseconds t) { return double(t.count()) / 3.6e6; }

Result<std::vector<TimeSpan>> daysOf(const HoursRequest& r, std::vector<std::string>& warnings) {
  const sys_days first(r.date), last(r.until.value_or(r.date));
  if (last < first) return fail(ErrorCode::usage, "the last day comes before the first");
  if (r.from >= r.to)
    return fail(ErrorCode::usage, fmt::format("the period from {} to {} is empty or runs backwards",
                                              sun::timeText(r.from), sun::timeText(r.to)));
  std::vector<TimeSpan> days;
  for (sys_days day = first; day <= last; day += std::chrono::days(1)) {
    TimeSpan span{};
    for (const auto& [clock, instant] : {std::pair(r.from, &span.from), std::pair(r.to, &span.to)}) {
      const auto moment = sun::instantOf(r.zone, r.place, {day, clock});
      if (!moment) return tl::unexpected(moment.error());
      if (moment->warning) warnings.push_back(*moment->warning);
      *instant = moment->instant;
    }
    if (span.from >= span.to)
      return fail(
          ErrorCode::usage,
          fmt::format("clocks are put back within the period on {}, and nothing is left of it", sun::dateText(day)));
    days.push_back(span);
  }
  return days;
}

// One transparent part: how much it lets through, and when nothing of it is in the way.
struct Pane {
  double transmittance;
  ExactHours hours;
};

Result<std::vector<Pane>> panesOf(const scene::Scene& scene, const sun::Place& place) {
  constexpr std::size_t kMostPanes = 256;
  std::vector<Pane> panes;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const scene::Instance& instance = scene.instances[i];
    if (!instance.casts) continue;
    const mesh::Mesh& m = *scene.meshes[instance.mesh];
    double opacity = 1.0;
    for (std::size_t t = 0; t < m.triangles.size(); ++t)
      opacity = std::min(opacity, scene.materials[m.materials.empty() ? 0 : m.materials[t]].opacity);
    if (opacity >= 1.0) continue;
    scene::Scene alone = scene;
    alone.instances = {instance};
    ExactHoursOptions options;
    auto hours = ExactHours::build(alone, place, options);
    if (!hours) return tl::unexpected(hours.error());
    panes.push_back({1.0 - opacity, std::move(*hours)});
    if (panes.size() > kMostPanes)
      return fail(ErrorCode::usage,
                  fmt::format("more than {} parts are transparent; take them as opaque or ignore them", kMostPanes),
                  scene.source);
  }
  return panes;
}

bool within(std::span<const TimeSpan> spans, sun::Instant t) {
  return std::any_of(spans.begin(), spans.end(), [&](const TimeSpan& s) { return s.from <= t && t < s.to; });
}

// What the panes in the way let through at a moment.
double shareAt(sun::Instant t, const std::vector<Pane>& panes, const std::vector<SunHours>& open,
               std::size_t receiver) {
  double share = 1.0;
  for (std::size_t p = 0; p < panes.size(); ++p)
    if (!within(open[p].lit(receiver), t)) share *= panes[p].transmittance;
  return share;
}

// Lit time, each moment weighted by what the panes in the way let through.
double weightedHours(std::span<const TimeSpan> lit, const std::vector<Pane>& panes, const std::vector<SunHours>& open,
                     std::size_t receiver) {
  std::vector<sun::Instant> cuts;
  for (const TimeSpan& s : lit) cuts.push_back(s.from), cuts.push_back(s.to);
  for (const SunHours& o : open)
    for (const TimeSpan& s : o.lit(receiver)) cuts.push_back(s.from), cuts.push_back(s.to);
  std::sort(cuts.begin(), cuts.end());
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
    if (cuts[i] < cuts[i + 1] && within(lit, cuts[i]))
      sum += shareAt(cuts[i], panes, open, receiver) * hoursOf(cuts[i + 1] - cuts[i]);
  return sum;
}

// What samples in the middles of steps say of exact stretches.
double sampledHours(std::span<const TimeSpan> lit, const std::vector<Pane>& panes, const std::vector<SunHours>& open,
                    std::size_t receiver, const TimeSpan& day, milliseconds step) {
  double count = 0.0;
  std::size_t k = 0;
  for (sun::Instant t = day.from + step / 2; t < day.to; t += step) {
    while (k < lit.size() && lit[k].to <= t) ++k;
    if (k < lit.size() && lit[k].from <= t) count += shareAt(t, panes, open, receiver);
  }
  return hoursOf(step) * count;
}

std::string clockText(const HoursRequest& r, const std::vector<TimeSpan>& days) {
  const auto offset = [&](sun::Instant t) { return sun::offsetText(sun::clockAt(r.zone, r.place, t)); };
  std::vector<std::string> all;  // in the order of the days, each once: a year begins and ends in winter
  for (const TimeSpan& day : days)
    for (const sun::Instant t : {day.from, day.to - milliseconds(1)})
      if (const std::string text = offset(t); std::find(all.begin(), all.end(), text) == all.end()) all.push_back(text);
  return fmt::format("{}", fmt::join(all, ", then "));
}

std::vector<LedgerLine> ledgerOf(const scene::Scene& scene, const HoursTable& t) {
  const HoursRequest& r = t.request;
  const std::string dates =
      sun::dateText(r.date) + (r.until ? fmt::format(" to {}, {} days", sun::dateText(*r.until), t.days.size()) : "");
  const char* transparent[] = {"taken as opaque", "ignored", "weighted by what they let through, each part once"};
  return {{"Place", placeText(r.place)},
          {"Date", dates},
          clockLine(r.zone, clockText(r, t.days)),
          {"Period",
           fmt::format("{} to {}; the sun is up for {:.3f} h", sun::timeText(r.from), sun::timeText(r.to), t.upHours)},
          sunLine(r.model, "declination moving (ERFA), horizon at 0 degrees"),
          northLine(scene),
          unitLine(scene),
          {"Receivers", t.set.described},
          castersLine(r.casters),
          {"Opacity", fmt::format("surfaces that are not opaque: {}", transparent[static_cast<int>(r.transparent)])},
          {"Time", r.sampled ? fmt::format("the exact hours, sampled every {:g} min in the middles of steps",
                                           double(r.sampled->count()) / 60e3)
                             : std::string("exact: solved for the moments at which edges uncover and cover the sun")},
          inputLine(scene),
          versionLine(r.sampled ? "sampled sun hours" : "exact sun hours", r.zone)};
}

}  // namespace

Result<HoursTable> sunHours(const scene::Scene& scene, ReceiverSet receivers, const HoursRequest& request,
                            const ProgressSink& progress) {
  HoursTable out;
  out.set = std::move(receivers);
  out.request = request;
  auto days = daysOf(request, out.warnings);
  if (!days) return tl::unexpected(days.error());
  out.days = std::move(*days);
  ExactHoursOptions options;
  if (request.transparent != Transparent::opaque) options.leastOpacity = 1.0;
  const auto exact = ExactHours::build(scene, request.place, options);
  if (!exact) return tl::unexpected(exact.error());
  std::vector<Pane> panes;
  if (request.transparent == Transparent::weighted) {
    auto found = panesOf(scene, request.place);
    if (!found) return tl::unexpected(found.error());
    panes = std::move(*found);
  }
  const std::size_t count = out.set.receivers.size();
  out.hours.assign(count, 0.0), out.longest.assign(count, 0.0);
  if (request.least) out.runs.assign(count, 0), out.runHours.assign(count, 0.0);
  if (out.days.size() > 1) out.months.assign(count, {});
  const bool keep = count * out.days.size() <= kMostKept;
  const double passes = double(out.days.size()) * double(1 + panes.size());
  double done = 0.0;
  const ProgressSink part = [&](double fraction, std::string_view what) {
    return reportProgress(progress, (done + fraction) / passes, what);
  };
  for (std::size_t d = 0; d < out.days.size(); ++d) {
    const SunCourse course = SunCourse::make(request.place, out.days[d], request.model);
    out.upHours += hoursOf(course.upTime());
    auto lit = exact->at(out.set.receivers, course, part);
    if (!lit) return tl::unexpected(lit.error());
    done += 1.0;
    std::vector<SunHours> open;
    for (const Pane& pane : panes) {
      auto through = pane.hours.at(out.set.receivers, course, part);
      if (!through) return tl::unexpected(through.error());
      open.push_back(std::move(*through));
      done += 1.0;
    }
    const auto date = std::chrono::year_month_day(sys_days(request.date) + std::chrono::days(d));
    for (std::size_t i = 0; i < count; ++i) {
      const double hours = request.sampled ? sampledHours(lit->lit(i), panes, open, i, out.days[d], *request.sampled)
                           : panes.empty() ? hoursOf(lit->total(i))
                                           : weightedHours(lit->lit(i), panes, open, i);
      out.hours[i] += hours;
      out.longest[i] = std::max(out.longest[i], hoursOf(lit->longest(i)));
      if (request.least) {
        const auto runs = lit->runs(i, *request.least);
        out.runs[i] += runs.count, out.runHours[i] += hoursOf(runs.total);
      }
      if (!out.months.empty()) out.months[i][unsigned(date.month()) - 1] += static_cast<float>(hours);
    }
    if (keep) out.lit.push_back(std::move(*lit));
  }
  if (out.upHours == 0.0) out.warnings.push_back("the sun is below the horizon all the time, so all hours are 0");
  const bool wholeDay = request.from == milliseconds(0) && request.to >= std::chrono::hours(24);
  if (out.days.size() == 1 && wholeDay && out.upHours >= hoursOf(out.days[0].length()) - 1e-6)
    out.warnings.push_back("the sun is up all the time");
  out.ledger = ledgerOf(scene, out);
  return out;
}

std::string stretchesText(const HoursTable& table, std::size_t receiver) {
  const HoursRequest& r = table.request;
  std::string text;
  for (std::size_t d = 0; d < table.lit.size(); ++d) {
    const auto date = std::chrono::year_month_day(sys_days(r.date) + std::chrono::days(d));
    for (const TimeSpan& span : table.lit[d].lit(receiver)) {
      const auto clock = [&](sun::Instant t) {
        const auto reading = sun::clockAt(r.zone, r.place, t);
        auto seconds = std::chrono::round<std::chrono::seconds>(reading.clock.time).count();
        seconds += 86400 * (sys_days(reading.clock.date) - sys_days(date)).count();
        seconds =
            std::clamp<long long>(seconds, 0, 86400);  // the end of the day is 24:00:00, and rounding stays within it
        return fmt::format("{:02}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
      };
      text += fmt::format("{}{}{}-{}", text.empty() ? "" : ";", table.days.size() > 1 ? sun::dateText(date) + " " : "",
                          clock(span.from), clock(span.to));
    }
  }
  return text;
}

}  // namespace umbrage::study

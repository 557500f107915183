#include "umbrage/rules/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "umbrage/base/check.hpp"
#include "umbrage/rules/detail/judge.hpp"
#include "umbrage/rules/detail/outlines.hpp"
#include "umbrage/study/georeference.hpp"
#include "umbrage/study/ledger.hpp"

namespace umbrage::rules {
namespace {

using detail::Conventions;
using study::LedgerLine;

constexpr double kNearShare = 0.1;  // of a limit on new shadow

std::string clockName(Clock clock, const detail::Calendar& calendar, bool switched) {
  const sun::Zone zone = detail::zoneOf(clock, calendar, switched);
  if (zone.kind == sun::Zone::Kind::solar) return "true solar time";
  if (zone.kind == sun::Zone::Kind::named) return zone.name;
  return "UTC" + zone.name;
}

bool readsClock(const Rule& rule) {
  for (const Requirement& r : rule.requirements)
    for (const Measure& m : r.anyOf)
      if (m.window.from || m.window.to) return true;
  return false;
}

bool readsLegalClock(const Rule& rule) {
  for (const Requirement& r : rule.requirements)
    for (const Measure& m : r.anyOf)
      if ((m.window.from || m.window.to) && m.window.clock != Clock::solar) return true;
  return false;
}

// The clocks of all measures that read one, each once.
std::string clockNames(const Rule& rule, const Conventions& c) {
  std::vector<std::string> names;
  for (const Requirement& r : rule.requirements)
    for (const Measure& m : r.anyOf)
      if (const std::string name = clockName(m.window.clock, c.calendar, c.clockSwitched);
          (m.window.from || m.window.to) && std::find(names.begin(), names.end(), name) == names.end())
        names.push_back(name);
  return names.empty() ? "none: all of the day, or from sunrise to sunset" : fmt::format("{}", fmt::join(names, ", "));
}

std::string refractionName(const Conventions& c) {
  return c.sun.refraction == sun::Refraction::none ? "geometric" : "with refraction";
}
std::string limbName(const Conventions& c) { return c.sun.point == study::SunPoint::centre ? "centre" : "upper limb"; }
std::string declinationName(const Conventions& c) { return c.fixedDeclination ? "fixed at noon's" : "moving"; }

struct Switch {
  const char* name;
  std::string (*text)(const Rule&, const Conventions&);
  void (*turn)(Conventions&);
};
const Switch kSwitches[] = {
    {"clock", clockNames, [](Conventions& c) { c.clockSwitched = true; }},
    {"refraction", [](const Rule&, const Conventions& c) { return refractionName(c); },
     [](Conventions& c) {
       c.sun.refraction = c.sun.refraction == sun::Refraction::none ? sun::Refraction::standard : sun::Refraction::none;
     }},
    {"limb", [](const Rule&, const Conventions& c) { return limbName(c); },
     [](Conventions& c) {
       c.sun.point = c.sun.point == study::SunPoint::centre ? study::SunPoint::upperLimb : study::SunPoint::centre;
     }},
    {"declination", [](const Rule&, const Conventions& c) { return declinationName(c); },
     [](Conventions& c) { c.fixedDeclination = !c.fixedDeclination; }},
};

double leastMargin(const std::vector<Finding>& findings) {
  double least = findings.front().margin;
  for (const Finding& f : findings) least = std::min(least, f.margin);
  return least;
}

bool isNear(const Rule& rule, const Finding& finding, const VerifyRequest& request) {
  const auto& limit = rule.requirements[finding.requirement].mostNew;
  if (limit) return *limit > 0.0 && std::abs(finding.margin) <= kNearShare * *limit;
  if (finding.outlines) return false;
  // No new shadow at all is what most receivers have, and nothing near it.
  const ReceiverResult& r = finding.receivers[*finding.deciding];
  const bool none = r.threshold == 0.0 && r.value == 0.0;
  return !none && std::abs(finding.margin) <= detail::hoursOf(request.near);
}

/// What is held against a rule, by any conventions.
struct Subject {
  const scene::Scene& scene;
  const scene::Scene* baseline;
  const Rule& rule;
  const TargetSet& targets;
  const detail::Lights& lights;
};

Result<std::vector<Finding>> findingsOf(const Subject& s, const Conventions& conventions,
                                        const ProgressSink& progress) {
  auto findings = detail::judge(s.rule, s.lights, s.targets, conventions, progress);
  if (!findings || s.baseline == nullptr) return findings;
  if (const auto held = detail::holdOutlines(s.scene, *s.baseline, s.rule, s.targets, conventions, progress, *findings);
      !held)
    return tl::unexpected(held.error());
  return findings;
}

Result<std::vector<SwitchOutcome>> outcomes(const Subject& subject, const VerifyRequest& request,
                                            const Conventions& taken, const ProgressSink& progress) {
  const Rule& rule = subject.rule;
  std::vector<SwitchOutcome> all;
  for (const Switch& one : kSwitches) {
    if (one.turn == kSwitches[0].turn && !readsClock(rule)) continue;
    Conventions turned = detail::conventionsOf(rule, request);
    one.turn(turned);
    const auto findings = findingsOf(subject, turned, progress);
    if (!findings) return tl::unexpected(findings.error());
    all.push_back(
        {one.name, one.text(rule, taken), one.text(rule, turned), detail::allPass(*findings), leastMargin(*findings)});
  }
  return all;
}

// "2026-03-21" or "2026-02-01 to 2026-03-21, 49 days".
std::string datesText(const Rule& rule, const Conventions& c) {
  std::vector<std::string> texts;
  for (const Requirement& r : rule.requirements)
    for (const Measure& m : r.anyOf) {
      const auto dates = detail::datesOf(m.days, c.calendar);
      std::string text;
      if (m.days.kind == Days::Kind::range)
        text = fmt::format("{} to {}, {} days{}", sun::dateText(dates.front()), sun::dateText(dates.back()),
                           dates.size(), m.days.best ? ", the best of them" : "");
      else
        for (const auto& date : dates) text += (text.empty() ? "" : ", ") + sun::dateText(date);
      if (std::find(texts.begin(), texts.end(), text) == texts.end()) texts.push_back(text);
    }
  return fmt::format("{}", fmt::join(texts, "; "));
}

std::string altitudeText(const Rule& rule) {
  for (const Requirement& r : rule.requirements)
    for (const Measure& m : r.anyOf)
      if (m.leastAltitude) return fmt::format(", counting from {:g} degrees up", m.leastAltitude->degrees());
  return ", horizon at 0 degrees";
}

std::vector<LedgerLine> ledgerOf(const scene::Scene& scene, const scene::Scene* baseline, const Rule& rule,
                                 const TargetSet& targets, const VerifyRequest& request, const Conventions& c) {
  std::vector<LedgerLine> ledger = {
      {"Rule", fmt::format("{}: {}", rule.name, rule.title)},
      {"Source", rule.source},
      {"Place", study::placeText(request.place)},
      {"Date", datesText(rule, c)},
      {"Clock", clockNames(rule, c)},
      study::sunLine(rule.sun, std::string("declination ") + (c.fixedDeclination ? "of noon" : "moving (ERFA)") +
                                   altitudeText(rule)),
      study::northLine(scene),
      study::unitLine(scene),
      {"Receivers", targets.described},
      rule.casters == CastersOf::site ? LedgerLine{"Casters", "only what stands on the site"}
                                      : study::castersLine(request.casters),
      {"Time", "exact: solved for the moments at which edges uncover and cover the sun"},
      study::inputLine(scene)};
  if (baseline != nullptr) ledger.push_back({"Baseline", study::inputLine(*baseline).text});
  ledger.push_back(study::versionLine("verdict of exact sun hours", request.zone));
  return ledger;
}

/// Where the sun counts at no time, every figure is 0 and a limit on shadow would hold of itself.
Result<void> checkCounts(const Rule& rule, const Conventions& conventions) {
  for (const Requirement& r : rule.requirements)
    for (const Measure& m : r.anyOf) {
      if (m.statistic == Statistic::sun || m.statistic == Statistic::longestSun) continue;
      bool counts = false;
      for (const auto& date : detail::datesOf(m.days, conventions.calendar)) {
        const auto day = detail::dayOf(m, date, conventions);
        if ((counts = day && !day->counting.empty())) break;
      }
      if (!counts)
        return fail(
            ErrorCode::usage,
            fmt::format("the sun counts at no time of what '{}' looks at: is --tz the clock of this place?", r.name));
    }
  return {};
}

/// What the calendar does to the days of a rule, and clocks that are put forward or back to its windows, each once.
std::vector<std::string> calendarNotes(const Rule& rule, const Conventions& conventions) {
  std::vector<std::string> notes;
  const auto add = [&](std::vector<std::string> more) {
    for (std::string& note : more)
      if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(std::move(note));
  };
  for (const Requirement& r : rule.requirements)
    for (const Measure& m : r.anyOf) {
      add(detail::dateNotes(m.days, conventions.calendar));
      for (const auto& date : detail::datesOf(m.days, conventions.calendar))
        add(detail::windowNotes(m.window, date, conventions.calendar));
    }
  return notes;
}

std::vector<study::TimeSpan> countingTimes(const Measure& m, std::chrono::year_month_day date, const Conventions& c) {
  const auto day = detail::dayOf(m, date, c);
  return day ? day->counting : std::vector<study::TimeSpan>();
}

/// A day on which a measure fails under open sky, too, and with it the measure. Of a best day all must: the one with the longest sun.
std::optional<std::chrono::year_month_day> hopelessDay(const Measure& m, const Conventions& conventions) {
  const auto dates = detail::datesOf(m.days, conventions.calendar);
  const auto hopeless = [&](std::chrono::year_month_day date) {
    const auto counting = countingTimes(m, date, conventions);
    return !detail::holds(m, counting, counting, {});
  };
  if (!m.days.best) {
    const auto found = std::find_if(dates.begin(), dates.end(), hopeless);
    return found == dates.end() ? std::nullopt : std::optional(*found);
  }
  if (!std::all_of(dates.begin(), dates.end(), hopeless)) return std::nullopt;
  return *std::ranges::max_element(
      dates, {}, [&](std::chrono::year_month_day date) { return detail::total(countingTimes(m, date, conventions)); });
}

/// A requirement that the sun itself does not meet, by any of its measures, says nothing of the scene.
std::vector<std::string> hopelessNotes(const Rule& rule, const Conventions& conventions) {
  std::vector<std::string> notes;
  for (const Requirement& r : rule.requirements) {
    const auto possible = [&](const Measure& m) { return !hopelessDay(m, conventions); };
    if (std::any_of(r.anyOf.begin(), r.anyOf.end(), possible)) continue;
    const Measure& first = r.anyOf.front();
    const auto date = *hopelessDay(first, conventions);
    const auto seconds =
        std::chrono::round<std::chrono::seconds>(detail::total(countingTimes(first, date, conventions))).count();
    notes.push_back(
        fmt::format("no receiver can have what '{}' asks for: on {} the sun counts for {}:{:02}:{:02} by the clock",
                    r.name, sun::dateText(date), seconds / 3600, seconds / 60 % 60, seconds % 60));
  }
  return notes;
}

/// A clock that is hours off the sun's is mostly another place's.
constexpr double kOddClockHours = 4.0;
std::optional<std::string> oddClock(const VerifyRequest& request) {
  if (request.zone.kind == sun::Zone::Kind::solar) return std::nullopt;
  const auto noon = sun::instantOf(request.zone, request.place, {request.date, std::chrono::hours(12)});
  if (!noon) return std::nullopt;
  const double clock =
      std::chrono::duration<double, std::ratio<3600>>(sun::clockAt(request.zone, request.place, noon->instant).offset)
          .count();
  const double off = std::remainder(clock - request.place.longitude.degrees() / 15.0, 24.0);
  if (std::abs(off) < kOddClockHours) return std::nullopt;
  return fmt::format("the clock {} is {:.1f} h away from the sun's at this longitude: is it the clock of this place?",
                     request.zone.name, std::abs(off));
}

std::vector<std::string> warningsOf(const Rule& rule, bool hasBaseline, const VerifyRequest& request,
                                    const Conventions& conventions) {
  std::vector<std::string> warnings;
  if (auto odd = oddClock(request)) warnings.push_back(std::move(*odd));
  for (const Requirement& r : rule.requirements)
    if (r.former && !hasBaseline)
      warnings.push_back(
          fmt::format("without --baseline nobody knows what was there before: '{}' is held without its {:g} times",
                      r.name, *r.former));
  if (request.zone.kind == sun::Zone::Kind::solar && readsLegalClock(rule))
    warnings.emplace_back("the rule reads the legal clock, which --tz solar does not tell: mean solar time is taken");
  for (std::string& note : calendarNotes(rule, conventions)) warnings.push_back(std::move(note));
  for (std::string& note : hopelessNotes(rule, conventions)) warnings.push_back(std::move(note));
  return warnings;
}

}  // namespace

Result<void> detail::checkRequest(const Rule& rule, bool hasBaseline, const TargetSet& targets,
                                  const VerifyRequest& r) {
  const double latitude = r.place.latitude.degrees();
  const bool north = rule.hemisphere == Hemisphere::north, south = rule.hemisphere == Hemisphere::south;
  if ((north && latitude <= 0.0) || (south && latitude >= 0.0))
    return fail(ErrorCode::usage,
                fmt::format("{} is a rule of the {} hemisphere ({}), and the place lies at {}", rule.name,
                            north ? "northern" : "southern", rule.where, study::placeText(r.place)));
  if (needsBaseline(rule) && !hasBaseline)
    return fail(
        ErrorCode::usage,
        fmt::format("{} asks what is new in shadow, so it wants what stands now: --baseline SCENE2", rule.name));
  if (!rule.altitudeByCountry.empty()) {
    std::string known;
    for (const auto& [country, altitude] : rule.altitudeByCountry) known += (known.empty() ? "" : ", ") + country;
    return fail(ErrorCode::usage,
                fmt::format("{} has a least altitude of the sun for each country: --country CODE ({}), or "
                            "--min-altitude DEG",
                            rule.name, known));
  }
  if (targets.targets.empty())
    return fail(ErrorCode::usage, fmt::format("there are no receivers to hold {} against", rule.name));
  return {};
}

Result<Verdict> verify(const scene::Scene& scene, const scene::Scene* baseline, const Rule& rule,
                       const TargetSet& targets, const VerifyRequest& request, const ProgressSink& progress) {
  if (const auto fine = detail::checkRequest(rule, baseline != nullptr, targets, request); !fine)
    return tl::unexpected(fine.error());
  detail::Lights lights;
  for (const auto& [of, light] : {std::pair(&scene, &lights.now), std::pair(baseline, &lights.before)}) {
    if (of == nullptr) continue;
    auto hours = study::ExactHours::build(*of, request.place);
    if (!hours) return tl::unexpected(hours.error());
    *light = detail::sunOf(std::make_shared<const study::ExactHours>(std::move(*hours)));
  }
  const Conventions conventions = detail::conventionsOf(rule, request);
  if (const auto counts = checkCounts(rule, conventions); !counts) return tl::unexpected(counts.error());
  const Subject subject{scene, baseline, rule, targets, lights};
  auto findings = findingsOf(subject, conventions, progress);
  if (!findings) return tl::unexpected(findings.error());
  if (findings->empty()) return fail(ErrorCode::usage, fmt::format("no receiver lies where {} looks", rule.name));
  Verdict verdict;
  verdict.rule = rule;
  verdict.findings = std::move(*findings);
  verdict.passes = detail::allPass(verdict.findings);
  verdict.nearThreshold = std::any_of(verdict.findings.begin(), verdict.findings.end(),
                                      [&](const Finding& f) { return isNear(rule, f, request); });
  if (request.sensitivity == Sensitivity::always ||
      (request.sensitivity == Sensitivity::nearThreshold && verdict.nearThreshold)) {
    auto switches = outcomes(subject, request, conventions, progress);
    if (!switches) return tl::unexpected(switches.error());
    verdict.switches = std::move(*switches);
  }
  verdict.warnings = warningsOf(rule, baseline != nullptr, request, conventions);
  verdict.ledger = ledgerOf(scene, baseline, rule, targets, request, conventions);
  return verdict;
}

Deciding decidingOf(const Verdict& verdict) {
  UMBRAGE_CHECK(!verdict.findings.empty(), "a verdict has findings");
  constexpr double kDayHours = 24.0;
  const auto marginOf = [](const Finding& f) { return f.newShare ? kDayHours * f.margin : f.margin; };
  const auto first = std::min_element(
      verdict.findings.begin(), verdict.findings.end(),
      [&](const Finding& a, const Finding& b) { return a.passes != b.passes ? !a.passes : marginOf(a) < marginOf(b); });
  Deciding deciding{static_cast<std::size_t>(first - verdict.findings.begin()), 0, std::nullopt};
  if (first->outlines) {
    deciding.date = first->outlines->date;
    return deciding;
  }
  if (!first->deciding) return deciding;
  const ReceiverResult& receiver = first->receivers[*first->deciding];
  deciding.measure = receiver.measure, deciding.date = receiver.date;
  return deciding;
}

std::vector<study::TimeSpan> countingOn(const Rule& rule, const Measure& measure, std::chrono::year_month_day date,
                                        const VerifyRequest& request) {
  const auto day = detail::dayOf(measure, date, detail::conventionsOf(rule, request));
  return day ? day->counting : std::vector<study::TimeSpan>();
}

std::vector<std::chrono::year_month_day> datesOf(const Measure& measure, const VerifyRequest& request) {
  return detail::datesOf(measure.days, {request.place, request.zone, request.date});
}

}  // namespace umbrage::rules

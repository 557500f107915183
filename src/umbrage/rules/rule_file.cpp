#include "umbrage/rules/rule_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <umbrage_presets/presets.hpp>

#include "umbrage/base/check.hpp"
#include "umbrage/base/file.hpp"
#include "umbrage/rules/detail/json_reader.hpp"
#include "umbrage/rules/detail/spans.hpp"
#include "umbrage/sun/zone.hpp"

namespace umbrage::rules {
namespace {

using detail::hoursOf;
using detail::JsonReader;
using std::chrono::milliseconds;

constexpr std::size_t kLargestFile = 1 << 20;
constexpr double kDay = 24.0;

milliseconds ofHours(double hours) { return milliseconds(std::llround(hours * 3.6e6)); }
milliseconds ofMinutes(double minutes) { return milliseconds(std::llround(minutes * 6e4)); }

// "12-21". A leap year tells real days from others.
std::optional<std::chrono::month_day> monthDay(const std::string& text) {
  const auto date = sun::parseDate("2024-" + text);
  if (!date) return std::nullopt;
  return date->month() / date->day();
}

// A day named twice is another one misspelt.
template <typename Day>
bool isTwice(const std::vector<Day>& days, const Day& day) {
  return std::find(days.begin(), days.end(), day) != days.end();
}

void readDates(JsonReader& in, Days& days) {
  days.kind = Days::Kind::dates;
  for (const std::string& text : in.texts("dates")) {
    const auto day = monthDay(text);
    if (!day) in.wrong("dates", fmt::format("'{}' is no day; write MM-DD", text));
    if (day && isTwice(days.dates, *day)) in.wrong("dates", fmt::format("'{}' is there twice", text));
    if (day) days.dates.push_back(*day);
  }
  if (days.dates.empty()) in.wrong("dates", "is empty");
}

void readLongitudes(JsonReader& in, Days& days) {
  days.kind = Days::Kind::longitudes;
  for (const double degrees : in.numbers("solar_longitudes", 0.0, 359.999)) {
    if (isTwice(days.longitudes, Angle::degrees(degrees)))
      in.wrong("solar_longitudes", fmt::format("{:g} is there twice", degrees));
    days.longitudes.push_back(Angle::degrees(degrees));
  }
  if (days.longitudes.empty()) in.wrong("solar_longitudes", "is empty");
}

void readRange(JsonReader& in, Days& days) {
  days.kind = Days::Kind::range;
  for (const char* key : {"from", "to"}) {
    const auto day = monthDay(in.text(key));
    if (!day) in.wrong(key, "a day MM-DD is wanted, and from and to belong together");
    days.dates.push_back(day.value_or(std::chrono::January / 1));
  }
}

// Which days they are must be said: the date of a command is none that a rule means by itself.
Days daysOf(JsonReader& in) {
  constexpr const char* kWanted = "dates, solar_longitudes, from with to, or given: true is wanted";
  Days days;
  const bool dates = in.has("dates"), longitudes = in.has("solar_longitudes"), range = in.has("from") || in.has("to"),
             given = in.flag("given");
  const int kinds = int(dates) + int(longitudes) + int(range) + int(given);
  if (kinds == 0) in.wrong("", kWanted);
  if (kinds > 1) in.wrong("", "dates, solar_longitudes, from with to, and given: true exclude each other");
  if (dates) readDates(in, days);
  if (longitudes) readLongitudes(in, days);
  if (range) readRange(in, days);
  const auto every = in.whole("every", 1, 366);
  if (every && !range) in.wrong("every", "belongs to from and to");
  days.every = every.value_or(1);
  days.best = in.word("count", {"each", "best"}) == 1;
  in.finish();
  return days;
}

std::optional<milliseconds> timeOf(JsonReader& in, const char* key) {
  const std::string text = in.text(key);
  if (text.empty()) return std::nullopt;
  const auto time = sun::parseTime(text);
  if (!time) in.wrong(key, time.error().message);
  return time ? std::optional(*time) : std::nullopt;
}

Window windowOf(JsonReader& in) {
  Window window;
  window.from = timeOf(in, "from"), window.to = timeOf(in, "to");
  if ((window.from || window.to) && !in.has("clock")) in.wrong("clock", "is missing: solar, zone or standard");
  constexpr Clock kClocks[] = {Clock::solar, Clock::zone, Clock::standard};
  window.clock = kClocks[in.word("clock", {"solar", "zone", "standard"})];
  if (window.from && window.to && *window.from >= *window.to)
    in.wrong("", "the window is empty: from is not before to");
  if (const auto minutes = in.number("after_sunrise_minutes", -120, 720)) window.afterSunrise = ofMinutes(*minutes);
  if (const auto minutes = in.number("before_sunset_minutes", -120, 720)) window.beforeSunset = ofMinutes(*minutes);
  if (window.afterSunrise && window.beforeSunset &&
      *window.afterSunrise + *window.beforeSunset >= std::chrono::hours(24))
    in.wrong("", "the window is empty: so long after sunrise and before sunset leave nothing of any day");
  in.finish();
  return window;
}

constexpr std::pair<const char*, Comparison> kThresholds[] = {{"at_least_hours", Comparison::atLeast},
                                                              {"more_than_hours", Comparison::moreThan},
                                                              {"at_most_hours", Comparison::atMost},
                                                              {"less_than_hours", Comparison::lessThan}};

void readThreshold(JsonReader& in, Measure& measure) {
  int found = 0;
  for (const auto& [key, comparison] : kThresholds) {
    const auto hours = in.number(key, 0.0, kDay);
    if (!hours) continue;
    measure.threshold = ofHours(*hours), measure.comparison = comparison;
    ++found;
  }
  if (found != 1)
    in.wrong("", "exactly one of at_least_hours, more_than_hours, at_most_hours and less_than_hours is wanted");
}

std::string thresholdKey(Comparison comparison) {
  for (const auto& [key, known] : kThresholds)
    if (known == comparison) return key;
  return {};
}

// What the day and its clock give at most, without the sun's own limits, which depend on the place.
void checkAgainstWindow(JsonReader& in, const Measure& m, bool wantsMore) {
  const milliseconds window = m.window.to.value_or(std::chrono::hours(24)) - m.window.from.value_or(milliseconds(0));
  const bool orEqual = m.comparison == Comparison::moreThan || m.comparison == Comparison::atMost;
  const std::string key = thresholdKey(m.comparison);
  if (orEqual ? m.threshold >= window : m.threshold > window)
    in.wrong(key, wantsMore ? fmt::format("{}{:g} h are wanted of a window of {:g} h", orEqual ? "more than " : "",
                                          hoursOf(m.threshold), hoursOf(window))
                            : fmt::format("always holds: the window has {:g} h", hoursOf(window)));
  if (m.leastRun > window)
    in.wrong("least_run_minutes", fmt::format("never holds: the window has {:g} h", hoursOf(window)));
}

// What can never hold, or always does, is a slip.
void checkSense(JsonReader& in, const Measure& m) {
  const bool sunny = m.statistic == Statistic::sun || m.statistic == Statistic::longestSun;
  const bool wantsMore = m.comparison == Comparison::atLeast || m.comparison == Comparison::moreThan;
  if (sunny != wantsMore)
    in.wrong("",
             sunny ? "sun wants at_least_hours or more_than_hours" : "shadow wants at_most_hours or less_than_hours");
  if (m.comparison == Comparison::lessThan && m.threshold == milliseconds(0))
    in.wrong("less_than_hours", "nothing is less than 0 hours");
  if (m.comparison == Comparison::atLeast && m.threshold == milliseconds(0))
    in.wrong("at_least_hours", "0 hours are always there");
  checkAgainstWindow(in, m, wantsMore);
}

Measure measureOf(JsonReader& in, const Measure& common, bool hasThreshold) {
  Measure measure = common;
  if (const std::string name = in.text("name"); !name.empty()) measure.name = name;
  if (auto days = in.object("days")) measure.days = daysOf(*days);
  if (auto window = in.object("window")) measure.window = windowOf(*window);
  if (const auto altitude = in.number("least_sun_altitude", 0.0, 89.0))
    measure.leastAltitude = Angle::degrees(*altitude);
  constexpr Statistic kStatistics[] = {Statistic::sun, Statistic::longestSun, Statistic::shadow, Statistic::newShadow};
  const bool named = in.has("statistic");
  const Statistic statistic = kStatistics[in.word("statistic", {"sun", "longest_sun", "shadow", "new_shadow"})];
  if (named) measure.statistic = statistic;
  if (const auto minutes = in.number("least_run_minutes", 0.0, 720.0)) measure.leastRun = ofMinutes(*minutes);
  if (measure.leastRun > milliseconds(0) && measure.statistic != Statistic::sun)
    in.wrong("least_run_minutes", "belongs to the statistic sun");
  if (hasThreshold) {
    readThreshold(in, measure);
    checkSense(in, measure);
  }
  return measure;
}

// A total over all days and receivers has no measure of its own: what stands beside it and would be passed over is a slip.
void readNewShare(JsonReader& in, Requirement& r) {
  r.mostNew = in.number("at_most_new_share", 0.0, 1.0);
  if (r.mostNew == 1.0) in.wrong("at_most_new_share", "always holds: a share below 1 is wanted");
  const auto alone = [&](const char* other) {
    if (in.has(other)) in.wrong(other, "at_most_new_share stands alone, without it");
  };
  for (const char* other : {"any", "share", "or_former_times", "least_run_minutes"}) alone(other);
  for (const auto& [key, comparison] : kThresholds) alone(key);
  Measure& m = r.anyOf.front();
  if (in.has("statistic") && m.statistic != Statistic::newShadow)
    in.wrong("statistic", "at_most_new_share is of new_shadow; leave the statistic out");
  if (m.days.best) in.wrong("days.count", "at_most_new_share adds up all days, and no best one");
  m.statistic = Statistic::newShadow;
  m.comparison = Comparison::atMost;
}

void checkDays(JsonReader& in, JsonReader& common) {
  if (!in.has("days") && !common.has("days"))
    in.wrong("days", "is missing: dates, solar_longitudes, from with to, or given: true");
}

void readAlternatives(JsonReader& in, const Measure& common, Requirement& r) {
  for (JsonReader& one : in.objects("any")) {
    r.anyOf.push_back(measureOf(one, common, true));
    checkDays(one, in);
    one.finish();
  }
  if (r.anyOf.empty()) in.wrong("any", "is empty");
  for (const auto& [key, comparison] : kThresholds)
    if (in.has(key)) in.wrong(key, "each of any has a threshold of its own; write it there");
  for (const Measure& m : r.anyOf)
    if (m.days.best && r.anyOf.size() > 1) in.wrong("any", "one best day cannot be that of several measures");
}

Band bandOf(JsonReader& in) {
  const Band band{in.number("from", 0.0, 1e4).value_or(0.0), in.number("to", 0.0, 1e4)};
  if (band.to && *band.to <= band.from) in.wrong("", "the band is empty: from is not before to");
  in.finish();
  return band;
}

Requirement requirementOf(JsonReader& in) {
  Requirement r;
  const bool alternatives = in.has("any"), total = in.has("at_most_new_share");
  const Measure common = measureOf(in, {}, !alternatives && !total);
  r.name = in.text("name", true);
  if (alternatives && !total) {
    readAlternatives(in, common, r);
  } else {
    r.anyOf.push_back(common);
    checkDays(in, in);
  }
  if (auto band = in.object("metres_from_site")) r.band = bandOf(*band);
  r.share = in.number("share", 0.0, 1.0).value_or(1.0);
  if (r.share <= 0.0) in.wrong("share", "a share above 0 is wanted");
  r.former = in.number("or_former_times", 0.0, 1.0);
  if (r.former == 0.0) in.wrong("or_former_times", "always holds: a number above 0 is wanted");
  if (total) readNewShare(in, r);
  if (r.former &&
      std::any_of(r.anyOf.begin(), r.anyOf.end(), [](const Measure& m) { return m.statistic == Statistic::newShadow; }))
    in.wrong("or_former_times", "new shadow has no former value");
  in.finish();
  return r;
}

void readSun(JsonReader& in, Rule& rule) {
  rule.sun.refraction = in.flag("refraction") ? sun::Refraction::standard : sun::Refraction::none;
  rule.sun.point = in.word("limb", {"centre", "upper"}) == 1 ? study::SunPoint::upperLimb : study::SunPoint::centre;
  rule.fixedDeclination = in.word("declination", {"moving", "fixed"}) == 1;
  in.finish();
}

void readReceivers(JsonReader& in, Rule& rule) {
  constexpr ReceiverKind kKinds[] = {ReceiverKind::points, ReceiverKind::areas, ReceiverKind::site};
  if (!in.has("kind")) in.wrong("kind", "is missing: points, areas or site");
  rule.receivers = kKinds[in.word("kind", {"points", "areas", "site"})];
  rule.height = in.number("height", -100.0, 1000.0).value_or(0.0);
  if (in.has("height") && rule.receivers == ReceiverKind::points)
    in.wrong("height", "points lie where they are; areas and site have a height");
  rule.casters = in.word("casters", {"scene", "site"}) == 1 ? CastersOf::site : CastersOf::scene;
  if (rule.casters == CastersOf::site && rule.receivers != ReceiverKind::site)
    in.wrong("casters", "those of the site belong to receivers of kind site");
  in.finish();
}

void readCountries(JsonReader& in, Rule& rule) {
  if (!in.json().is_object()) return;
  for (const auto& [country, value] : in.json().items())
    if (const auto degrees = in.number(country.c_str(), 0.0, 89.0))
      rule.altitudeByCountry.emplace_back(country, Angle::degrees(*degrees));
  if (in.json().empty()) in.wrong("", "is empty: a country and its degrees are wanted");
}

Rule ruleOf(JsonReader& in) {
  Rule rule;
  rule.name = in.text("name", true), rule.title = in.text("title", true), rule.source = in.text("source", true);
  rule.where = in.text("where");
  constexpr Hemisphere kHemispheres[] = {Hemisphere::both, Hemisphere::north, Hemisphere::south};
  rule.hemisphere = kHemispheres[in.word("hemisphere", {"both", "north", "south"})];
  if (auto receivers = in.object("receivers"))
    readReceivers(*receivers, rule);
  else
    in.wrong("receivers", "is missing");
  if (auto sun = in.object("sun")) readSun(*sun, rule);
  for (JsonReader& one : in.objects("requirements")) {
    Requirement requirement = requirementOf(one);
    for (const Requirement& other : rule.requirements)
      if (other.name == requirement.name) one.wrong("name", "another requirement has it, too");
    rule.requirements.push_back(std::move(requirement));
  }
  if (rule.requirements.empty()) in.wrong("requirements", "is missing or empty");
  if (auto countries = in.object("least_sun_altitude_by_country")) readCountries(*countries, rule);
  for (const Requirement& r : rule.requirements) {
    if (r.band && rule.receivers != ReceiverKind::site)
      in.wrong("requirements", "metres_from_site belongs to receivers of kind site");
    const bool ofAll = r.mostNew || r.share < 1.0, ends = r.band && r.band->to;
    if (rule.receivers == ReceiverKind::site && ofAll && !ends)
      in.wrong("requirements", "a share of what lies around a site wants an end: metres_from_site with to");
    for (const Measure& m : r.anyOf)
      if (m.leastAltitude && !rule.altitudeByCountry.empty())
        in.wrong("least_sun_altitude_by_country", "a measure has an altitude of its own");
  }
  rule.notes = in.texts("notes"), rule.checked = in.texts("checked"), rule.uncertain = in.texts("uncertain");
  in.finish();
  return rule;
}

std::vector<Rule> parsePresets() {
  std::vector<Rule> all;
  for (const auto& [name, text] : preset_texts::kTexts) {
    auto rule = parseRule(text, std::string(name));
    const std::string fault = rule ? std::string() : rule.error().text();
    UMBRAGE_CHECK(rule, fault.c_str());
    UMBRAGE_CHECK(rule->name == name, "a preset is named unlike its file");
    all.push_back(std::move(*rule));
  }
  return all;
}

std::string namesLike(const std::string& wanted) {
  const std::string head = wanted.substr(0, wanted.find('-'));
  std::vector<std::string> near, all;
  for (const Rule& rule : presets()) {
    all.push_back(rule.name);
    if (rule.name.substr(0, rule.name.find('-')) == head) near.push_back(rule.name);
  }
  return fmt::format("{}", fmt::join(near.empty() ? all : near, ", "));
}

tl::unexpected<Error> noPreset(const std::string& name) {
  return fail(ErrorCode::usage, fmt::format("there is no preset '{}'; there are {} (a file of one's own ends in .json)",
                                            name, namesLike(name)));
}

}  // namespace

Result<Rule> parseRule(std::string_view json, const std::string& where) {
  const auto document = detail::parseStrictJson(json, where);
  if (!document) return tl::unexpected(document.error());
  std::string fault;
  JsonReader in(*document, "", fault);
  Rule rule = ruleOf(in);
  if (!fault.empty()) return fail(ErrorCode::input, "is no rule: " + fault, where);
  return rule;
}

Result<Rule> readRule(const std::filesystem::path& path) {
  const auto bytes = readFile(path, kLargestFile);
  if (!bytes) return tl::unexpected(bytes.error());
  return parseRule({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path.string());
}

const std::vector<Rule>& presets() {
  static const std::vector<Rule> all = parsePresets();
  return all;
}

Result<std::string> presetText(const std::string& name) {
  for (const auto& [known, text] : preset_texts::kTexts)
    if (known == name) return std::string(text);
  return noPreset(name);
}

Result<Rule> findRule(const std::string& name) {
  if (name.ends_with(".json")) return readRule(name);
  for (const Rule& rule : presets())
    if (rule.name == name) return rule;
  return noPreset(name);
}

}  // namespace umbrage::rules

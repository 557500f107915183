#include "umbrage/rules/rule_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <umbrage_presets/presets.hpp>

#include "umbrage/base/check.hpp"
#include "umbrage/base/file.hpp"
#include "umbrage/rules/detail/json_reader.hpp"
#include "umbrage/sun/zone.hpp"

namespace umbrage::rules {
namespace {

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

Days daysOf(JsonReader& in) {
  Days days;
  for (const std::string& text : in.texts("dates")) {
    const auto day = monthDay(text);
    if (!day) in.wrong("dates", fmt::format("'{}' is no day; write MM-DD", text));
    if (day) days.dates.push_back(*day);
  }
  for (const double degrees : in.numbers("solar_longitudes", 0.0, 359.999))
    days.longitudes.push_back(Angle::degrees(degrees));
  const std::string from = in.text("from"), to = in.text("to");
  const int kinds = int(!days.dates.empty()) + int(!days.longitudes.empty()) + int(!from.empty() || !to.empty());
  if (kinds > 1) in.wrong("", "dates, solar_longitudes and from with to exclude each other");
  if (!days.dates.empty()) days.kind = Days::Kind::dates;
  if (!days.longitudes.empty()) days.kind = Days::Kind::longitudes;
  if (!from.empty() || !to.empty()) {
    days.kind = Days::Kind::range;
    for (const auto& [key, text] : {std::pair("from", from), std::pair("to", to)}) {
      const auto day = monthDay(text);
      if (!day) in.wrong(key, "a day MM-DD is wanted, and from and to belong together");
      days.dates.push_back(day.value_or(std::chrono::January / 1));
    }
  }
  const auto every = in.number("every", 1, 366);
  if (every && days.kind != Days::Kind::range) in.wrong("every", "belongs to from and to");
  days.every = static_cast<int>(every.value_or(1.0));
  days.best = in.word("count", {"each", "best"}) == 1;
  if (kinds == 0 && !in.flag("given")) in.wrong("", "dates, solar_longitudes, from with to, or given: true is wanted");
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
  in.finish();
  return window;
}

void readThreshold(JsonReader& in, Measure& measure) {
  constexpr std::pair<const char*, Comparison> kKinds[] = {{"at_least_hours", Comparison::atLeast},
                                                           {"more_than_hours", Comparison::moreThan},
                                                           {"at_most_hours", Comparison::atMost},
                                                           {"less_than_hours", Comparison::lessThan}};
  int found = 0;
  for (const auto& [key, comparison] : kKinds) {
    const auto hours = in.number(key, 0.0, kDay);
    if (!hours) continue;
    measure.threshold = ofHours(*hours), measure.comparison = comparison;
    ++found;
  }
  if (found != 1)
    in.wrong("", "exactly one of at_least_hours, more_than_hours, at_most_hours and less_than_hours is wanted");
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
  if (m.window.from && m.window.to && wantsMore && m.threshold > *m.window.to - *m.window.from)
    in.wrong("", fmt::format("{:g} h are wanted of a window of {:g} h", double(m.threshold.count()) / 3.6e6,
                             double((*m.window.to - *m.window.from).count()) / 3.6e6));
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

Requirement requirementOf(JsonReader& in) {
  Requirement r;
  const bool alternatives = in.has("any"), total = in.has("at_most_new_share");
  const Measure common = measureOf(in, {}, !alternatives && !total);
  r.name = in.text("name", true);
  for (JsonReader& one : in.objects("any")) {
    r.anyOf.push_back(measureOf(one, common, true));
    one.finish();
  }
  if (alternatives && r.anyOf.empty()) in.wrong("any", "is empty");
  if (!alternatives) r.anyOf.push_back(common);
  for (const Measure& m : r.anyOf)
    if (m.days.best && r.anyOf.size() > 1) in.wrong("any", "one best day cannot be that of several measures");
  if (auto band = in.object("metres_from_site")) {
    r.band = Band{band->number("from", 0.0, 1e4).value_or(0.0), band->number("to", 0.0, 1e4)};
    if (r.band->to && *r.band->to <= r.band->from) band->wrong("", "the band is empty: from is not before to");
    band->finish();
  }
  r.share = in.number("share", 0.0, 1.0).value_or(1.0);
  if (r.share <= 0.0) in.wrong("share", "a share above 0 is wanted");
  r.former = in.number("or_former_times", 0.0, 1.0);
  if (total) {
    r.mostNew = in.number("at_most_new_share", 0.0, 1.0);
    if (alternatives || in.has("share") || r.former)
      in.wrong("at_most_new_share", "stands alone, without any, share and or_former_times");
    r.anyOf.front().statistic = Statistic::newShadow;
    r.anyOf.front().comparison = Comparison::atMost;
  }
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
  for (JsonReader& one : in.objects("requirements")) rule.requirements.push_back(requirementOf(one));
  if (rule.requirements.empty()) in.wrong("requirements", "is missing or empty");
  if (auto countries = in.object("least_sun_altitude_by_country")) readCountries(*countries, rule);
  for (const Requirement& r : rule.requirements) {
    if (r.band && rule.receivers != ReceiverKind::site)
      in.wrong("requirements", "metres_from_site belongs to receivers of kind site");
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
  const auto document = detail::parseJson(json, where);
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

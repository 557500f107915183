#include "umbrage/rules/rule.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace umbrage::rules {

bool needsBaseline(const Rule& rule) {
  return std::any_of(rule.requirements.begin(), rule.requirements.end(), [](const Requirement& r) {
    return r.mostNew.has_value() || std::any_of(r.anyOf.begin(), r.anyOf.end(),
                                                [](const Measure& m) { return m.statistic == Statistic::newShadow; });
  });
}

Rule withLeastAltitude(Rule rule, Angle altitude) {
  for (Requirement& requirement : rule.requirements)
    for (Measure& measure : requirement.anyOf) measure.leastAltitude = altitude;
  rule.altitudeByCountry.clear();
  return rule;
}

Result<Rule> withCountry(Rule rule, const std::string& country) {
  std::string known;
  for (const auto& [name, altitude] : rule.altitudeByCountry) {
    if (name == country) return withLeastAltitude(rule, altitude);
    known += (known.empty() ? "" : ", ") + name;
  }
  if (known.empty())
    return fail(ErrorCode::usage, fmt::format("{} has one least altitude of the sun for all countries", rule.name));
  return fail(ErrorCode::usage, fmt::format("{} has no least altitude of the sun for '{}', only for {}; --min-altitude "
                                            "DEG gives one",
                                            rule.name, country, known));
}

}  // namespace umbrage::rules

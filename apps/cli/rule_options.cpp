#include "rule_options.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "umbrage/rules/rule_file.hpp"
#include "umbrage/study/georeference.hpp"

namespace umbrage::cli {
namespace {

// Metres from cell to cell, where no grid is asked for.
constexpr double kGrid = 1.0;
// Points on a line, of the grid's step.
constexpr double kAlong = 0.25;

Result<Outcome> presetList(const std::string&) {
  std::string text;
  for (const rules::Rule& rule : rules::presets())
    text += fmt::format("{:<26}{}{}\n", rule.name, rule.title, rules::needsBaseline(rule) ? "  [--baseline]" : "");
  text.pop_back();
  return Outcome{text, 0};
}

Result<Outcome> presetText(const std::string& name) {
  auto text = rules::presetText(name);
  if (!text) return tl::unexpected(text.error());
  text->pop_back();
  return Outcome{*text, 0};
}

Result<rules::TargetSet> pointsOf(const RuleOptions& o, const rules::Rule& rule, const scene::Scene& scene) {
  if (o.points.empty() && o.windows.empty())
    return fail(ErrorCode::usage, fmt::format("{} looks at points: --points P.csv or --windows PART", rule.name));
  auto set = o.points.empty() ? study::faceReceivers(scene, o.windows, o.grid.value_or(kGrid / scene.metresPerUnit))
                              : study::readReceivers(o.points);
  if (!set) return tl::unexpected(set.error());
  return rules::pointTargets(*set);
}

Result<std::vector<rules::Area>> areasOf(const RuleOptions& o, const rules::Rule& rule, const scene::Scene& scene) {
  const std::string& file = o.areas.empty() ? o.site : o.areas;
  if (file.empty())
    return fail(ErrorCode::usage, fmt::format("{} looks at open spaces: --areas AREAS.geojson", rule.name));
  return rules::readAreas(file, scene);
}

Result<Grounds> aroundSite(const RuleOptions& o, const rules::Rule& rule, const scene::Scene& scene,
                           const rules::VerifyRequest& request, std::optional<double> reach, Grounds g) {
  auto site = siteOf(o, scene);
  if (!site) return tl::unexpected(site.error());
  g.areas.push_back(std::move(*site));
  if (!reach) {
    const Box3 box = scene::bounds(scene, true);
    const double above = box.empty() ? 0.0 : study::mapHeight(box.max, scene.up) - g.height;
    reach = rules::shadowReach(above * scene.metresPerUnit, rule, request) + rules::overhang(scene, g.areas.front());
  }
  const double step = o.grid ? *o.grid * scene.metresPerUnit : kGrid;
  auto targets = rules::siteTargets(g.areas.front(), rule, scene, {g.height, kAlong * step, step, *reach});
  if (!targets) return tl::unexpected(targets.error());
  g.targets = std::move(*targets);
  return g;
}

bool usesBaseline(const rules::Rule& rule) {
  return rules::needsBaseline(rule) ||
         std::any_of(rule.requirements.begin(), rule.requirements.end(), [](const auto& r) { return r.former; });
}

}  // namespace

Result<void> checkRule(const RuleOptions& o) {
  if (!o.points.empty() && !o.windows.empty())
    return fail(ErrorCode::usage, "--points and --windows exclude each other");
  if (!o.country.empty() && o.leastAltitude)
    return fail(ErrorCode::usage, "--country and --min-altitude exclude each other");
  return {};
}

Result<void> checkReceivers(const RuleOptions& o, const rules::Rule& rule, bool ownSite) {
  using Kind = rules::ReceiverKind;
  const Kind kind = rule.receivers;
  const char* wants = kind == Kind::points  ? "points: --points P.csv or --windows PART"
                      : kind == Kind::areas ? "open spaces: --areas AREAS.geojson"
                                            : "lines around a site: --site SITE.geojson";
  const std::pair<const char*, bool> useless[] = {
      {"--points", !o.points.empty() && kind != Kind::points},
      {"--windows", !o.windows.empty() && kind != Kind::points},
      {"--areas", !o.areas.empty() && kind != Kind::areas},
      {"--site", !o.site.empty() && !ownSite && (kind == Kind::points || (kind == Kind::areas && !o.areas.empty()))}};
  for (const auto& [option, given] : useless)
    if (given) return fail(ErrorCode::usage, fmt::format("{} looks at {}; not at {}", rule.name, wants, option));
  if (o.height && kind == Kind::points)
    return fail(ErrorCode::usage, fmt::format("{} looks at {}; --height is for areas and sites", rule.name, wants));
  // Points and areas are told what is new on them whatever the rule; around a site, and while a volume grows, nothing is.
  if (!o.baseline.empty() && (ownSite || kind == Kind::site) && !usesBaseline(rule))
    return fail(
        ErrorCode::usage,
        fmt::format("{} does not ask what stood before, and nothing else here does; leave out --baseline", rule.name));
  return {};
}

std::optional<std::string> aboveAll(const rules::Rule& rule, const scene::Scene& scene, double height) {
  const Box3 box = scene::bounds(scene, true);
  if (rule.receivers == rules::ReceiverKind::points || box.empty()) return std::nullopt;
  const double top = study::mapHeight(box.max, scene.up);
  if (top > height) return std::nullopt;
  return fmt::format(
      "receivers lie at height {:g}, and nothing in the scene rises above {:g}: nothing can cast there (--plane, "
      "--height)",
      height, top);
}

Result<rules::Rule> ruleOf(const RuleOptions& o) {
  auto rule = rules::findRule(o.preset);
  if (!rule) return rule;
  if (o.leastAltitude) return rules::withLeastAltitude(std::move(*rule), Angle::degrees(*o.leastAltitude));
  if (!o.country.empty()) return rules::withCountry(std::move(*rule), o.country);
  return rule;
}

Result<std::optional<scene::Scene>> baselineOf(const RuleOptions& o, const SceneOptions& sceneOptions,
                                               const scene::Scene& scene, const Console& console) {
  if (o.baseline.empty()) return std::optional<scene::Scene>();
  SceneOptions options = sceneOptions;
  options.file = o.baseline;
  auto read = loadScene(options, console);
  if (!read) return tl::unexpected(read.error());
  const bool same = read->up == scene.up && read->metresPerUnit == scene.metresPerUnit && read->crs == scene.crs &&
                    read->northOffset == scene.northOffset;
  if (!same)
    return fail(ErrorCode::input,
                "has another up axis, unit, north or reference system than the scene; both must lie in one frame",
                o.baseline);
  return std::optional(std::move(*read));
}

Result<rules::Area> siteOf(const RuleOptions& o, const scene::Scene& scene) {
  if (o.site.empty()) return fail(ErrorCode::usage, "a site is wanted: --site SITE.geojson");
  auto areas = rules::readAreas(o.site, scene);
  if (!areas) return tl::unexpected(areas.error());
  if (areas->size() > 1) return fail(ErrorCode::input, "has several polygons; a site is one feature", o.site);
  return std::move(areas->front());
}

Result<Grounds> groundsOf(const RuleOptions& o, const rules::Rule& rule, const scene::Scene& scene,
                          const rules::VerifyRequest& request, std::optional<double> reach) {
  Grounds g;
  const Box3 box = scene::bounds(scene, true);
  g.ground = o.plane.value_or(box.empty() ? 0.0 : study::mapHeight(box.min, scene.up));
  g.height = g.ground + o.height.value_or(rule.height) / scene.metresPerUnit;
  if (rule.receivers == rules::ReceiverKind::points) {
    auto targets = pointsOf(o, rule, scene);
    if (!targets) return tl::unexpected(targets.error());
    g.targets = std::move(*targets);
    return g;
  }
  if (rule.receivers == rules::ReceiverKind::site) return aroundSite(o, rule, scene, request, reach, std::move(g));
  auto areas = areasOf(o, rule, scene);
  if (!areas) return tl::unexpected(areas.error());
  g.areas = std::move(*areas);
  auto targets = rules::areaTargets(g.areas, scene, o.grid.value_or(kGrid / scene.metresPerUnit), g.height);
  if (!targets) return tl::unexpected(targets.error());
  g.targets = std::move(*targets);
  return g;
}

void addRuleOptions(CLI::App& app, RuleOptions& options, bool required) {
  const Manner rule{.group = "Rule"};
  constexpr Manner where{.group = "Where"};
  const auto number = [](double low, double high) {
    return [low, high](const std::string& word) { return parseNumber(word, low, high); };
  };
  addWord(app, "--preset", "NAME|FILE.json", "The rule: one that comes with the program, or one of your own",
          options.preset, {.group = "Rule", .required = required});
  addAnswer(app, "--list-presets", "", "The presets, and no more", presetList, rule);
  addAnswer(app, "--print-preset", "NAME", "A preset as a file to make one of your own of, and no more", presetText,
            rule);
  addWord(app, "--country", "CODE", "For presets whose least altitude of the sun depends on the country: DE, ..",
          options.country, rule);
  addValue(app, "--min-altitude", "DEG", "The least altitude of the sun that counts, instead of the preset's",
           options.leastAltitude, number(0, 89), rule);
  addWord(app, "--baseline", "SCENE2", "What stands now, in the same frame: tells what is new in shadow",
          options.baseline, where);
  addWord(app, "--site", "SITE.geojson", "The site (and the open spaces, without --areas)", options.site, where);
  addWord(app, "--areas", "AREAS.geojson", "Open spaces, for presets that look at them; each is judged by itself",
          options.areas, where);
  addWord(app, "--points", "P.csv", "Points, with the header x,y,z,nx,ny,nz, for presets of windows", options.points,
          where);
  addValues(app, "--windows", "PART", "Points on all faces of these parts instead (repeatable)", options.windows,
            parseWord, where);
  addValue(app, "--grid", "STEP", "From point to point on areas and faces, in the scene's unit (default: 1 m)",
           options.grid, number(1e-6, 1e9), where);
  addValue(app, "--height", "M", "Receivers of areas and sites above the ground, in metres (default: the preset's)",
           options.height, number(-1e3, 1e4), where);
}

}  // namespace umbrage::cli

#include <algorithm>

#include <fmt/format.h>

#include "commands.hpp"
#include "moments.hpp"
#include "outputs.hpp"
#include "rule_options.hpp"
#include "verify_files.hpp"
#include "verify_words.hpp"

namespace umbrage::cli {
namespace {

using std::chrono::milliseconds;

struct VerifyOptions {
  SceneOptions scene;
  PlaceOptions place;
  RuleOptions rule;
  std::string output;
  std::vector<milliseconds> at;
  rules::Sensitivity sensitivity = rules::Sensitivity::nearThreshold;
  bool json = false;
};

Result<rules::Sensitivity> parseSensitivity(const std::string& word) {
  if (word == "near") return rules::Sensitivity::nearThreshold;
  if (word == "always") return rules::Sensitivity::always;
  if (word == "never") return rules::Sensitivity::never;
  return fail(ErrorCode::usage, fmt::format("'{}' is none of near, always, never", word));
}

Result<void> check(const VerifyOptions& o) {
  if (auto fine = checkRule(o.rule); !fine || o.output.empty()) return fine;
  const auto files = verdictFiles(o.output);
  if (!files) return tl::unexpected(files.error());
  for (const std::string& input :
       {o.scene.file, o.rule.baseline, o.rule.site, o.rule.areas, o.rule.points, o.rule.preset})
    if (auto open = checkOutputs(*files, input); !open) return open;
  return {};
}

// The moments of a day whose shapes are kept: those asked for, else the clock's full hours.
std::vector<sun::Instant> momentsOf(const VerifyOptions& o, const rules::VerifyRequest& request,
                                    std::chrono::year_month_day date, const std::vector<study::TimeSpan>& times) {
  std::vector<milliseconds> clock = o.at;
  for (int h = 0; o.at.empty() && h < 24; ++h) clock.emplace_back(std::chrono::hours(h));
  std::vector<sun::Instant> moments;
  for (const milliseconds time : clock) {
    const auto moment = sun::instantOf(request.zone, request.place, {date, time});
    if (!moment) continue;  // clocks leave it out
    const auto holds = [&](const study::TimeSpan& s) { return s.from <= moment->instant && moment->instant < s.to; };
    if (std::any_of(times.begin(), times.end(), holds)) moments.push_back(moment->instant);
  }
  return moments;
}

Result<std::vector<DayNews>> newsOf(const VerifyOptions& o, const scene::Scene& scene, const scene::Scene& baseline,
                                    const Grounds& grounds, const rules::Verdict& verdict,
                                    const rules::VerifyRequest& request, const Console& console) {
  std::vector<DayNews> all;
  const rules::Rule& rule = verdict.rule;
  for (const auto& date : rules::newsDates(verdict, request)) {
    const auto times = rules::countingOn(rule, decidingMeasure(verdict), date, request);
    DayNews day{date, {}};
    if (grounds.areas.empty()) {
      study::ReceiverSet points;
      for (const rules::Target& t : grounds.targets.targets) points.receivers.push_back(t.receiver);
      auto news = rules::newOnPoints(scene, baseline, request.place, points, times, rule.sun, console.progress());
      if (!news) return tl::unexpected(news.error());
      day.news.areas = std::move(*news);
    } else {
      rules::NetNewOptions options;
      options.height = grounds.height, options.times = times, options.areas = grounds.areas, options.sun = rule.sun;
      // Only maps draw them.
      if (!o.output.empty() && !hasExtension(o.output, ".csv")) options.moments = momentsOf(o, request, date, times);
      auto news = rules::netNew(scene, baseline, request.place, options, console.progress());
      if (!news) return tl::unexpected(news.error());
      day.news = std::move(*news);
    }
    all.push_back(std::move(day));
  }
  return all;
}

// Where only a building's own shadow counts, what stands beside its site casts nothing.
Result<scene::Scene> withRulesCasters(scene::Scene scene, const rules::Rule& rule, const RuleOptions& options) {
  if (rule.casters == rules::CastersOf::scene) return scene;
  const auto site = siteOf(options, scene);
  if (!site) return tl::unexpected(site.error());
  return rules::castersOnSite(std::move(scene), *site);
}

Result<Outcome> run(const VerifyOptions& o, const Console& console) {
  if (const auto fine = check(o); !fine) return tl::unexpected(fine.error());
  const auto rule = ruleOf(o.rule);
  if (!rule) return tl::unexpected(rule.error());
  if (const auto fine = checkReceivers(o.rule, *rule, false); !fine) return tl::unexpected(fine.error());
  auto read = loadScene(o.scene, console);
  if (!read) return tl::unexpected(read.error());
  if (const auto casts = checkCasts(*read, o.scene); !casts) return tl::unexpected(casts.error());
  const auto baseline = baselineOf(o.rule, o.scene, *read, console);
  if (!baseline) return tl::unexpected(baseline.error());
  const auto scene = withRulesCasters(std::move(*read), *rule, o.rule);
  if (!scene) return tl::unexpected(scene.error());
  const auto place = placeOf(o.place, *scene, o.scene, console);
  if (!place) return tl::unexpected(place.error());
  VerdictReport report;
  report.request = {*place, o.place.zone, o.place.date, o.sensitivity};
  report.request.casters = o.scene.casters;
  report.request.days = rules::makeSunDays();
  report.metresPerUnit = scene->metresPerUnit;
  auto grounds = groundsOf(o.rule, *rule, *scene, report.request);
  if (!grounds) return tl::unexpected(grounds.error());
  const scene::Scene* before = *baseline ? &**baseline : nullptr;
  auto verdict = rules::verify(*scene, before, *rule, grounds->targets, report.request, console.progress());
  if (!verdict) return tl::unexpected(verdict.error());
  report.verdict = std::move(*verdict);
  if (auto warning = aboveAll(*rule, *scene, grounds->height)) report.verdict.warnings.push_back(std::move(*warning));
  for (const std::string& warning : report.verdict.warnings) console.warn(warning);
  if (before != nullptr && rule->receivers != rules::ReceiverKind::site) {
    auto news = newsOf(o, *scene, *before, *grounds, report.verdict, report.request, console);
    // A scene that adds nothing has a verdict all the same.
    if (!news && news.error().code != ErrorCode::usage) return tl::unexpected(news.error());
    if (!news) console.warn(news.error().text());
    if (news) report.news = std::move(*news);
  }
  report.targets = std::move(grounds->targets), report.areas = std::move(grounds->areas);
  if (!o.output.empty())
    if (const auto written =
            writeVerdict({o.output, *scene, o.place, o.scene.casters, grounds->height}, report, console);
        !written)
      return tl::unexpected(written.error());
  const std::string path = o.output.empty() ? "" : o.output + "\n";
  return Outcome{o.json ? jsonText(verdictJson(report)) : path + verdictText(report), report.verdict.passes ? 0 : 1};
}

}  // namespace

Run addVerify(CLI::App& app) {
  const auto options = std::make_shared<VerifyOptions>();
  addSceneOptions(app, options->scene);
  addPlaceOptions(app, options->place, PlaceFrom::scene);
  addRuleOptions(app, options->rule, true);
  addValue(app, "--plane", "HEIGHT", "The ground of areas and sites (default: the scene's lowest point)",
           options->rule.plane, [](const std::string& word) { return parseNumber(word, -1e12, 1e12); },
           {.group = "Where"});
  addValue(app, "--sensitivity", "near|always|never",
           "When to tell what other conventions (clock, refraction, limb, declination) would say (default: near a "
           "threshold)",
           options->sensitivity, parseSensitivity, {.group = "Rule"});
  addValues(app, "--at", "HH:MM", "Moments whose new shadow is drawn (repeatable; default: the full hours)",
            options->at, sun::parseTime, {.group = "Place and time"});
  addWord(
      app, "-o,--output", "OUT.{html,csv,geojson,dxf,svg}",
      "The evidence: a page with all of it (and table, map and animation beside it), receivers as a table, or a map",
      options->output);
  addFlag(app, "--json", "The verdict as JSON", options->json);
  return [options](const Console& console) { return run(*options, console); };
}

}  // namespace umbrage::cli

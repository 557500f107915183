#include "inverse.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "map.hpp"
#include "outputs.hpp"
#include "umbrage/io/write.hpp"
#include "umbrage/report/colours.hpp"
#include "umbrage/rules/inverse.hpp"

namespace umbrage::cli {
namespace {

constexpr double kMost = 100.0;

bool isMap(const std::string& path) {
  return hasExtension(path, ".geojson") || hasExtension(path, ".dxf") || hasExtension(path, ".svg");
}

Result<void> check(const InverseVolume& o) {
  if (o.rule.preset.empty()) return fail(ErrorCode::usage, "--inverse wants a rule: --preset NAME");
  if (auto fine = checkRule(o.rule); !fine) return fine;
  if (auto known = checkExtension("-o", o.output, inverseKinds()); !known) return known;
  for (const std::string& input :
       {o.scene.file, o.rule.baseline, o.rule.site, o.rule.areas, o.rule.points, o.rule.preset})
    if (auto open = checkOutputs({o.output}, input); !open) return open;
  return {};
}

// The columns without what stands around them.
scene::Scene volumeAlone(scene::Scene scene) {
  std::erase_if(scene.instances, [](const scene::Instance& i) { return !i.name.starts_with(rules::kColumnName); });
  return scene;
}

Result<report::VectorMap> mapOf(const InverseVolume& o, const rules::InverseEnvelope& found, const scene::Scene& scene,
                                const Grounds& grounds, const sun::Place& place) {
  auto map = cli::mapOf(scene, outline::castersOf(scene), grounds.ground, place, o.place, "", {}, o.scene.casters);
  if (!map) return map;
  map->title = "Tallest volume";
  map->subtitle = found.verdict.rule.name;
  map->ledger = found.verdict.ledger;
  map->ledger.insert(map->ledger.begin() + 2,
                     {"Volume", fmt::format("{:.1f} m3 in {} columns; {} volumes were held against the rule",
                                            found.volume, found.columns.size(), found.trials)});
  double highest = 0.0;
  for (const rules::Column& column : found.columns) highest = std::max(highest, column.height);
  constexpr int kSteps = 8;
  for (int i = 0; i < kSteps; ++i)
    map->layers.push_back(
        {fmt::format("up to {:.1f} m", highest * (i + 1) / kSteps), report::heatColour((i + 0.5) / kSteps), 0.9});
  for (const rules::Column& column : found.columns) {
    const int step = std::clamp(static_cast<int>(kSteps * column.height / std::max(highest, 1e-9)), 0, kSteps - 1);
    report::MapFeature feature{static_cast<std::size_t>(step), column.plan, {}};
    feature.properties = {{"height", column.height},
                          {"bounded", std::string(column.bounded ? "by the rule" : "by --max-height")},
                          {"area_m2", column.plan.area * scene.metresPerUnit * scene.metresPerUnit}};
    map->features.push_back(std::move(feature));
  }
  return map;
}

Result<void> write(const InverseVolume& o, const rules::InverseEnvelope& found, const scene::Scene& scene,
                   const Grounds& grounds, const sun::Place& place) {
  if (!isMap(o.output))
    return writeOutputs(
        {{o.output, [&](const std::string& path) { return io::writeScene(volumeAlone(found.scene), path); }}});
  const auto map = mapOf(o, found, scene, grounds, place);
  if (!map) return tl::unexpected(map.error());
  MapOptions options;
  options.output = o.output;
  return cli::write(*map, options);
}

std::string summary(const InverseVolume& o, const rules::InverseEnvelope& found) {
  double lowest = 1e300, highest = 0.0;
  std::size_t free = 0;
  for (const rules::Column& column : found.columns) {
    lowest = std::min(lowest, column.height), highest = std::max(highest, column.height);
    free += column.bounded ? 0 : 1;
  }
  return fmt::format(
      "{}\n{}: {:.1f} m3 in {} columns, {:.2f} to {:.2f} m high; {} of them reach --max-height and not the rule's "
      "limit\n{} volumes were held against the rule; it {} as it is, and fails where a bounded column is raised by 1 "
      "%\n",
      o.output, found.verdict.rule.name, found.volume, found.columns.size(), lowest, highest, free, found.trials,
      found.verdict.passes ? "passes" : "fails");
}

}  // namespace

const std::vector<std::string>& inverseKinds() {
  static const std::vector<std::string> kinds{".geojson", ".dxf", ".svg", ".glb", ".obj", ".iv", ".city.json"};
  return kinds;
}

Result<Outcome> inverseVolume(const InverseVolume& o, const Console& console) {
  if (const auto fine = check(o); !fine) return tl::unexpected(fine.error());
  const auto rule = ruleOf(o.rule);
  if (!rule) return tl::unexpected(rule.error());
  if (const auto fine = checkReceivers(o.rule, *rule, true); !fine) return tl::unexpected(fine.error());
  const auto scene = loadScene(o.scene, console);
  if (!scene) return tl::unexpected(scene.error());
  const auto baseline = baselineOf(o.rule, o.scene, *scene, console);
  if (!baseline) return tl::unexpected(baseline.error());
  const auto place = placeOf(o.place, *scene, o.scene, console);
  if (!place) return tl::unexpected(place.error());
  const auto site = siteOf(o.rule, *scene);
  if (!site) return tl::unexpected(site.error());
  rules::VerifyRequest request{*place, o.place.zone, o.place.date, rules::Sensitivity::nearThreshold};
  request.days = rules::makeSunDays();
  rules::InverseOptions options;
  options.cell = o.cell.value_or(0.0), options.most = o.most.value_or(kMost);
  std::optional<double> reach;
  if (rule->receivers == rules::ReceiverKind::site) reach = rules::shadowReach(options.most, *rule, request);
  const auto grounds = groundsOf(o.rule, *rule, *scene, request, reach);
  if (!grounds) return tl::unexpected(grounds.error());
  options.base = grounds->ground;
  const auto found = rules::inverseEnvelope(*scene, *baseline ? &**baseline : nullptr, *rule, grounds->targets, *site,
                                            request, options, console.progress());
  if (!found) return tl::unexpected(found.error());
  if (const auto written = write(o, *found, *scene, *grounds, *place); !written) return tl::unexpected(written.error());
  return Outcome{summary(o, *found), found->verdict.passes ? 0 : 1};
}

}  // namespace umbrage::cli

#pragma once

#include "options.hpp"
#include "place.hpp"
#include "umbrage/rules/verify.hpp"

// What the commands share that hold a scene against a rule.
namespace umbrage::cli {

struct RuleOptions {
  std::string preset, baseline, site, areas, points, country;
  std::vector<std::string> windows;
  std::optional<double> grid, plane, height, leastAltitude;
};
/// `required`: the command makes no sense without --preset.
void addRuleOptions(CLI::App& app, RuleOptions& options, bool required);

/// Contradictions among them. Errors: usage.
[[nodiscard]] Result<void> checkRule(const RuleOptions& options);

/// Where the rule does not look. `ownSite`: the command has a use of its own for --site. Errors: usage, with what the rule wants.
[[nodiscard]] Result<void> checkReceivers(const RuleOptions& options, const rules::Rule& rule, bool ownSite);

/// What to warn of where no part that casts rises above the receivers at `height` (of the scene); nothing for rules of points.
[[nodiscard]] std::optional<std::string> aboveAll(const rules::Rule& rule, const scene::Scene& scene, double height);

/// The rule with the altitude or the country that was asked for.
[[nodiscard]] Result<rules::Rule> ruleOf(const RuleOptions& options);

/// The scene of --baseline, read as SCENE is; nothing without. Errors: input, where it lies in another frame than `scene`.
[[nodiscard]] Result<std::optional<scene::Scene>> baselineOf(const RuleOptions& options,
                                                             const SceneOptions& sceneOptions,
                                                             const scene::Scene& scene, const Console& console);

/// The one polygon of --site. Errors: usage (none is given), input.
[[nodiscard]] Result<rules::Area> siteOf(const RuleOptions& options, const scene::Scene& scene);

/// What the rule looks at: its areas or its site, and the receivers on them.
struct Grounds {
  std::vector<rules::Area> areas;
  rules::TargetSet targets;
  double ground = 0.0;  ///< height of the ground, ...
  double height = 0.0;  ///< ... and of receivers on areas and lines, in the scene's unit
};
/// `reach`: how far around a site shadows may matter, in metres; nothing: as the scene's shadows reach. Errors: usage, input.
[[nodiscard]] Result<Grounds> groundsOf(const RuleOptions& options, const rules::Rule& rule, const scene::Scene& scene,
                                        const rules::VerifyRequest& request,
                                        std::optional<double> reach = std::nullopt);

}  // namespace umbrage::cli

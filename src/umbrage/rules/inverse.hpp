#pragma once

#include "umbrage/rules/verify.hpp"

// The tallest volume on a site that a rule lets stand.
namespace umbrage::rules {

struct InverseOptions {
  double cell = 0.0;    ///< metres from column to column; 0: as fine as kMostColumns / 4 columns are
  double most = 200.0;  ///< metres: nothing grows higher
  double base = 0.0;    ///< height of the site's ground, in the scene's unit
};
inline constexpr std::size_t kMostColumns = 400;

/// One part of the volume: a prism over a piece of the site.
struct Column {
  outline::Region plan;  ///< in the plan of the scene
  double height = 0.0;   ///< metres above the base
  bool bounded = true;   ///< raised by kRaise it would fail; false: it reaches InverseOptions::most
};

struct InverseEnvelope {
  std::vector<Column> columns;
  double volume = 0.0;     ///< m3
  std::size_t trials = 0;  ///< how many volumes were held against the rule
  scene::Scene scene;      ///< what stands and the volume, one instance a column, named kColumnName and its number
  Verdict verdict;         ///< of that scene
};
inline constexpr const char* kColumnName = "envelope";
/// What a column is raised by to show that it cannot be higher: one part in a hundred, and at least kRaiseLeast metres.
inline constexpr double kRaise = 0.01;
inline constexpr double kRaiseLeast = 0.01;

/// The site cut into square columns; all grow together until the rule stops them, then those that still can, and at last one after the
/// other.
/// 1. The volume passes the rule.
/// 2. It fails when any one column with `bounded` is raised by kRaise. A rule's shadow only grows with what casts it, so this holds in any order.
/// 3. Columns stand on the base, are closed, and are as wide as the cell where the site is.
/// What stands on the site already stays, unless the scene leaves it out. Of a rule whose casters are those of the site, only the volume casts.
/// Errors: usage (as verify; the rule fails with nothing on the site; more than kMostColumns columns), cancelled.
/// CAVEAT: between the receivers nothing is looked at: a finer grid may want a lower volume.
[[nodiscard]] Result<InverseEnvelope> inverseEnvelope(const scene::Scene& scene, const scene::Scene* baseline,
                                                      const Rule& rule, const TargetSet& targets, const Area& site,
                                                      const VerifyRequest& request, const InverseOptions& options,
                                                      const ProgressSink& progress = {});

}  // namespace umbrage::rules

#pragma once

#include "umbrage/rules/detail/judge.hpp"

namespace umbrage::rules::detail {

/// Areas that may get no new shadow at all, and whose cells' middles see none, are asked by the exact outlines of the new shadow (netNew), on every
/// day of the rule; what reaches more than a millimetre into an area for kShortestNew or longer turns the finding into a fail. Other findings stay
/// as they are, and so do those of targets without areas. Errors: cancelled.
[[nodiscard]] Result<void> holdOutlines(const scene::Scene& scene, const scene::Scene& baseline, const Rule& rule,
                                        const TargetSet& targets, const Conventions& conventions,
                                        const ProgressSink& progress, std::vector<Finding>& findings);

}  // namespace umbrage::rules::detail

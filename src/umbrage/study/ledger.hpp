#pragma once

#include <vector>

#include "umbrage/study/profile.hpp"

namespace umbrage::study {

/// "48.2000 N, 16.3700 E".
[[nodiscard]] std::string placeText(const sun::Place& place);

/// The conventions of a profile, one subject a line: they decide what a figure means, so that every output states them.
[[nodiscard]] std::vector<LedgerLine> ledgerOf(const scene::Scene& scene, const ProfileOptions& options,
                                               const PeriodSteps& steps, const shadow::Traits& technique);

}  // namespace umbrage::study

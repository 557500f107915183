#pragma once

#include <vector>

#include "umbrage/study/profile.hpp"
#include "umbrage/study/sun_course.hpp"

namespace umbrage::study {

/// "48.2000 N, 16.3700 E".
[[nodiscard]] std::string placeText(const sun::Place& place);

// Single lines, for the ledgers of other studies.
/// The clock and how it stands to UTC: "Europe/Vienna, UTC+02:00 (CEST)".
[[nodiscard]] LedgerLine clockLine(const sun::Zone& zone, const std::string& offset);
[[nodiscard]] LedgerLine northLine(const scene::Scene& scene);
/// The length of a unit and the reference system.
[[nodiscard]] LedgerLine unitLine(const scene::Scene& scene);
[[nodiscard]] LedgerLine castersLine(const std::vector<std::string>& patterns);
/// The scene's file and its SHA-256.
[[nodiscard]] LedgerLine inputLine(const scene::Scene& scene);
/// Whose figures these are: "Umbrage 0.1.0, exact sun hours; ERFA 2.0.0, tzdata 2025b".
[[nodiscard]] LedgerLine versionLine(const std::string& method, const sun::Zone& zone);
/// Which point of the sun, with which air, by which declination; `more` goes behind it.
[[nodiscard]] LedgerLine sunLine(const SunModel& model, const std::string& more);

/// The conventions of a profile, one subject a line: they decide what a figure means, so that every output states them.
[[nodiscard]] std::vector<LedgerLine> ledgerOf(const scene::Scene& scene, const ProfileOptions& options,
                                               const PeriodSteps& steps, const shadow::Traits& technique);

}  // namespace umbrage::study

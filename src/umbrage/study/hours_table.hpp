#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "umbrage/study/profile.hpp"
#include "umbrage/study/receivers.hpp"

namespace umbrage::study {

/// What surfaces do that are not fully opaque.
enum class Transparent {
  opaque,    ///< hide the sun like others
  ignored,   ///< hide nothing
  weighted,  ///< let their share through: an hour behind a part of opacity 0.3 counts 0.7 h; each part counts once
};

struct HoursRequest {
  sun::Place place;
  sun::Zone zone;
  std::chrono::year_month_day date;
  std::optional<std::chrono::year_month_day> until;               ///< the last of several days
  std::chrono::milliseconds from{0}, to{std::chrono::hours(24)};  ///< of each day, by the clock
  SunModel model;
  Transparent transparent = Transparent::opaque;
  std::optional<std::chrono::milliseconds> sampled;  ///< for comparison: what samples this far apart would say
  std::optional<std::chrono::milliseconds> least;    ///< runs at least so long are counted
  std::vector<std::string> casters;                  ///< for the ledger: patterns that chose what casts
};

/// The sun of each receiver.
struct HoursTable {
  ReceiverSet set;
  HoursRequest request;
  std::vector<TimeSpan> days;          ///< the period of each day
  std::vector<SunHours> lit;           ///< of each day; left out where that were too much (see kMostKept)
  std::vector<double> hours, longest;  ///< per receiver: the sum, and the longest run of a day
  std::vector<std::size_t> runs;       ///< as least asks; empty without
  std::vector<double> runHours;
  std::vector<std::array<float, 12>> months;  ///< hours per month of several days; empty of one
  double upHours = 0.0;                       ///< the sun is up, all days
  std::vector<LedgerLine> ledger;
  std::vector<std::string> warnings;
};

/// Receivers times days above which single stretches are not kept.
inline constexpr std::size_t kMostKept = 20'000'000;

/// Errors: usage (days that run backwards, times that clocks leave out), cancelled.
[[nodiscard]] Result<HoursTable> sunHours(const scene::Scene& scene, ReceiverSet receivers, const HoursRequest& request,
                                          const ProgressSink& progress = {});

/// "09:00:00-10:30:00;...", by the clock asked for, to the second; with several days each begins with its date. Empty where they were
/// not kept.
[[nodiscard]] std::string stretchesText(const HoursTable& table, std::size_t receiver);

}  // namespace umbrage::study

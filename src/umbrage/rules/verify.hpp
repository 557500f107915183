#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "umbrage/rules/targets.hpp"
#include "umbrage/study/profile.hpp"
#include "umbrage/sun/zone.hpp"

namespace umbrage::rules {

/// When switches are looked at (see Verdict::switches).
enum class Sensitivity { never, nearThreshold, always };

/// Days of the sun that were worked out. Requests that share one do not work out the same day twice (12 ms each, which is most of the time of rules of a
/// whole year); any places, rules and conventions may share it, one request at a time.
class SunDays;
[[nodiscard]] std::shared_ptr<SunDays> makeSunDays();

struct VerifyRequest {
  sun::Place place;
  sun::Zone zone;                      ///< what the clock of the place shows
  std::chrono::year_month_day date{};  ///< its year counts; rules without days of their own take it
  Sensitivity sensitivity = Sensitivity::nearThreshold;
  std::chrono::milliseconds near{15 * 60'000};  ///< a margin of at most so much is near
  std::vector<std::string> casters;             ///< for the ledger: patterns that chose what casts
  std::shared_ptr<SunDays> days;                ///< empty: of this request alone
};

/// What one receiver has.
struct ReceiverResult {
  std::size_t target = 0;  ///< of the targets
  double value = 0.0;      ///< hours, by the measure that decides it
  double threshold = 0.0;
  double margin = 0.0;  ///< hours on the passing side of the threshold; below 0 it fails
  bool passes = false;
  std::size_t measure = 0;             ///< of Requirement::anyOf
  std::chrono::year_month_day date{};  ///< the day that decides
  std::vector<study::TimeSpan> spans;  ///< of that day: sun, or shadow where the rule counts shadow
};

/// New shadow on an area by its exact outlines (netNew), where the middles of the area's cells see none of it.
struct NewOutlines {
  std::size_t days = 0;                ///< of the rule's, with such shadow
  double areaHours = 0.0;              ///< on all of them, m2 x h
  std::chrono::year_month_day date{};  ///< that with most of it
  double areaHoursThen = 0.0;          ///< on it
  std::vector<study::TimeSpan> spans;  ///< of it
};

/// One requirement held against one group of receivers.
/// 1. passes: the part `share` of the receivers passes and is at least `wanted`; with Requirement::mostNew: `newShare` is at most that.
/// 2. Where an area may get no new shadow at all, it fails as well where the exact outlines show some that
/// reaches more than a millimetre into it for kShortestNew or longer; then `outlines` is it, and margin,
///    newShare and newAreaHours are theirs.
struct Finding {
  std::size_t requirement = 0;  ///< of Rule::requirements
  std::size_t groupIndex = 0;   ///< of TargetSet::groups
  std::string group;            ///< its name; several may have one
  bool passes = false;
  double share = 0.0, wanted = 1.0;     ///< of the receivers, by area
  std::optional<double> formerShare;    ///< that passes in the baseline
  std::optional<double> newShare;       ///< with mostNew: new shadow, of all hours that count
  double newAreaHours = 0.0;            ///< with mostNew: m2 x h; h where receivers are points
  std::optional<NewOutlines> outlines;  ///< what turned a pass of all receivers into a fail
  /// Of the receiver that decides: when it had so much less (or more) sun, the finding would turn. With mostNew a share. Infinite
  /// where nothing has to pass since nothing did before (Requirement::former).
  double margin = 0.0;
  std::optional<std::size_t> deciding;  ///< of `receivers`
  std::vector<ReceiverResult> receivers;
};

/// One convention turned over while the others stay.
struct SwitchOutcome {
  std::string name;  ///< clock, refraction, limb, declination
  std::string taken, instead;
  bool passes = false;
  double margin = 0.0;  ///< the least of all findings
};

struct Verdict {
  Rule rule;
  bool passes = false;
  std::vector<Finding> findings;
  bool nearThreshold =
      false;  ///< some finding is nearer to its threshold than VerifyRequest::near (with mostNew: than a tenth of it)
  std::vector<SwitchOutcome> switches;
  std::vector<study::LedgerLine> ledger;
  std::vector<std::string> warnings;
};

/// Holds a scene against a rule. Times are exact (study::ExactHours), nothing is sampled in time; in space the targets are the samples.
/// 1. The verdict passes where all findings do.
/// 2. Requirements without receivers in their band have no finding; a rule without any finding is an error.
/// Errors: usage (a rule of the other hemisphere, a baseline missing, a least altitude missing, no targets), cancelled.
[[nodiscard]] Result<Verdict> verify(const scene::Scene& scene, const scene::Scene* baseline, const Rule& rule,
                                     const TargetSet& targets, const VerifyRequest& request,
                                     const ProgressSink& progress = {});

/// What a verdict hangs on.
struct Deciding {
  std::size_t finding = 0;                          ///< of Verdict::findings
  std::size_t measure = 0;                          ///< of its requirement's anyOf
  std::optional<std::chrono::year_month_day> date;  ///< nothing where all days are added up (mostNew)
};
/// The finding with the least to spare, those that fail before those that pass; a share of new shadow counts as that share of a day. Its measure and
/// day are those of the receiver that decides. REQUIRES: the verdict has findings.
[[nodiscard]] Deciding decidingOf(const Verdict& verdict);

/// When the sun counts for a measure of a rule on a day: its window, the sun up and high enough. Empty where never.
[[nodiscard]] std::vector<study::TimeSpan> countingOn(const Rule& rule, const Measure& measure,
                                                      std::chrono::year_month_day date, const VerifyRequest& request);

/// The dates of a measure, ascending.
[[nodiscard]] std::vector<std::chrono::year_month_day> datesOf(const Measure& measure, const VerifyRequest& request);

/// How far, in metres, the shadow of what rises `above` metres over a plane can turn what a rule says of a receiver on it: beyond, its shadow is
/// that long for too short a time, whatever its shape. Ends with the rule's bands; where a share of the receivers is asked for, all of the band.
[[nodiscard]] double shadowReach(double above, const Rule& rule, const VerifyRequest& request);

}  // namespace umbrage::rules

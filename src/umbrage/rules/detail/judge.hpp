#pragma once

#include <functional>
#include <memory>

#include "umbrage/rules/detail/days.hpp"
#include "umbrage/rules/verify.hpp"

namespace umbrage::rules::detail {

/// The course of the sun on one day of a measure and when it counts.
struct Day {
  std::chrono::year_month_day date;
  study::SunCourse course;
  Spans counting;
  study::SunModel model;  ///< of the course
};

/// The conventions of one run.
struct Conventions {
  Calendar calendar;
  study::SunModel sun;
  bool fixedDeclination = false;
  bool clockSwitched = false;
  std::shared_ptr<SunDays> days;
};
[[nodiscard]] Conventions conventionsOf(const Rule& rule, const VerifyRequest& request);

/// Nothing where no time of the day counts.
[[nodiscard]] std::shared_ptr<const Day> dayOf(const Measure& measure, std::chrono::year_month_day date,
                                               const Conventions& conventions);

/// When receivers are lit, of some scene: what study::ExactHours::at answers.
using SunOf = std::function<Result<study::SunHours>(std::span<const study::Receiver>, const study::SunCourse&,
                                                    const ProgressSink&)>;

/// The sun of a scene, and of what stood before; `before` may be empty.
struct Lights {
  SunOf now, before;
};
[[nodiscard]] SunOf sunOf(std::shared_ptr<const study::ExactHours> hours);

/// Does a measure hold at a receiver on one day? `lit`, `litBefore`: by what stands now, and in the baseline.
[[nodiscard]] bool holds(const Measure& measure, std::span<const study::TimeSpan> counting,
                         std::span<const study::TimeSpan> lit, std::span<const study::TimeSpan> litBefore);

/// Holds all requirements against all groups.
[[nodiscard]] Result<std::vector<Finding>> judge(const Rule& rule, const Lights& lights, const TargetSet& targets,
                                                 const Conventions& conventions, const ProgressSink& progress);
[[nodiscard]] bool allPass(const std::vector<Finding>& findings);

/// What must hold of a request before anything is worked out. Errors: usage.
[[nodiscard]] Result<void> checkRequest(const Rule& rule, bool hasBaseline, const TargetSet& targets,
                                        const VerifyRequest& request);

}  // namespace umbrage::rules::detail

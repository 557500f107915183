#pragma once

#include <span>
#include <vector>

#include "umbrage/study/sun_course.hpp"

namespace umbrage::rules::detail {

/// Stretches of time: ascending and apart from each other.
using Spans = std::vector<study::TimeSpan>;

/// The times of both.
[[nodiscard]] Spans both(std::span<const study::TimeSpan> a, std::span<const study::TimeSpan> b);
/// The times of `a` that are not of `b`.
[[nodiscard]] Spans without(std::span<const study::TimeSpan> a, std::span<const study::TimeSpan> b);
/// The times of any, given in any order.
[[nodiscard]] Spans joined(Spans spans);
[[nodiscard]] std::chrono::milliseconds total(std::span<const study::TimeSpan> spans);
[[nodiscard]] std::chrono::milliseconds longest(std::span<const study::TimeSpan> spans);
/// Without those shorter than `least`.
[[nodiscard]] Spans atLeast(Spans spans, std::chrono::milliseconds least);

[[nodiscard]] inline double hoursOf(std::chrono::milliseconds time) { return double(time.count()) / 3.6e6; }

}  // namespace umbrage::rules::detail

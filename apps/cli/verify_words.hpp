#pragma once

#include <string>
#include <string_view>

#include "verify_output.hpp"

// How the outputs of `verify` put things.
namespace umbrage::cli {

/// What the clock asked for shows, to the second.
[[nodiscard]] std::string clockOf(const VerdictReport& report, sun::Instant instant);
/// "09:00:00-10:30:00;...".
[[nodiscard]] std::string spansText(const VerdictReport& report, const std::vector<study::TimeSpan>& spans);
/// "1:05:30", with a sign where `sign` asks for it.
[[nodiscard]] std::string duration(double hours, bool sign = false);
/// "of sun".
[[nodiscard]] const char* quantity(const rules::Measure& measure);
/// "at least".
[[nodiscard]] const char* comparison(const rules::Measure& measure);

/// "85002.7,447466.12,1.933": to the millimetre, so that no two receivers read alike, and without zeros at the end.
[[nodiscard]] std::string positionText(const VerdictReport& report, const Vec3& position, std::string_view separator);
/// Whose sun a share of new shadow is of: "the year's sun", "the sun of 2026-03-21", "the sun of 49 days".
[[nodiscard]] std::string sunOfDays(const VerdictReport& report, const rules::Measure& measure);
/// Hours of new shadow, summed over receivers: "12.5 m2 h" on areas, "1:30:00 in all" of points.
[[nodiscard]] std::string newShadowText(const VerdictReport& report, double hours);

[[nodiscard]] const rules::Requirement& requirementOf(const VerdictReport& report, const rules::Finding& finding);
/// That of rules::decidingOf.
[[nodiscard]] const rules::Measure& decidingMeasure(const rules::Verdict& verdict);
/// A share with one digit, or as many as tell it from none and from all: "99.97 %".
[[nodiscard]] std::string percent(double share);
/// How many points on lines around a site fail: they have no area, so that no share tells of them. Empty where none does.
[[nodiscard]] std::string failingLines(const VerdictReport& r, const rules::Finding& f);
/// A share of new shadow; one that rounds to nothing and is not has more digits.
[[nodiscard]] std::string newShareText(double share);
/// The new shadow that no middle of a cell sees. REQUIRES: the finding has `outlines`.
[[nodiscard]] std::string outlinesText(const VerdictReport& r, const rules::Finding& f);
[[nodiscard]] const Vec3& placeOf(const VerdictReport& report, const rules::ReceiverResult& result);

}  // namespace umbrage::cli

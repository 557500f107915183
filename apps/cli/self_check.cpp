#include "self_check.hpp"

#include <fmt/format.h>

#include "umbrage/study/hours_check.hpp"
#include "umbrage/study/ledger.hpp"
#include "umbrage/sun/self_check.hpp"
#include "umbrage/sun/zone.hpp"

namespace umbrage::cli {
namespace {

std::string whereWorst(const sun::Deviation& d) {
  const auto utc = sun::clockAt(sun::Zone{}, d.place, d.instant).clock;
  return fmt::format("{}, {} {} UTC", study::placeText(d.place), sun::dateText(utc.date), sun::timeText(utc.time));
}

// A line of the table: `bound` in the figures' own unit.
std::string line(const char* what, const sun::Deviation& d, double bound, const char* unit) {
  return fmt::format("  {:<22}{:>6}  {:>10.6f}  {:>10.6f}  {:>8} {:<8} {}\n", what, d.count, d.mean(), d.worst, bound,
                     unit, whereWorst(d));
}

std::string sunText(const sun::SelfCheck& check) {
  return line("direction", check.direction, sun::kDirectionBound, "degrees") +
         line("with refraction", check.refraction, sun::kRefractionBound, "degrees") +
         line("noon", check.noon, sun::kCrossingBound, "seconds") +
         line("sunrise, sunset", check.riseAndSet, sun::kCrossingBound, "seconds");
}

std::string hoursText(const study::HoursCheck& check) {
  return line("shadow comes or goes", check.changes, study::kChangeBound, "seconds") +
         fmt::format("At {} moments about {} triangles in sun or shadow by ERFA's sun: {} answered otherwise.\n",
                     check.moments, check.triangles, check.wrong);
}

}  // namespace

Result<Outcome> selfCheck(const std::string&) {
  const sun::SelfCheck sun = sun::selfCheck();
  const auto hours = study::checkHours();
  if (!hours) return tl::unexpected(hours.error());
  const bool right = sun::holds(sun) && study::holds(*hours);
  std::string text = fmt::format(
      "This program against {} by another road (apco13, atioq: an observer on the ellipsoid), 1972 to 2050\n\n",
      sun::versions({}));
  text += fmt::format("  {:<22}{:>6}  {:>10}  {:>10}  {:>8} {:<8} {}\n", "", "count", "mean", "worst", "at most", "",
                      "worst at");
  text += sunText(sun) + hoursText(*hours);
  text +=
      fmt::format("Not in this: the Earth turns up to 0.9 s ahead of clocks or behind (UT1 - UTC), {:.4f} degrees.\n\n",
                  sun.universalTime.worst);
  return Outcome{text + (right ? "All of it holds." : "It does NOT hold: please report this with the lines above."),
                 right ? 0 : 1};
}

}  // namespace umbrage::cli

#include <algorithm>
#include <cmath>
#include <limits>

#include "umbrage/rules/detail/judge.hpp"

// How far shadow matters to a rule: where even shadow at every moment at which it is long enough would turn nothing.
namespace umbrage::rules {
namespace {

constexpr std::chrono::minutes kStep{1};
constexpr double kLeastHeight = 1e-6;  // of the sun: at the horizon shadows have no end
constexpr double kEverywhere = std::numeric_limits<double>::infinity();

// A stretch of a day, and the longest shadow in it of what is 1 m high.
struct Piece {
  study::TimeSpan span;
  double length = 0.0;
};

std::vector<Piece> piecesOf(const detail::Day& day) {
  const auto lengthAt = [&](sun::Instant t) {
    const Vec3 s = day.course.towards(t);
    return std::hypot(s.x, s.y) / std::max(s.z, kLeastHeight);
  };
  std::vector<Piece> pieces;
  for (const study::TimeSpan& span : day.counting)
    for (auto from = span.from; from < span.to; from += kStep) {
      const auto to = std::min<sun::Instant>(from + kStep, span.to);
      pieces.push_back({{from, to}, std::max(lengthAt(from), lengthAt(to - std::chrono::milliseconds(1)))});
    }
  return pieces;
}

// Does the measure hold so far off (in heights of what casts) whatever casts there?
bool holdsAt(double distance, const Measure& measure, const detail::Day& day, const std::vector<Piece>& pieces) {
  detail::Spans lit;
  for (const Piece& piece : pieces)
    if (piece.length < distance) lit.push_back(piece.span);
  return detail::holds(measure, day.counting, detail::joined(std::move(lit)), day.counting);
}

// On one day, in heights of what casts.
double reachOn(const Measure& measure, std::chrono::year_month_day date, const detail::Conventions& conventions) {
  const auto day = detail::dayOf(measure, date, conventions);
  if (!day) return detail::holds(measure, {}, {}, {}) ? 0.0 : kEverywhere;
  const std::vector<Piece> pieces = piecesOf(*day);
  std::vector<double> lengths{0.0};
  for (const Piece& piece : pieces) lengths.push_back(piece.length);
  std::sort(lengths.begin(), lengths.end());
  // Just beyond a length, the pieces of that length are lit.
  const auto beyond = [](double length) { return std::nextafter(length, kEverywhere); };
  const auto end = std::partition_point(lengths.begin(), lengths.end(),
                                        [&](double length) { return !holdsAt(beyond(length), measure, *day, pieces); });
  return end == lengths.end() ? kEverywhere : *end;
}

double reachOf(const Measure& measure, const detail::Conventions& conventions) {
  const auto dates = detail::datesOf(measure.days, conventions.calendar);
  double least = kEverywhere, most = 0.0;
  for (const auto& date : dates) {
    const double reach = reachOn(measure, date, conventions);
    least = std::min(least, reach), most = std::max(most, reach);
  }
  return measure.days.best ? least : most;
}

double reachOf(const Requirement& requirement, double above, const detail::Conventions& conventions) {
  const double end = requirement.band ? requirement.band->to.value_or(kEverywhere) : kEverywhere;
  // Of shares all of the band is the whole.
  if (requirement.mostNew || requirement.share < 1.0) return std::isinf(end) ? 0.0 : end;
  double reach = kEverywhere;
  for (const Measure& measure : requirement.anyOf) reach = std::min(reach, reachOf(measure, conventions));
  // Where not even the open sky is enough, any receiver says so.
  return std::isinf(reach) ? 0.0 : std::min(above * reach, end);
}

}  // namespace

double shadowReach(double above, const Rule& rule, const VerifyRequest& request) {
  const detail::Conventions conventions = detail::conventionsOf(rule, request);
  double reach = 0.0;
  for (const Requirement& requirement : rule.requirements)
    reach = std::max(reach, reachOf(requirement, std::max(0.0, above), conventions));
  return reach;
}

}  // namespace umbrage::rules

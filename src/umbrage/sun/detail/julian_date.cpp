#include "umbrage/sun/detail/julian_date.hpp"

#include <erfa.h>

namespace umbrage::sun::detail {
namespace {

constexpr double kUnixEpoch = 2440587.5;  // Julian date of 1970-01-01
constexpr double kTtMinusTai = 32.184;    // seconds

}  // namespace

JulianDate julianDate(Instant instant) {
  const auto day = std::chrono::floor<std::chrono::days>(instant);
  return {kUnixEpoch + double(day.time_since_epoch().count()), double((instant - day).count()) / kMillisecondsPerDay};
}

double ttMinusUtc(Instant instant) {
  const auto day = std::chrono::floor<std::chrono::days>(instant);
  const std::chrono::year_month_day date(day);
  double taiMinusUtc = 0.0;  // stays 0 before 1960, where the table begins
  eraDat(int(date.year()), int(unsigned(date.month())), int(unsigned(date.day())), 0.0, &taiMinusUtc);
  return kTtMinusTai + taiMinusUtc;
}

}  // namespace umbrage::sun::detail

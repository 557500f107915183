#include <algorithm>

#include "umbrage/study/exact_hours.hpp"

namespace umbrage::study {

using std::chrono::milliseconds;

milliseconds SunHours::total(std::size_t receiver) const {
  milliseconds sum{0};
  for (const TimeSpan& s : lit(receiver)) sum += s.length();
  return sum;
}

milliseconds SunHours::longest(std::size_t receiver) const {
  milliseconds most{0};
  for (const TimeSpan& s : lit(receiver)) most = std::max(most, s.length());
  return most;
}

SunHours::Runs SunHours::runs(std::size_t receiver, milliseconds least) const {
  Runs runs;
  for (const TimeSpan& s : lit(receiver))
    if (s.length() >= least) ++runs.count, runs.total += s.length();
  return runs;
}

}  // namespace umbrage::study

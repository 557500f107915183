#pragma once

#include <algorithm>
#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "umbrage/shadow/technique.hpp"

namespace umbrage::shadow {

/// Books wall-clock time on phases, in the order of their first appearance.
class PhaseClock {
 public:
  explicit PhaseClock(std::vector<PhaseTime>& phases) : phases_(phases) {}
  /// Since the last call, or since the clock was made.
  void end(std::string_view phase) {
    const auto now = std::chrono::steady_clock::now();
    const double passed = std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
    const auto known =
        std::find_if(phases_.begin(), phases_.end(), [&](const PhaseTime& p) { return p.name == phase; });
    if (known != phases_.end())
      known->milliseconds += passed;
    else
      phases_.push_back({std::string(phase), passed});
  }

 private:
  std::vector<PhaseTime>& phases_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace umbrage::shadow

#pragma once

#include <string>

#include "console.hpp"

namespace umbrage::cli {

/// Tells how far this program's sun and its times of shadow are from ERFA's by another road; code 1 where that is farther than they promise.
[[nodiscard]] Result<Outcome> selfCheck(const std::string& word);

}  // namespace umbrage::cli

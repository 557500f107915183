#pragma once

#include <vector>

#include "umbrage/png/png.hpp"
#include "umbrage/study/profile.hpp"

namespace umbrage::report::detail {

/// A ledger as the remarks inside a picture, for programs to read what people read beside it.
[[nodiscard]] inline std::vector<png::Text> remarksOf(const std::vector<study::LedgerLine>& ledger) {
  std::vector<png::Text> remarks;
  for (const study::LedgerLine& line : ledger) remarks.push_back({line.subject, line.text});
  return remarks;
}

}  // namespace umbrage::report::detail

#pragma once

#include <optional>

#include "umbrage/cut/detail/borders.hpp"
#include "umbrage/cut/effort.hpp"

namespace umbrage::cut::detail {

/// The tree of one face. `cone`: lines of a spot's pyramid on the face, positive inside, and which side of it is lit.
struct ConeLines {
  std::vector<Vec3> lines;
  bool insideIsLit = true;
};
/// Nothing when the effort is spent.
[[nodiscard]] std::optional<FaceCut> partition(const Casters& casters, const Face& face, Borders borders,
                                               const ConeLines& cone, Effort& effort);

}  // namespace umbrage::cut::detail

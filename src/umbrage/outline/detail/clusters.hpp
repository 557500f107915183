#pragma once

#include <vector>

#include "umbrage/outline/detail/grid.hpp"

namespace umbrage::outline::detail {

/// The extents (by index, empty ones left out) that touch one another, directly or through others.
[[nodiscard]] std::vector<std::vector<std::size_t>> clusters(const std::vector<Extent>& extents);

}  // namespace umbrage::outline::detail

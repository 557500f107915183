#pragma once

#include <cstddef>
#include <optional>

#include "umbrage/shadow/filters.hpp"
#include "umbrage/shadow/veils.hpp"

namespace umbrage::shadow {

/// As Frame::veilLayers: as many as matter, chosen for each picture. What lies behind the last of them is seen through nearer veils that
/// let less than 1/255 of it through in every channel; all before it is exact.
inline constexpr int kVeilLayersThatMatter = -1;

/// How many veils of each pixel, the nearest, are lit each by itself: `asked` as Frame::veilLayers.
/// Without a number: all. Other negative numbers count as 0.
[[nodiscard]] std::size_t litVeilLayers(std::optional<int> asked, const VeilBuffer& veils, const Filters& filters);

}  // namespace umbrage::shadow

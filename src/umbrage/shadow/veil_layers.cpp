#include "umbrage/shadow/veil_layers.hpp"

#include <algorithm>
#include <limits>

namespace umbrage::shadow {
namespace {

constexpr float kUnseen = 1.0f / 255.0f;

/// The least sum of which less than kUnseen is left.
std::int32_t unseenFrom(const Filters& filters) {
  std::int32_t low = 0, high = std::numeric_limits<std::int32_t>::max() / 2;
  while (low < high) {
    const std::int32_t middle = low + (high - low) / 2;
    if (filters.transmitted({middle, middle, middle}).x < kUnseen)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

std::size_t layersThatMatter(const VeilBuffer& veils, const Filters& filters) {
  const std::int32_t unseen = unseenFrom(filters);
  std::size_t most = 0;
  for (std::size_t pixel = 0; pixel + 1 < veils.first.size(); ++pixel) {
    const auto here = veils.at(pixel);
    if (here.size() <= most) continue;
    FilterSum taken{};
    std::size_t layers = 0;
    while (layers < here.size() && std::min({taken[0], taken[1], taken[2]}) < unseen) {
      const FilterSum& filter = filters.of(here[layers++].triangle);
      for (std::size_t k = 0; k < 3; ++k) taken[k] = std::min(taken[k] + filter[k], unseen);
    }
    most = std::max(most, layers);
  }
  return most;
}

}  // namespace

std::size_t litVeilLayers(std::optional<int> asked, const VeilBuffer& veils, const Filters& filters) {
  if (!asked) return ~std::size_t{0};
  if (*asked == kVeilLayersThatMatter) return layersThatMatter(veils, filters);
  return static_cast<std::size_t>(std::max(0, *asked));
}

}  // namespace umbrage::shadow

#pragma once

#include <cstddef>

#include "umbrage/image/image.hpp"

namespace umbrage::image {

/// How two pictures of one size differ. Channel values 0..255.
struct Difference {
  std::size_t pixels = 0;  ///< pixels with any differing channel
  int largest = 0;         ///< largest difference of a channel
  double mean = 0.0;       ///< mean absolute difference over all channels
};

/// REQUIRES: equal sizes.
[[nodiscard]] Difference compare(const GreyImage& a, const GreyImage& b);
[[nodiscard]] Difference compare(const RgbImage& a, const RgbImage& b);

}  // namespace umbrage::image

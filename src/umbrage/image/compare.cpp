#include "umbrage/image/compare.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace umbrage::image {
namespace {

std::array<int, 1> channels(std::uint8_t v) { return {v}; }
std::array<int, 3> channels(Rgb8 v) { return {v.r, v.g, v.b}; }

template <class Pixel>
Difference comparePixels(const Image<Pixel>& a, const Image<Pixel>& b) {
  UMBRAGE_CHECK(a.width() == b.width() && a.height() == b.height(), "pictures of different sizes");
  Difference difference;
  std::size_t sum = 0, count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto left = channels(a.pixels()[i]);
    const auto right = channels(b.pixels()[i]);
    int worst = 0;
    for (std::size_t c = 0; c < left.size(); ++c) {
      const int d = std::abs(left[c] - right[c]);
      worst = std::max(worst, d);
      sum += static_cast<std::size_t>(d);
    }
    count += left.size();
    difference.pixels += worst > 0;
    difference.largest = std::max(difference.largest, worst);
  }
  difference.mean = count > 0 ? static_cast<double>(sum) / static_cast<double>(count) : 0.0;
  return difference;
}

}  // namespace

Difference compare(const GreyImage& a, const GreyImage& b) { return comparePixels(a, b); }
Difference compare(const RgbImage& a, const RgbImage& b) { return comparePixels(a, b); }

}  // namespace umbrage::image

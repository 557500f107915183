#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstdint>
#include <vector>

#include "umbrage/shadow/facing.hpp"
#include "umbrage/shadow/surface_buffer.hpp"

namespace umbrage::techniques::detail {

/// Whether the visible side of a triangle faces the light, asked only for triangles that are seen, and once.
class FacingMemo {
 public:
  FacingMemo(const scene::Surfaces& surfaces, const Vec4& eye, const Vec4& light)
      : surfaces_(surfaces), eye_(eye), light_(light), known_(surfaces.triangles.size() + 1, kUnknown) {
    known_.back() = 0;
  }

  [[nodiscard]] bool faces(std::uint32_t triangle) {
    const std::atomic_ref<std::uint8_t> known(known_[triangle]);
    std::uint8_t value = known.load(std::memory_order_relaxed);
    if (value == kUnknown) {
      value = shadow::visibleSideFacesLight(surfaces_, triangle, eye_, light_) ? 1 : 0;
      known.store(value, std::memory_order_relaxed);  // whoever else asks comes to the same
    }
    return value != 0;
  }
  /// 0, 1, or kUnknown when nobody has asked yet; of shadow::kNoTriangle 0.
  [[nodiscard]] std::uint8_t known(std::uint32_t triangle) {
    const std::size_t i = std::min<std::size_t>(triangle, known_.size() - 1);
    return std::atomic_ref<std::uint8_t>(known_[i]).load(std::memory_order_relaxed);
  }
  static constexpr std::uint8_t kUnknown = 2;

 private:
  const scene::Surfaces& surfaces_;
  Vec4 eye_, light_;
  std::vector<std::uint8_t> known_;
};

/// The pixels of a block whose surfaces face the light, a bit each.
[[nodiscard]] inline std::uint64_t receiversOf(const std::array<std::uint32_t, 64>& triangle, FacingMemo& facing) {
  std::uint64_t bits = 0, unknown = 0;
  for (std::size_t k = 0; k < triangle.size(); ++k) {
    const std::uint64_t value = facing.known(triangle[k]);
    bits |= (value & 1) << k, unknown |= (value >> 1) << k;
  }
  for (; unknown != 0; unknown &= unknown - 1) {
    const int k = std::countr_zero(unknown);
    bits |= std::uint64_t{facing.faces(triangle[static_cast<std::size_t>(k)])} << k;
  }
  return bits;
}

}  // namespace umbrage::techniques::detail

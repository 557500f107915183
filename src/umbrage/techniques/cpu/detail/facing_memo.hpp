#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "umbrage/shadow/facing.hpp"
#include "umbrage/shadow/surface_buffer.hpp"

namespace umbrage::techniques::detail {

/// Whether the visible side of a triangle faces the light, asked only for triangles that are seen, and once.
class FacingMemo {
 public:
  FacingMemo(const scene::Surfaces& surfaces, const Vec4& eye, const Vec4& light)
      : surfaces_(surfaces), eye_(eye), light_(light), known_(surfaces.triangles.size(), kUnknown) {}

  [[nodiscard]] bool faces(std::uint32_t triangle) {
    const std::atomic_ref<std::uint8_t> known(known_[triangle]);
    std::uint8_t value = known.load(std::memory_order_relaxed);
    if (value == kUnknown) {
      value = shadow::visibleSideFacesLight(surfaces_, triangle, eye_, light_) ? 1 : 0;
      known.store(value, std::memory_order_relaxed);  // whoever else asks comes to the same
    }
    return value != 0;
  }

 private:
  static constexpr std::uint8_t kUnknown = 2;
  const scene::Surfaces& surfaces_;
  Vec4 eye_, light_;
  std::vector<std::uint8_t> known_;
};

/// The pixels of a block whose surfaces face the light, a bit each.
[[nodiscard]] inline std::uint64_t receiversOf(const std::array<std::uint32_t, 64>& triangle, FacingMemo& facing) {
  std::uint64_t bits = 0;
  std::uint32_t last = shadow::kNoTriangle;
  bool faces = false;
  for (std::size_t k = 0; k < triangle.size(); ++k) {
    if (triangle[k] != last) last = triangle[k], faces = last != shadow::kNoTriangle && facing.faces(last);
    bits |= std::uint64_t{faces} << k;
  }
  return bits;
}

}  // namespace umbrage::techniques::detail

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "umbrage/math/box.hpp"
#include "umbrage/study/exact_hours.hpp"

namespace umbrage::study::detail {

/// Receivers that lie near each other and face about one way, a few at a time, and groups near each other in turn.
class Groups {
 public:
  Groups(std::vector<std::uint32_t> order, std::vector<std::uint32_t> begin)
      : order_(std::move(order)), begin_(std::move(begin)) {}
  [[nodiscard]] std::size_t size() const { return begin_.size() - 1; }
  [[nodiscard]] std::span<const std::uint32_t> members(std::size_t group) const {
    return std::span(order_).subspan(begin_[group], begin_[group + 1] - begin_[group]);
  }

 private:
  std::vector<std::uint32_t> order_, begin_;
};

/// `size`: about the size of the things that cast; a group is no larger.
[[nodiscard]] Groups makeGroups(std::span<const Receiver> receivers, double size);

/// Finds boxes near a point.
class SolidBoxes {
 public:
  SolidBoxes() = default;
  explicit SolidBoxes(std::vector<Box3> boxes);
  /// Appends those that meet the box from `low` to `high`.
  void find(const Vec3& low, const Vec3& high, std::vector<std::int32_t>& out) const;

 private:
  [[nodiscard]] bool meets(std::int32_t box, const Vec3& low, const Vec3& high) const;
  [[nodiscard]] std::size_t cellOf(double v, int axis) const;
  std::vector<Box3> boxes_;
  Box3 all_;
  std::size_t across_[3] = {0, 0, 0};  ///< cells along each axis
  std::vector<std::uint32_t> cellBegin_;
  std::vector<std::int32_t> inCells_, large_;
};

}  // namespace umbrage::study::detail

#include "umbrage/study/detail/hours_groups.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "umbrage/study/detail/hours_tree.hpp"

namespace umbrage::study::detail {
namespace {

// Every third bit, for 21 bits.
std::uint64_t spread(std::uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffffull;
  x = (x | x << 16) & 0x1f0000ff0000ffull;
  x = (x | x << 8) & 0x100f00f00f00f00full;
  x = (x | x << 4) & 0x10c30c30c30c30c3ull;
  return (x | x << 2) & 0x1249249249249249ull;
}

std::uint64_t zOrder(const Vec3& p, const Vec3& low, double cell) {
  std::uint64_t code = 0;
  for (int k = 0; k < 3; ++k)
    code |= spread(static_cast<std::uint64_t>(std::clamp((p[k] - low[k]) / cell, 0.0, 2097151.0))) << k;
  return code;
}

// Normals alike to 18 bits count as one: what the corners of one wall's triangles make of it.
constexpr double kFine = 0x1p-18;
// Those of a smooth surface may be so far apart in one group,
constexpr double kMostSpread = 0.35;
// and its points this far off each other's planes, of their distance: walls of different houses are not one surface.
constexpr double kMostBend = 0.5;
// Groups of so few points are put together anew, as parts of smooth surfaces.
constexpr std::uint32_t kFew = 2;

std::uint64_t normalKey(const Vec3& n, double step) {
  std::uint64_t key = 0;
  const double length = glm::length(n);
  if (!(length > 0.0)) return key;
  for (int k = 0; k < 3; ++k) key = key << 20 | static_cast<std::uint64_t>((n[k] / length + 1.25) / step);
  return key;
}

bool areSmooth(const Receiver& a, const Receiver& b) {
  const double x = glm::length(a.normal), y = glm::length(b.normal);
  if (!(x > 0.0 && y > 0.0) || glm::distance(a.normal / x, b.normal / y) > kMostSpread) return false;
  const Vec3 way = b.position - a.position;
  return std::abs(glm::dot(a.normal / x, way)) <= kMostBend * glm::length(way);
}

// Coarse place, normal, place within: 24, 20 and 20 bits.
struct Key {
  std::uint64_t order;
  std::uint32_t receiver;
  bool operator<(const Key& o) const { return order != o.order ? order < o.order : receiver < o.receiver; }
};

// Puts receivers in the order of coarse places, within these of normals, within these of fine places.
class Sorting {
 public:
  Sorting(std::span<const Receiver> receivers, double size) : receivers_(receivers) {
    Box3 box;
    for (const Receiver& r : receivers) box.add(r.position);
    const Vec3 extent = box.size();
    const double widest = std::max({extent.x, extent.y, extent.z, 1e-300});
    low_ = box.min;
    coarse_ = std::max(size > 0.0 ? 8.0 * size : widest, widest / 255.0);
  }

  void sort(std::span<Key> keys, double normalStep) const {
    std::uint64_t normal = 0;
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const Receiver& r = receivers_[keys[i].receiver];
      if (i == 0 || r.normal != receivers_[keys[i - 1].receiver].normal) normal = normalKey(r.normal, normalStep);
      const std::uint64_t hash = normal * 0x9e3779b97f4a7c15ull >> 44;
      keys[i].order = zOrder(r.position, low_, coarse_) << 40 | hash << 20 |
                      (zOrder(r.position, low_, coarse_ / 64.0) & 0x3ffff) << 2;
    }
    std::sort(keys.begin(), keys.end());
  }

  static bool sameCoarsePlace(const Key& a, const Key& b) { return a.order >> 40 == b.order >> 40; }

 private:
  std::span<const Receiver> receivers_;
  Vec3 low_{0.0};
  double coarse_ = 0.0;
};

// Cuts what is in order into groups of at most kGroup, no wider than `size`, of which all belong with the first.
template <class Belong, class Take>
void cut(std::span<const Receiver> receivers, std::span<const Key> keys, double size, const Belong& belong,
         const Take& take) {
  std::size_t begin = 0;
  Box3 group;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Receiver &r = receivers[keys[i].receiver], &first = receivers[keys[begin].receiver];
    Box3 grown = group;
    grown.add(r.position);
    const Vec3 s = grown.size();
    if (i > begin && (i - begin == std::size_t{kGroup} || std::max({s.x, s.y, s.z}) > size || !belong(first, r))) {
      take(keys.subspan(begin, i - begin));
      begin = i;
      grown = {};
      grown.add(r.position);
    }
    group = grown;
  }
  if (!keys.empty()) take(keys.subspan(begin));
}

}  // namespace

Groups makeGroups(std::span<const Receiver> receivers, double size) {
  std::vector<Key> keys(receivers.size()), few;
  for (std::uint32_t i = 0; i < keys.size(); ++i) keys[i].receiver = i;
  const Sorting sorting(receivers, size);
  sorting.sort(keys, kFine);
  std::vector<std::uint32_t> members, begins{0};
  const auto add = [&](std::span<const Key> group) {
    for (const Key& k : group) members.push_back(k.receiver);
    begins.push_back(static_cast<std::uint32_t>(members.size()));
  };
  const auto oneWay = [](const Receiver& a, const Receiver& b) { return a.normal == b.normal; };
  const auto smooth = [&](const Receiver& a, const Receiver& b) { return oneWay(a, b) || areSmooth(a, b); };
  // Place by place, so that what is asked about stays in the processor's cache.
  for (std::size_t begin = 0; begin < keys.size();) {
    std::size_t end = begin;
    while (end < keys.size() && Sorting::sameCoarsePlace(keys[begin], keys[end])) ++end;
    few.clear();
    cut(receivers, std::span(keys).subspan(begin, end - begin), size, oneWay, [&](std::span<const Key> group) {
      if (group.size() > kFew)
        add(group);
      else
        few.insert(few.end(), group.begin(), group.end());
    });
    sorting.sort(few, kMostSpread);
    cut(receivers, std::span<const Key>(few), size, smooth, add);
    begin = end;
  }
  return {std::move(members), std::move(begins)};
}

SolidBoxes::SolidBoxes(std::vector<Box3> boxes) : boxes_(std::move(boxes)) {
  if (boxes_.empty()) return;
  for (const Box3& b : boxes_) all_.add(b);
  // About two cells a box, of about equal sides.
  const Vec3 size = glm::max(all_.size(), Vec3(1e-9));
  const double side = std::cbrt(size.x * size.y * size.z / (2.0 * double(boxes_.size())));
  for (int k = 0; k < 3; ++k) across_[k] = static_cast<std::size_t>(std::clamp(size[k] / side, 1.0, 256.0));
  constexpr std::size_t kLarge = 64;
  std::vector<std::vector<std::int32_t>> cells(across_[0] * across_[1] * across_[2]);
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    std::size_t low[3], high[3], count = 1;
    for (int k = 0; k < 3; ++k) {
      low[k] = cellOf(boxes_[i].min[k], k), high[k] = cellOf(boxes_[i].max[k], k);
      count *= high[k] - low[k] + 1;
    }
    if (count > kLarge) {
      large_.push_back(static_cast<std::int32_t>(i));
      continue;
    }
    for (std::size_t x = low[0]; x <= high[0]; ++x)
      for (std::size_t y = low[1]; y <= high[1]; ++y)
        for (std::size_t z = low[2]; z <= high[2]; ++z)
          cells[(x * across_[1] + y) * across_[2] + z].push_back(static_cast<std::int32_t>(i));
  }
  cellBegin_.push_back(0);
  for (const auto& cell : cells) {
    inCells_.insert(inCells_.end(), cell.begin(), cell.end());
    cellBegin_.push_back(static_cast<std::uint32_t>(inCells_.size()));
  }
}

std::size_t SolidBoxes::cellOf(double v, int axis) const {
  const double width = all_.max[axis] - all_.min[axis];
  if (!(width > 0.0)) return 0;
  return static_cast<std::size_t>(
      std::clamp((v - all_.min[axis]) / width * double(across_[axis]), 0.0, double(across_[axis]) - 1.0));
}

bool SolidBoxes::meets(std::int32_t box, const Vec3& low, const Vec3& high) const {
  const Box3& b = boxes_[static_cast<std::size_t>(box)];
  return low.x <= b.max.x && low.y <= b.max.y && low.z <= b.max.z && high.x >= b.min.x && high.y >= b.min.y &&
         high.z >= b.min.z;
}

void SolidBoxes::find(const Vec3& low, const Vec3& high, std::vector<std::int32_t>& out) const {
  if (boxes_.empty()) return;
  for (const std::int32_t i : large_)
    if (meets(i, low, high)) out.push_back(i);
  std::size_t first[3], last[3];
  for (int k = 0; k < 3; ++k) {
    if (high[k] < all_.min[k] || low[k] > all_.max[k]) return;
    first[k] = cellOf(low[k], k), last[k] = cellOf(high[k], k);
  }
  for (std::size_t x = first[0]; x <= last[0]; ++x)
    for (std::size_t y = first[1]; y <= last[1]; ++y)
      for (std::size_t z = first[2]; z <= last[2]; ++z) {
        const std::size_t cell = (x * across_[1] + y) * across_[2] + z;
        for (std::uint32_t i = cellBegin_[cell]; i < cellBegin_[cell + 1]; ++i)
          if (meets(inCells_[i], low, high) && std::find(out.begin(), out.end(), inCells_[i]) == out.end())
            out.push_back(inCells_[i]);
      }
}

}  // namespace umbrage::study::detail

#include "umbrage/cut/detail/box_tree.hpp"

#include <algorithm>
#include <numeric>

namespace umbrage::cut::detail {
namespace {

constexpr std::uint32_t kFew = 4;

int longestAxis(const Vec3& size) {
  if (size.x >= size.y && size.x >= size.z) return 0;
  return size.y >= size.z ? 1 : 2;
}

}  // namespace

BoxTree::BoxTree(const std::vector<Box3>& boxes) : items_(boxes.size()) {
  if (boxes.empty()) return;
  std::iota(items_.begin(), items_.end(), 0u);
  nodes_.reserve(boxes.size());
  nodes_.push_back({{}, 0, static_cast<std::uint32_t>(boxes.size())});
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const std::uint32_t first = nodes_[n].first, count = nodes_[n].count;
    Box3 box, centres;
    for (std::uint32_t i = first; i < first + count; ++i) {
      box.add(boxes[items_[i]]);
      centres.add(boxes[items_[i]].centre());
    }
    nodes_[n].box = box;
    if (count <= kFew) continue;
    const int axis = longestAxis(centres.size());
    const std::uint32_t half = count / 2;
    const auto begin = items_.begin() + first;
    std::nth_element(begin, begin + half, begin + count, [&](std::uint32_t a, std::uint32_t b) {
      return boxes[a].centre()[axis] < boxes[b].centre()[axis];
    });
    nodes_[n].first = static_cast<std::uint32_t>(nodes_.size());
    nodes_[n].count = 0;
    nodes_.push_back({{}, first, half});
    nodes_.push_back({{}, first + half, count - half});
  }
}

}  // namespace umbrage::cut::detail

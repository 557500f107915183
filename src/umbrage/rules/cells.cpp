#include "umbrage/rules/cells.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include "umbrage/outline/combine.hpp"

namespace umbrage::rules {
namespace {

using outline::Region;

// The middles by row and column, counted from the first of them.
class Cells {
 public:
  Cells(std::span<const CellMiddle> middles, double step) : origin_(middles.front().at), step_(step) {
    for (const CellMiddle& middle : middles) cells_[placeOf(middle.at)] = middle.wanted;
  }

  // Rectangles of neighbours in a row, as long as they are.
  template <class Fn>
  [[nodiscard]] Region runs(Fn&& isTaken) const {
    std::vector<Region> rectangles;
    for (auto cell = cells_.begin(); cell != cells_.end();) {
      const Place first = cell->first;
      std::int64_t length = 0;
      for (; cell != cells_.end() && cell->first == Place(first.first, first.second + length) && isTaken(cell->second);
           ++cell)
        ++length;
      if (length == 0)
        ++cell;
      else
        rectangles.push_back(run(first, length));
    }
    return outline::together(rectangles);
  }

  [[nodiscard]] bool isNearestWanted(const Vec2& p) const {
    const Place at = placeOf(p);
    constexpr std::int64_t kAround = 3;
    double least = std::numeric_limits<double>::infinity();
    bool wanted = false;
    const auto look = [&](const auto& cell) {
      const double distance = glm::length(middleOf(cell.first) - p);
      if (distance < least) least = distance, wanted = cell.second;
    };
    for (std::int64_t row = at.first - kAround; row <= at.first + kAround; ++row)
      for (auto cell = cells_.lower_bound({row, at.second - kAround});
           cell != cells_.end() && cell->first <= Place(row, at.second + kAround); ++cell)
        look(*cell);
    if (std::isinf(least)) std::for_each(cells_.begin(), cells_.end(), look);
    return wanted;
  }

 private:
  using Place = std::pair<std::int64_t, std::int64_t>;
  [[nodiscard]] Place placeOf(const Vec2& p) const {
    const Vec2 at = (p - origin_) / step_;
    return {std::llround(at.y), std::llround(at.x)};
  }
  [[nodiscard]] Vec2 middleOf(const Place& place) const {
    return origin_ + step_ * Vec2(double(place.second), double(place.first));
  }
  [[nodiscard]] Region run(const Place& first, std::int64_t length) const {
    const Vec2 a = middleOf(first) - 0.5 * step_, b = a + step_ * Vec2(double(length), 1.0);
    Region region;
    region.polygons.push_back({{a, {b.x, a.y}, b, {a.x, b.y}}, {}});
    region.area = (b.x - a.x) * (b.y - a.y);
    return region;
  }

  Vec2 origin_;
  double step_;
  std::map<Place, bool> cells_;
};

Vec2 middleOf(const outline::Ring& ring) {
  Vec2 sum(0.0);
  for (const Vec2& p : ring) sum += p;
  return sum / double(ring.size());
}

}  // namespace

Region cellsOf(std::span<const CellMiddle> middles, double step) {
  if (middles.empty()) return {};
  return Cells(middles, step).runs([](bool wanted) { return wanted; });
}

Region cellsWithin(const Region& region, std::span<const CellMiddle> middles, double step) {
  const auto count = std::ranges::count_if(middles, &CellMiddle::wanted);
  if (count == 0) return {};
  if (count == std::ssize(middles)) return region;
  const Cells cells(middles, step);
  std::vector<Region> parts{outline::common(region, cells.runs([](bool wanted) { return wanted; }))};
  const Region rest = outline::without(region, cells.runs([](bool) { return true; }));
  for (const outline::Polygon& polygon : rest.polygons) {
    if (!cells.isNearestWanted(middleOf(polygon.outer))) continue;
    parts.push_back({{polygon}, outline::areaOf(polygon)});
  }
  return outline::together(parts);
}

}  // namespace umbrage::rules

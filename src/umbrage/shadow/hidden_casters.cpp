#include "umbrage/shadow/hidden_casters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "umbrage/base/check.hpp"

namespace umbrage::shadow {
namespace {

constexpr int kCells = 128;  // of the grid of directions, a side
// Corners times faces of one test; what is larger is not asked.
constexpr std::size_t kLargestTest = 1'000'000;

// Lists of numbers by component, in one array.
struct Lists {
  std::vector<std::uint32_t> begin, items;
  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t c) const {
    return std::span(items).subspan(begin[c], begin[c + 1] - begin[c]);
  }
};

Lists listByComponent(const std::vector<std::uint32_t>& component, std::size_t count) {
  Lists lists;
  lists.begin.assign(count + 1, 0);
  for (const std::uint32_t c : component)
    if (c != kNoComponent) ++lists.begin[c + 1];
  for (std::size_t c = 0; c < count; ++c) lists.begin[c + 1] += lists.begin[c];
  lists.items.resize(lists.begin[count]);
  std::vector<std::uint32_t> next = lists.begin;
  for (std::uint32_t i = 0; i < component.size(); ++i)
    if (component[i] != kNoComponent) lists.items[next[component[i]]++] = i;
  return lists;
}

// A place in the picture that the light sees, and the distance to it. The mapping matters for speed only.
struct Sight {
  Vec2 at;
  double distance;
};

class LightPicture {
 public:
  LightPicture(const Vec4& light, const Vec3& middle) : light_(light) {
    const Vec3 view = middle * light.w - Vec3(light);
    if (glm::length(view) > 0.0) forward_ = glm::normalize(view);
    const Vec3 d = glm::abs(forward_);
    right_ = glm::normalize(glm::cross(forward_, d.x < d.y ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
    up_ = glm::cross(right_, forward_);
  }

  [[nodiscard]] Sight see(const Vec3& p) const {
    if (light_.w == 0.0) return {{glm::dot(p, right_), glm::dot(p, up_)}, glm::dot(p, forward_)};
    // The octahedron around the light, unfolded on the side that it turns away from the casters.
    const Vec3 away = p * light_.w - Vec3(light_);
    const Vec3 d(glm::dot(away, right_), glm::dot(away, up_), glm::dot(away, forward_)), a = glm::abs(d);
    const double sum = a.x + a.y + a.z;
    if (!(sum > 0.0)) return {Vec2(0.0), 0.0};
    const auto sign = [](double v) { return v < 0.0 ? -1.0 : 1.0; };
    const Vec2 front = Vec2(d.x, d.y) / sum;
    const Vec2 at = d.z >= 0.0 ? front : Vec2((1.0 - a.y / sum) * sign(d.x), (1.0 - a.x / sum) * sign(d.y));
    return {at, glm::length(d)};
  }

 private:
  Vec4 light_;
  Vec3 forward_{0.0, 0.0, 1.0}, right_{0.0}, up_{0.0};
};

// What of the picture the corners of a component take up.
struct Outline {
  Vec2 min{std::numeric_limits<double>::infinity()}, max{-std::numeric_limits<double>::infinity()};
  double nearest = std::numeric_limits<double>::infinity();

  void add(const Sight& s) {
    min = glm::min(min, s.at);
    max = glm::max(max, s.at);
    nearest = std::min(nearest, s.distance);
  }
  [[nodiscard]] bool mayHide(const Outline& o) const {
    return min.x <= o.min.x && min.y <= o.min.y && max.x >= o.max.x && max.y >= o.max.y && nearest < o.nearest;
  }
};

// x inside: normal . x <= level.
struct HalfSpace {
  Vec3 normal;
  double level;
};

constexpr HalfSpace kNothing{Vec3(0.0), -1.0};

// A convex solid made smaller by what rounding may have done to its corners, so that all of it is inside the mesh; nothing at all
// when a light is not clearly outside.
std::vector<HalfSpace> insideOf(const CasterSet& casters, std::span<const std::uint32_t> triangles, const Box3& box,
                                const Vec4& light) {
  const Vec3 largest = glm::max(glm::abs(box.min), glm::abs(box.max));
  const double shrink = 32.0 * std::numeric_limits<float>::epsilon() * std::max({largest.x, largest.y, largest.z});
  std::vector<HalfSpace> inside;
  bool lightOutside = light.w == 0.0;
  for (const std::uint32_t t : triangles) {
    const Vec3 a = casters.corner(t, 0);
    const Vec3 normal =
        double(casters.outward[t]) * glm::normalize(glm::cross(casters.corner(t, 1) - a, casters.corner(t, 2) - a));
    inside.push_back({normal, glm::dot(normal, a) - shrink});
    lightOutside = lightOutside || glm::dot(normal, Vec3(light) / light.w - a) > shrink;
  }
  if (!lightOutside) return {kNothing};
  return inside;
}

// Whether the way from p to the light leads through the solid.
bool hides(std::span<const HalfSpace> inside, const Vec3& p, const Vec4& light) {
  const Vec3 way = Vec3(light) - p * light.w;
  double enter = 0.0, leave = std::numeric_limits<double>::infinity();
  for (const HalfSpace& h : inside) {
    const double room = h.level - glm::dot(h.normal, p), speed = glm::dot(h.normal, way);
    if (speed > 0.0)
      leave = std::min(leave, room / speed);
    else if (speed < 0.0)
      enter = std::max(enter, room / speed);
    else if (room < 0.0)
      return false;
    if (!(enter < leave)) return false;
  }
  return light.w == 0.0 || enter < 1.0;
}

// For each cell of the picture the solids that may be seen in it.
class Solids {
 public:
  Solids(std::vector<Outline> outlines, const std::vector<std::uint8_t>& isSolid) : outlines_(std::move(outlines)) {
    for (std::uint32_t c = 0; c < outlines_.size(); ++c) {
      if (outlines_[c].min.x > outlines_[c].max.x) continue;
      all_.add({outlines_[c].min, 0.0});
      all_.add({outlines_[c].max, 0.0});
    }
    cells_.resize(std::size_t{kCells} * kCells);
    for (std::uint32_t c = 0; c < outlines_.size(); ++c) {
      if (isSolid[c] == 0) continue;
      const auto [x0, y0] = cellOf(outlines_[c].min);
      const auto [x1, y1] = cellOf(outlines_[c].max);
      for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) cells_[index(x, y)].push_back(c);
    }
  }

  /// True when test(solid) holds for one that may hide `component`.
  template <class Test>
  [[nodiscard]] bool any(std::uint32_t component, const Test& test) const {
    const Outline& own = outlines_[component];
    const auto [x, y] = cellOf(0.5 * (own.min + own.max));
    for (const std::uint32_t solid : cells_[index(x, y)])
      if (solid != component && outlines_[solid].mayHide(own) && test(solid)) return true;
    return false;
  }

 private:
  [[nodiscard]] static std::size_t index(int x, int y) { return std::size_t(y) * kCells + std::size_t(x); }
  [[nodiscard]] std::pair<int, int> cellOf(const Vec2& at) const {
    const Vec2 share = (at - all_.min) / glm::max(all_.max - all_.min, Vec2(std::numeric_limits<double>::min()));
    const auto cell = [](double s) { return static_cast<int>(std::clamp(s * kCells, 0.0, kCells - 1.0)); };
    return {cell(share.x), cell(share.y)};
  }

  std::vector<Outline> outlines_;
  Outline all_;
  std::vector<std::vector<std::uint32_t>> cells_;
};

}  // namespace

HiddenCasters findHiddenCasters(const CasterSet& casters, const Vec4& light, std::span<const std::uint8_t> skip,
                                std::span<const std::uint8_t> clear) {
  UMBRAGE_CHECK(skip.empty() || skip.size() == casters.componentCount, "one entry a component");
  HiddenCasters hidden;
  hidden.component.assign(casters.componentCount, 0);
  std::vector<std::uint8_t> isSolid(casters.componentCount, 0);
  for (std::size_t t = 0; t < casters.triangles.size(); ++t)
    if (casters.outward[t] != 0) isSolid[casters.componentOf[t]] = 1;
  for (std::size_t c = 0; c < clear.size(); ++c)
    if (clear[c] != 0) isSolid[c] = 0;
  if (casters.componentCount < 2 || std::count(isSolid.begin(), isSolid.end(), 1) == 0) return hidden;

  const Lists triangles = listByComponent(casters.componentOf, casters.componentCount);
  const Lists corners = listByComponent(casters.componentOfPosition, casters.componentCount);
  const LightPicture picture(light, casters.bounds.centre());
  std::vector<Outline> outlines(casters.componentCount);
  for (std::uint32_t i = 0; i < casters.positions.size(); ++i)
    if (const std::uint32_t c = casters.componentOfPosition[i]; c != kNoComponent)
      outlines[c].add(picture.see(casters.position(i)));
  const Solids solids(std::move(outlines), isSolid);

  std::vector<std::vector<HalfSpace>> inside(casters.componentCount);
  for (std::uint32_t c = 0; c < casters.componentCount; ++c) {
    if (!skip.empty() && skip[c] != 0) continue;
    const auto own = corners.of(c);
    const bool found = solids.any(c, [&](std::uint32_t solid) {
      if (own.size() * triangles.of(solid).size() > kLargestTest) return false;
      if (inside[solid].empty())
        inside[solid] = insideOf(casters, triangles.of(solid), casters.componentBounds[solid], light);
      return std::all_of(own.begin(), own.end(),
                         [&](std::uint32_t i) { return hides(inside[solid], casters.position(i), light); });
    });
    hidden.component[c] = found ? 1 : 0;
    hidden.count += found;
  }
  return hidden;
}

Silhouette without(const CasterSet& casters, Silhouette silhouette, std::span<const std::uint8_t> left) {
  UMBRAGE_CHECK(left.size() == casters.componentCount, "one entry a component");
  for (std::size_t t = 0; t < silhouette.side.size(); ++t)
    if (left[casters.componentOf[t]] != 0) silhouette.side[t] = 0;
  std::erase_if(silhouette.edges, [&](const SilhouetteEdge& edge) { return left[edge.component] != 0; });
  return silhouette;
}

}  // namespace umbrage::shadow

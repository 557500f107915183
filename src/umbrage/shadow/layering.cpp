#include "umbrage/shadow/layering.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "umbrage/shadow/light_view.hpp"

namespace umbrage::shadow {
namespace {

// The coarse grid settles most scenes; the fine one looks again only where the coarse one counts too much.
constexpr int kCoarse = 64, kFine = 512;
constexpr std::uint32_t kNobody = ~std::uint32_t{0};

// Counts per cell, over one square of directions. Triangles of one convex solid count once a cell: a ray meets its lit side once.
class Grid {
 public:
  explicit Grid(int resolution) : cells_(resolution), count_(cells_.count(), 0), last_(cells_.count(), kNobody) {}

  /// `solid`: the convex solid the polygon belongs to, or kNobody.
  void add(const GridPolygon& polygon, std::uint32_t solid) {
    cells_.visit(polygon, [&](std::size_t i) {
      if (solid != kNobody && last_[i] == solid) return true;
      last_[i] = solid;
      ++count_[i];
      return true;
    });
  }

  /// Whether no cell would count more than `limit` with this polygon added.
  [[nodiscard]] bool fits(const GridPolygon& polygon, std::uint32_t solid, int limit) const {
    return cells_.visit(polygon,
                        [&](std::size_t i) { return count_[i] < limit || (solid != kNobody && last_[i] == solid); });
  }

  /// Whether the polygon touches a cell that counts more than `limit`.
  [[nodiscard]] bool exceeds(const GridPolygon& polygon, int limit) const {
    return !cells_.visit(polygon, [&](std::size_t i) { return count_[i] <= limit; });
  }

  [[nodiscard]] int largest() const { return *std::max_element(count_.begin(), count_.end()); }
  /// The largest count that does not exceed `limit`.
  [[nodiscard]] int largestWithin(int limit) const {
    int largest = 0;
    for (const int count : count_)
      if (count <= limit) largest = std::max(largest, count);
    return largest;
  }

 private:
  GridCells cells_;
  std::vector<int> count_;
  std::vector<std::uint32_t> last_;
};

// Calls visit(triangle, corners relative to the light, solid) for every counted triangle, solids' triangles in succession.
template <class Visit>
void forEachOfSolids(const CasterSet& casters, const Silhouette& silhouette, const Visit& visit) {
  forEachCounted(casters, silhouette, [&](std::uint32_t t, const std::array<Vec3, 3>& corners) {
    const bool lit = silhouette.side[t] * casters.outward[t] > 0;
    visit(t, corners, lit ? casters.componentOf[t] : kNobody);
  });
}

using Grids = std::vector<Grid>;

template <class View>
Grids countAll(const CasterSet& casters, const Silhouette& silhouette, const View& view) {
  Grids grids(View::kFaces, Grid(kCoarse));
  forEachOfSolids(casters, silhouette, [&](std::uint32_t, const std::array<Vec3, 3>& corners, std::uint32_t solid) {
    view.pieces(corners, [&](int face, const GridPolygon& polygon) { grids[face].add(polygon, solid); });
  });
  return grids;
}

int largest(const Grids& grids) {
  int value = 0;
  for (const Grid& grid : grids) value = std::max(value, grid.largest());
  return value;
}

// Calls fn(triangle, corners, solid) for the counted triangles that touch a coarse cell of more than `limit`.
template <class View, class Fn>
void forEachCrowded(const CasterSet& casters, const Silhouette& silhouette, const View& view, const Grids& coarse,
                    int limit, const Fn& fn) {
  forEachOfSolids(casters, silhouette, [&](std::uint32_t t, const std::array<Vec3, 3>& corners, std::uint32_t solid) {
    bool crowded = false;
    view.pieces(corners, [&](int face, const GridPolygon& p) { crowded = crowded || coarse[face].exceeds(p, limit); });
    if (crowded) fn(t, corners, solid);
  });
}

template <class View>
int boundWith(const CasterSet& casters, const Silhouette& silhouette, int enough) {
  const View view(casters, silhouette, kCoarse);
  const Grids coarse = countAll(casters, silhouette, view);
  if (largest(coarse) <= enough) return largest(coarse);
  const View closer(casters, silhouette, kFine);
  Grids fine(View::kFaces, Grid(kFine));
  forEachCrowded(casters, silhouette, view, coarse, enough,
                 [&](std::uint32_t, const std::array<Vec3, 3>& corners, std::uint32_t solid) {
                   closer.pieces(corners,
                                 [&](int face, const GridPolygon& polygon) { fine[face].add(polygon, solid); });
                 });
  int bound = largest(fine);
  for (const Grid& grid : coarse) bound = std::max(bound, grid.largestWithin(enough));
  return bound;
}

constexpr std::size_t kMostGroups = 256;

// Triangles that touch no crowded cell stay in the first group: where they are, all together are within the limit.
template <class View>
LayerGroups groupWith(const CasterSet& casters, const Silhouette& silhouette, int limit) {
  const View view(casters, silhouette, kCoarse);
  const Grids coarse = countAll(casters, silhouette, view);
  if (largest(coarse) <= limit) return {};
  const View closer(casters, silhouette, kFine);
  std::vector<Grids> groups;
  LayerGroups result;
  result.ofTriangle.assign(casters.triangles.size(), 0);
  const auto place = [&](std::uint32_t t, const std::array<Vec3, 3>& corners, std::uint32_t solid) {
    const auto fits = [&](const Grids& group) {
      bool all = true;
      closer.pieces(corners, [&](int face, const GridPolygon& p) { all = all && group[face].fits(p, solid, limit); });
      return all;
    };
    std::size_t g = 0;
    while (g < groups.size() && g + 1 < kMostGroups && !fits(groups[g])) ++g;
    if (g == groups.size()) groups.emplace_back(View::kFaces, Grid(kFine));
    closer.pieces(corners, [&](int face, const GridPolygon& polygon) { groups[g][face].add(polygon, solid); });
    result.ofTriangle[t] = static_cast<std::uint8_t>(g);
  };
  forEachCrowded(casters, silhouette, view, coarse, limit, place);
  if (groups.size() <= 1) return {};
  result.count = static_cast<int>(groups.size());
  return result;
}

}  // namespace

int layeringBound(const CasterSet& casters, const Silhouette& silhouette, int enough) {
  const auto counted =
      static_cast<int>(std::count_if(silhouette.side.begin(), silhouette.side.end(), [](int s) { return s != 0; }));
  if (counted <= enough) return counted;
  return std::min(counted, silhouette.light.w == 0.0 ? boundWith<ParallelView>(casters, silhouette, enough)
                                                     : boundWith<CubeView>(casters, silhouette, enough));
}

LayerGroups groupLayers(const CasterSet& casters, const Silhouette& silhouette, int limit) {
  return silhouette.light.w == 0.0 ? groupWith<ParallelView>(casters, silhouette, limit)
                                   : groupWith<CubeView>(casters, silhouette, limit);
}

Silhouette restrictTo(const CasterSet& casters, const Silhouette& silhouette, const LayerGroups& groups, int group) {
  if (groups.ofTriangle.empty()) return silhouette;
  std::vector<std::int8_t> side = silhouette.side;
  for (std::size_t t = 0; t < side.size(); ++t)
    if (groups.ofTriangle[t] != group) side[t] = 0;
  return silhouetteOf(casters, silhouette.light, std::move(side));
}

}  // namespace umbrage::shadow

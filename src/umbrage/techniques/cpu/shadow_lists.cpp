#include "umbrage/techniques/cpu/detail/shadow_lists.hpp"

#include <algorithm>
#include <cmath>

namespace umbrage::techniques::detail {
namespace {

using View = std::variant<shadow::ParallelView, shadow::CubeView>;

// A handful of triangles a cell, were they spread evenly over one square.
int resolutionFor(const shadow::CasterSet& casters) {
  constexpr double kPerCell = 4.0;
  return std::clamp(static_cast<int>(std::sqrt(static_cast<double>(casters.triangles.size()) / kPerCell)), 4, 256);
}

View viewOf(const shadow::CasterSet& casters, const shadow::Silhouette& silhouette, int resolution) {
  if (silhouette.light.w == 0.0) return shadow::ParallelView(casters, silhouette, resolution);
  return shadow::CubeView(casters, silhouette, resolution);
}

}  // namespace

ShadowLists::ShadowLists(const shadow::CasterSet& casters, const shadow::Silhouette& silhouette)
    : cells_(resolutionFor(casters)),
      light_(silhouette.light.w != 0.0 ? Vec3(silhouette.light) : Vec3(0.0)),
      view_(viewOf(casters, silhouette, resolutionFor(casters))) {
  std::visit([&](const auto& view) { fill(view, casters, silhouette); }, view_);
}

// Once to count and once to list.
template <class View>
void ShadowLists::fill(const View& view, const shadow::CasterSet& casters, const shadow::Silhouette& silhouette) {
  const auto forEach = [&](const auto& fn) {
    shadow::forEachCounted(casters, silhouette, [&](std::uint32_t t, const std::array<Vec3, 3>& corners) {
      view.pieces(corners, [&](int face, const shadow::GridPolygon& polygon) {
        cells_.visit(polygon, [&](std::size_t cell) {
          fn(static_cast<std::size_t>(face) * cells_.count() + cell, t);
          return true;
        });
      });
    });
  };
  begin_.assign(View::kFaces * cells_.count() + 1, 0);
  forEach([&](std::size_t cell, std::uint32_t) { ++begin_[cell + 1]; });
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  items_.resize(begin_.back());
  std::vector<std::size_t> next = begin_;
  forEach([&](std::size_t cell, std::uint32_t t) { items_[next[cell]++] = t; });
}

std::optional<std::size_t> ShadowLists::cellOf(const Vec3& point) const {
  const auto place = std::visit([&](const auto& view) { return view.placeOf(point - light_); }, view_);
  if (!place) return std::nullopt;
  return static_cast<std::size_t>(place->face) * cells_.count() + cells_.of(place->at);
}

}  // namespace umbrage::techniques::detail

#pragma once

#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "umbrage/shadow/light_view.hpp"

namespace umbrage::techniques::detail {

/// What a light sees in each direction, found once before the picture is drawn: which faces can shadow which. Only casters in a point's own cell of a
/// grid of directions can lie between it and the light.
/// Source: W. J. Bouknight and K. Kelley, 1970, who projected all polygons onto a sphere around the light to know which pairs may interact.
class ShadowLists {
 public:
  /// Of the triangles that count in `silhouette`. REQUIRES: outlived by `casters`.
  ShadowLists(const shadow::CasterSet& casters, const shadow::Silhouette& silhouette);

  /// The cell of a point, relative to the origin of the casters; none at a point light itself.
  [[nodiscard]] std::optional<std::size_t> cellOf(const Vec3& point) const;
  /// The triangles that the light sees in the directions of a cell, those behind others too.
  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t cell) const {
    return std::span(items_).subspan(begin_[cell], begin_[cell + 1] - begin_[cell]);
  }
  [[nodiscard]] std::size_t size() const { return items_.size(); }

 private:
  template <class View>
  void fill(const View& view, const shadow::CasterSet& casters, const shadow::Silhouette& silhouette);

  shadow::GridCells cells_;
  Vec3 light_{0.0};  ///< of a point light
  std::variant<shadow::ParallelView, shadow::CubeView> view_;
  std::vector<std::size_t> begin_;  ///< per cell, and one more
  std::vector<std::uint32_t> items_;
};

}  // namespace umbrage::techniques::detail

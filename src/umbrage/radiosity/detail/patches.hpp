#pragma once

#include <span>
#include <vector>

#include "umbrage/base/error.hpp"
#include "umbrage/radiosity/subdivision.hpp"

namespace umbrage::radiosity::detail {

/// Part of a mean over a patch.
struct Weight {
  std::uint32_t vertex;
  double weight;
};

/// The elements of a mesh that give off light as a whole.
/// A mean over one weighs corners and middles of its leaves so that it is exact where light varies as a quadratic: 1 : 1 : 1 : 9.
class Patches {
 public:
  /// Cuts the mesh into patches of edges up to `size` near `near`, larger with the distance from it, and those once more.
  /// Errors: ErrorCode::input when they are too many.
  [[nodiscard]] static Result<Patches> cut(Subdivision& mesh, const Box3& near, double size, bool onceMore);

  [[nodiscard]] std::size_t count() const { return elements_.size(); }
  [[nodiscard]] std::uint32_t element(std::size_t patch) const { return elements_[patch]; }
  [[nodiscard]] double area(std::size_t patch) const { return areas_[patch]; }
  [[nodiscard]] std::span<const Weight> weights(std::size_t patch) const {
    return std::span(weights_).subspan(first_[patch], first_[patch + 1] - first_[patch]);
  }
  /// After elements were cut.
  void weigh(const Subdivision& mesh);

 private:
  std::vector<std::uint32_t> elements_;
  std::vector<double> areas_;
  std::vector<std::size_t> first_;
  std::vector<Weight> weights_;
};

}  // namespace umbrage::radiosity::detail

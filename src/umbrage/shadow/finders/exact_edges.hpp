#pragma once

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "umbrage/shadow/finders/finder.hpp"

namespace umbrage::shadow {

/// Multiplicities of single edges by the predicate itself: what every finder asks where bounds cannot tell.
class ExactEdges {
 public:
  explicit ExactEdges(const CasterSet& casters);

  /// The questions about one light. What was learnt about solids is kept, so it belongs to one thread.
  class Query {
   public:
    Query(const ExactEdges& exact, const CasterSet& casters, const Vec4& light, const SilhouetteOptions& options)
        : exact_(exact), casters_(casters), light_(light), options_(options) {}
    [[nodiscard]] std::int32_t multiplicity(std::uint32_t edge);

   private:
    [[nodiscard]] int side(std::uint32_t triangle) const;
    [[nodiscard]] bool seenFromOutside(std::uint32_t component);

    const ExactEdges& exact_;
    const CasterSet& casters_;
    Vec4 light_;
    SilhouetteOptions options_;
    std::unordered_map<std::uint32_t, bool> seen_;
  };

  [[nodiscard]] std::size_t memory() const;

 private:
  std::vector<std::uint32_t> begin_;      ///< per component, one more: its triangles in triangles_
  std::vector<std::uint32_t> triangles_;  ///< of convex solids
};

}  // namespace umbrage::shadow

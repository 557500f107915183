#pragma once

#include <cstdint>
#include <vector>

#include "umbrage/shadow/finders/exact_edges.hpp"
#include "umbrage/shadow/finders/simd.hpp"

namespace umbrage::shadow {

/// Gathers what a finder meets, in any order, and makes it the answer.
class Collector {
 public:
  /// An edge whose multiplicity the bounds proved; each edge at most once, and never one that is doubtful too.
  void add(std::uint32_t edge, std::int32_t multiplicity) { sure_.push_back({edge, multiplicity}); }
  /// An edge that the predicate must decide; more than once does no harm.
  void addDoubtful(std::uint32_t edge) { doubtful_.push_back(edge); }
  void reserve(std::size_t edges) { sure_.reserve(edges); }

  /// Ascending; empties the collector. `edgeCount`: of the casters.
  [[nodiscard]] std::vector<SignedEdge> take(ExactEdges::Query& exact, std::size_t edgeCount);

 private:
  std::vector<SignedEdge> sure_;
  std::vector<std::uint32_t> doubtful_;
};

/// Turns segments that the light's hyperplane crosses into edges with multiplicities.
class TagReader {
 public:
  explicit TagReader(const SilhouetteOptions& options)
      : half_(options.countEverySurface ? kTagSingle : kTagSingle | kTagConvex) {}

  /// A segment that is crossed for certain; `positive`: its first end lies on the side of the light.
  void crossed(std::uint32_t tag, bool positive, Collector& out) const {
    const std::uint32_t edge = tag & kTagEdge;
    if ((tag & kTagPartial) != 0) return out.addDoubtful(edge);
    const std::int32_t size = (tag & half_) != 0 ? 1 : 2;
    out.add(edge, positive != ((tag & kTagNegative) != 0) ? size : -size);
  }
  /// The segments of a block; `live`: its lanes in use.
  void read(const SegmentBlock& block, const LaneSigns& signs, std::uint32_t live, Collector& out) const;

 private:
  std::uint32_t half_;
};

/// By edge, ascending. REQUIRES: every edge < edgeCount, none twice.
void sortByEdge(std::vector<SignedEdge>& edges, std::size_t edgeCount);

}  // namespace umbrage::shadow

#include "umbrage/shadow/finders/exact_edges.hpp"

#include <algorithm>
#include <span>

#include "umbrage/math/predicates.hpp"

namespace umbrage::shadow {

ExactEdges::ExactEdges(const CasterSet& casters) {
  const auto convex = [&](std::uint32_t t) { return casters.outward[t] != 0; };
  begin_.assign(casters.componentCount + 1, 0);
  for (std::uint32_t t = 0; t < casters.triangles.size(); ++t)
    if (convex(t)) ++begin_[casters.componentOf[t] + 1];
  for (std::size_t c = 0; c < casters.componentCount; ++c) begin_[c + 1] += begin_[c];
  triangles_.resize(begin_.back());
  if (triangles_.empty()) {
    begin_ = {};
    return;
  }
  std::vector<std::uint32_t> next = begin_;
  for (std::uint32_t t = 0; t < casters.triangles.size(); ++t)
    if (convex(t)) triangles_[next[casters.componentOf[t]]++] = t;
}

std::size_t ExactEdges::memory() const { return (begin_.size() + triangles_.size()) * sizeof(std::uint32_t); }

int ExactEdges::Query::side(std::uint32_t t) const {
  return lightSide(casters_.corner(t, 0), casters_.corner(t, 1), casters_.corner(t, 2), light_);
}

bool ExactEdges::Query::seenFromOutside(std::uint32_t component) {
  const auto [entry, isNew] = seen_.try_emplace(component, false);
  if (isNew) {
    const auto triangles =
        std::span(exact_.triangles_)
            .subspan(exact_.begin_[component], exact_.begin_[component + 1] - exact_.begin_[component]);
    entry->second = std::any_of(triangles.begin(), triangles.end(),
                                [&](std::uint32_t t) { return side(t) * casters_.outward[t] > 0; });
  }
  return entry->second;
}

std::int32_t ExactEdges::Query::multiplicity(std::uint32_t e) {
  const CasterEdge& edge = casters_.edges[e];
  std::int32_t all = 0, withoutAverted = 0;
  bool lit = false, averted = false;
  for (std::uint32_t u = edge.begin; u < edge.end; ++u) {
    const CasterEdgeUse& use = casters_.uses[u];
    const int s = side(use.triangle), outside = s * casters_.outward[use.triangle];
    all += use.sign * s;
    lit |= outside > 0;
    averted |= outside < 0;
    if (outside >= 0) withoutAverted += use.sign * s;
  }
  if (options_.countEverySurface || !averted) return all;
  // All faces at an edge belong to one component, so one lit face here, or anywhere else on the solid, tells.
  if (lit || seenFromOutside(casters_.componentOf[casters_.uses[edge.begin].triangle])) return withoutAverted;
  return all;
}

}  // namespace umbrage::shadow

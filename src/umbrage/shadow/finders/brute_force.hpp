#pragma once

#include <array>
#include <vector>

#include "umbrage/shadow/finders/finder.hpp"
#include "umbrage/shadow/finders/triangle_lanes.hpp"

namespace umbrage::shadow {

/// findSilhouette behind the interface of the finders.
class BruteForce final : public SilhouetteFinder {
 public:
  explicit BruteForce(std::shared_ptr<const CasterSet> casters)
      : SilhouetteFinder(FinderKind::bruteForce, std::move(casters)) {}
  [[nodiscard]] FoundEdges find(const Vec4& light, const SilhouetteOptions& options) const override;
  [[nodiscard]] Silhouette silhouette(const Vec4& light, const SilhouetteOptions& options) const override;
  [[nodiscard]] std::size_t memory() const override { return 0; }
};

/// The same over structures of arrays: first the side of every triangle, then the sum at every edge.
class BruteForceSimd final : public SilhouetteFinder {
 public:
  BruteForceSimd(std::shared_ptr<const CasterSet> casters, const FinderOptions& options);
  [[nodiscard]] FoundEdges find(const Vec4& light, const SilhouetteOptions& options) const override;
  [[nodiscard]] Silhouette silhouette(const Vec4& light, const SilhouetteOptions& options) const override;
  [[nodiscard]] std::size_t memory() const override;

  /// The side of every triangle, as findSilhouette has it.
  [[nodiscard]] std::vector<std::int8_t> sides(const Vec4& light, const SilhouetteOptions& options) const;

 private:
  /// An edge of one or two faces as two triangles, the top bit set where it is used with sign -1. A missing face, and both faces
  /// of edges of more than two, are the triangle past the last, which has side 0.
  using Uses = std::array<std::vector<std::uint32_t>, 2>;

  [[nodiscard]] std::vector<SignedEdge> sums(const std::vector<std::int8_t>& side) const;
  void sumsOf(const std::int8_t* side, std::size_t begin, std::size_t end, std::vector<SignedEdge>& out) const;
  void wideSumsOf(const std::int8_t* side, std::size_t begin, std::size_t end, std::vector<SignedEdge>& out) const;
  void addSum(const std::int8_t* side, std::size_t edge, std::vector<SignedEdge>& out) const;
  void leaveOutAverted(std::vector<std::int8_t>& side) const;
  [[nodiscard]] unsigned parts(std::size_t items) const;

  TriangleLanes lanes_;
  Uses uses_;
  std::vector<std::uint32_t> manyFaced_;  ///< edges of more than two faces
  std::vector<std::uint32_t> convex_;     ///< triangles of convex solids
  unsigned threads_;
  bool avx2_;
};

}  // namespace umbrage::shadow

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "umbrage/shadow/silhouette.hpp"

namespace umbrage::shadow {

/// The ways to find a silhouette. Each returns the same edges with the same multiplicities, in the same order.
enum class FinderKind {
  automatic,       ///< starts with bruteForceSimd, builds hextree when enough was asked, and keeps what measured faster
  bruteForce,      ///< every edge, one after the other: the yardstick
  bruteForceSimd,  ///< every edge, several at a time, in threads where it pays
  hextree,         ///< a tree over the edges in the dual space of their planes
  hough,           ///< a tree over the edges in Hough space
  potentiallyVisible,  ///< an octree over the places of a point light, with the edges that each may have on its silhouette
  gpu,  ///< every edge, by compute shaders (render::GpuFinder): only techniques that draw with OpenGL have it
};

/// Those that makeFinder makes.
[[nodiscard]] std::span<const FinderKind> finderKinds();
/// All of them.
[[nodiscard]] std::span<const FinderKind> allFinderKinds();
/// As the command line spells it: "auto", "brute_force", "hextree", ..
[[nodiscard]] std::string_view name(FinderKind kind);
[[nodiscard]] std::optional<FinderKind> finderNamed(std::string_view name);

struct FinderOptions {
  unsigned threads = 0;        ///< at most so many; 0: one a processor
  bool vectorUnits = true;     ///< false: as on a processor without AVX2; the results are the same
  double litVolume = 4.0;      ///< potentiallyVisible: lights within so many times the casters' box, about its centre
  double bytesPerEdge = 64.0;  ///< potentiallyVisible: memory that its octree may take
};

/// An edge on a silhouette: where the number of surfaces between a point and the light changes by `multiplicity`.
struct SignedEdge {
  std::uint32_t edge;         ///< index into CasterSet::edges
  std::int32_t multiplicity;  ///< never 0; see SilhouetteEdge
  friend bool operator==(const SignedEdge&, const SignedEdge&) = default;
};

struct FoundEdges {
  std::vector<SignedEdge> edges;  ///< ascending
  std::size_t tested = 0;         ///< edges that were looked at each by itself
  FinderKind answeredBy{};        ///< another than the one asked when that one had to pass the question on
};

/// Finds silhouettes of one caster set, for any light and any number of lights. Built once, const afterwards; its functions may
/// be called by several threads at once.
/// 1. For every light the edges are those of findSilhouette, bit by bit: a finder skips an edge only where the rounding error of
///    lightSide cannot change its sign.
/// REQUIRES of all: light.w is 0 or 1.
class SilhouetteFinder {
 public:
  virtual ~SilhouetteFinder() = default;
  [[nodiscard]] FinderKind kind() const { return kind_; }
  [[nodiscard]] const CasterSet& casters() const { return *casters_; }
  [[nodiscard]] const std::shared_ptr<const CasterSet>& share() const { return casters_; }
  /// The edges alone. `light`: homogeneous, relative to the origin of the casters.
  [[nodiscard]] virtual FoundEdges find(const Vec4& light, const SilhouetteOptions& options = {}) const = 0;
  /// The same with the side of every triangle, which costs a pass over all of them.
  [[nodiscard]] virtual Silhouette silhouette(const Vec4& light, const SilhouetteOptions& options = {}) const;
  /// Bytes held beside the casters.
  [[nodiscard]] virtual std::size_t memory() const = 0;

 protected:
  SilhouetteFinder(FinderKind kind, std::shared_ptr<const CasterSet> casters)
      : kind_(kind), casters_(std::move(casters)) {}

 private:
  FinderKind kind_;
  std::shared_ptr<const CasterSet> casters_;
};

/// REQUIRES: casters is not null; kind is one of finderKinds().
[[nodiscard]] std::unique_ptr<SilhouetteFinder> makeFinder(FinderKind kind, std::shared_ptr<const CasterSet> casters,
                                                           const FinderOptions& options = {});

/// The edges with all that a volume needs to know. `side` must be that of findSilhouette.
[[nodiscard]] Silhouette assemble(const CasterSet& casters, const Vec4& light, const FoundEdges& found,
                                  std::vector<std::int8_t> side);

/// A light as rigidly moved casters see it in the space they were built in, so that motion rebuilds nothing.
/// `objectToWorld`: a rotation and a translation. `light` and the result: homogeneous, relative to the origin of the casters.
/// 1. The silhouette found with it is exactly that of the casters where they were built, and watertight as every other.
/// 2. It is that of casters built in the world, too, where the motion rounds no coordinate of a corner or of the light (quarter
///    turns about the axes, shifts on the grid of the coordinates). Otherwise the two may differ at faces in whose plane the light
///    lies within the rounding of that motion, and only there.
[[nodiscard]] Vec4 intoObjectSpace(const Mat4& objectToWorld, const Vec4& light);

}  // namespace umbrage::shadow

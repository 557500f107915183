#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "umbrage/shadow/finders/exact_edges.hpp"
#include "umbrage/shadow/finders/finder.hpp"

namespace umbrage::shadow {

struct LightBits;

/// Silhouettes of one caster set for many lights in one call: the suns of a year. Built once, const afterwards.
class ManyLights {
 public:
  explicit ManyLights(std::shared_ptr<const CasterSet> casters, const FinderOptions& options = {});

  /// One answer a light, in the order of the lights.
  /// 1. Each is what SilhouetteFinder::find gives for that light.
  /// REQUIRES: light.w is 0 or 1 for each.
  [[nodiscard]] std::vector<FoundEdges> find(std::span<const Vec4> lights, const SilhouetteOptions& options = {}) const;

  /// Calls answer(light, edges) once for each light, in any order and from several threads at once. The edges live as long as the
  /// call, so that memory is taken for some lights at a time only: faster, where much of a mesh is on its silhouettes.
  using Answer = std::function<void(std::size_t light, const FoundEdges& found)>;
  void visit(std::span<const Vec4> lights, const Answer& answer, const SilhouetteOptions& options = {}) const;

  [[nodiscard]] std::size_t memory() const;

 private:
  static constexpr std::size_t kGroup = 64;  ///< lights that share a word
  struct Group;
  struct Rows;
  struct Turned;

  using Out = std::span<FoundEdges>;
  void shareNormals();
  [[nodiscard]] std::vector<LightBits> facing(std::span<const Vec4> lights, bool byNormal) const;
  template <class Done>
  void findGroup(std::span<const Vec4> lights, const SilhouetteOptions& options, Out out, bool keep,
                 const Done& done) const;
  [[nodiscard]] Rows rows(std::size_t firstEdge, const Group& group) const;
  [[nodiscard]] std::vector<std::size_t> expected(const Group& group) const;
  void bookDoubtful(std::size_t firstEdge, const Rows& rows, Group& group) const;
  void pickEdges(Group& group) const;
  [[nodiscard]] Turned turn(Group& group) const;
  void takeTurned(const Turned& turned, std::size_t light, std::vector<SignedEdge>& edges) const;
  void addManyFaced(Group& group) const;
  void decideDoubtful(const Vec4& light, const SilhouetteOptions& options, std::vector<std::uint32_t>& doubtful,
                      std::vector<SignedEdge>& edges) const;
  template <class Work>
  void inGroups(std::size_t lights, const Work& work) const;

  std::shared_ptr<const CasterSet> casters_;
  ExactEdges exact_;
  Vec3 centre_{0.0};
  double radius_ = 0.0;
  std::vector<std::array<float, 4>> planes_;  ///< per triangle; zero for slivers, which are always in doubt
  using Uses = std::array<std::uint32_t, 2>;
  std::vector<Uses> uses_;  ///< per edge: its two triangles, or its one twice, with flags
  /// Where many triangles share their normals, directions need look at normals only.
  std::vector<std::array<float, 4>> normals_;  ///< all different; empty: hardly any two are equal
  std::vector<std::uint32_t> normalOf_;        ///< per triangle
  std::vector<Uses> normalUses_;               ///< uses_ with normals instead of triangles
  std::vector<std::uint32_t> special_;         ///< edges of more than two faces, and folded ones of solids
  unsigned threads_;
  bool avx2_;
};

}  // namespace umbrage::shadow

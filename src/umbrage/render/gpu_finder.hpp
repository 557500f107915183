#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "umbrage/gl/pass.hpp"
#include "umbrage/gl/program.hpp"
#include "umbrage/shadow/finders/finder.hpp"

namespace umbrage::render {

/// What becomes of a component of the casters.
enum class Role : std::uint32_t {
  leftOut,
  pass,       ///< sides alone, for z-pass
  fail,       ///< sides and caps, for z-fail
  failAtEye,  ///< the same without sides on which the eye lies (shadow::liesOnSide)
};

/// How a side of a volume is written; the value is its number of indices.
enum class SideFormat : std::uint32_t {
  line = 2,      ///< its edge alone, for a geometry shader
  triangle = 3,  ///< for a directional light, all of whose far vertices are one point
  quad = 6,      ///< two triangles
};

/// What is to be extruded on the graphics card. Points are relative to the origin of the casters.
struct CardRequest {
  Vec4 light{0.0};
  Vec3 eye{0.0};
  std::span<const Role> roles;  ///< per component
  SideFormat sides = SideFormat::quad;
  bool farCaps = true;  ///< none where all far vertices are one point
  shadow::SilhouetteOptions options;
};

/// Shadow volumes whose size only the graphics card knows: indices into doubled vertices (shadow::ShadowVolume), drawn by gl::Pass::drawIndirect.
struct CardVolume {
  enum Part : std::size_t { passSides, failSides, failCaps };
  gl::Buffer indices;
  gl::Buffer draws;  ///< one gl::IndirectDraw a Part, then the number of edges found
  gl::VertexArray vertices{indices};
  SideFormat sides = SideFormat::quad;
  bool farCaps = true;
};

/// What a CardVolume turned out to be.
struct CardCounts {
  std::size_t edges = 0;                 ///< on the silhouette, of components that are not left out
  std::array<std::size_t, 3> indices{};  ///< per CardVolume::Part
  std::size_t triangles = 0;             ///< that are drawn
};
/// Waits for the graphics card.
[[nodiscard]] CardCounts countsOf(const CardVolume& volume);

/// The compute shaders of a GpuFinder; several finders of one context may share them.
struct FinderPrograms {
  FinderPrograms();
  gl::Program sides, caps, edges;
};

/// Finds silhouettes by compute shaders, an invocation a triangle and an invocation an edge, and extrudes them where they are: the edges need not come back.
/// 1. Signs are computed in double precision in the order of lightSide, uncontracted: the edges are those of every other finder, bit by bit.
/// REQUIRES of every call and of destruction: the OpenGL context it was made in is current, in one thread.
/// Source: one atomic a work group: J. Milet et al.; the multiplicities: Aldridge and Woods, 2004, and Kim, Kim and Turk, 2008.
class GpuFinder final : public shadow::SilhouetteFinder {
 public:
  /// Errors: ErrorCode::device when memory is short, the casters are larger than a buffer of this driver may be, or they have 2^30 components.
  [[nodiscard]] static Result<std::unique_ptr<GpuFinder>> make(
      std::shared_ptr<const shadow::CasterSet> casters, std::shared_ptr<const FinderPrograms> programs = nullptr);

  /// Ascending, as all finders return them: read back and sorted. REQUIRES: no pass is open.
  [[nodiscard]] shadow::FoundEdges find(const Vec4& light, const shadow::SilhouetteOptions& options) const override;
  /// Sides and edges as the graphics card found them, read back.
  [[nodiscard]] shadow::Silhouette silhouette(const Vec4& light,
                                              const shadow::SilhouetteOptions& options) const override;
  [[nodiscard]] std::size_t memory() const override;

  /// Whether a volume of these roles fits into a buffer of this driver.
  [[nodiscard]] bool fits(const CardRequest& request) const;
  /// Finds and extrudes without waiting for anything. Errors: ErrorCode::device when memory is short.
  [[nodiscard]] Result<void> extrude(gl::HostScope& scope, const CardRequest& request, CardVolume& out) const;
  /// An upper bound for the layers that any ray from this light meets (shadow::layeringBound), worked out when the light changes.
  [[nodiscard]] int layers(const Vec4& light) const;

 private:
  GpuFinder(std::shared_ptr<const shadow::CasterSet> casters, std::shared_ptr<const FinderPrograms> programs);
  [[nodiscard]] Result<void> upload();
  [[nodiscard]] std::array<std::size_t, 3> capacities(const CardRequest& request) const;
  [[nodiscard]] Result<void> run(gl::HostScope& scope, const CardRequest& request, bool listsEdges,
                                 CardVolume& out) const;
  [[nodiscard]] shadow::FoundEdges readEdges(const CardVolume& volume) const;

  std::shared_ptr<const FinderPrograms> programs_;
  gl::Buffer positions_, triangles_, edges_, uses_;
  std::vector<std::size_t> usesOf_, trianglesOf_;  ///< per component
  std::size_t memory_ = 0;
  mutable gl::Buffer query_, side_, seen_, roles_;  ///< of the run under way
  mutable CardVolume found_;                        ///< for find()
  mutable Vec4 layersFor_{0.0};
  mutable int layers_ = -1;
};

}  // namespace umbrage::render

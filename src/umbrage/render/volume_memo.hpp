#pragma once

#include <array>
#include <map>
#include <memory>
#include <unordered_map>
#include <vector>

#include "umbrage/gl/objects.hpp"
#include "umbrage/render/prepare_light.hpp"
#include "umbrage/shadow/finders/finder.hpp"

namespace umbrage::render {

/// What had to be worked out, and what had not, since the beginning.
struct ShadowWork {
  std::size_t uploads = 0;      ///< caster sets whose positions were sent to the graphics card
  std::size_t silhouettes = 0;  ///< silhouettes found, with volumes extruded and sent
  std::size_t reused = 0;       ///< volumes that were there already
};

/// A part of a volume that no ray enters more than `layers` times.
struct VolumePart {
  shadow::Silhouette silhouette;
  int layers = 0;
  IndexRange sides, caps;
  std::size_t indicesPerSide =
      0;  ///< sides stand in the order of the silhouette's edges, each as often as its multiplicity says
};

/// What one caster set throws under one light, ready to be drawn.
struct StoredVolume {
  std::vector<VolumePart> parts;
  shadow::LightStats stats;  ///< what finding it took
  std::size_t lastUsed = 0;  ///< in which turn
  gl::Buffer indices;
  gl::VertexArray vertices{indices};
};

/// Caster sets and their volumes on the graphics card, kept while somebody holds the casters. Since volumes depend on the casters
/// and the light in the casters' own space and on nothing else, a light or a caster that stays, or that only moves along under a
/// directional light, costs nothing.
/// 1. A turn is the shadows of one light. Volumes that the last 64 turns did not use are forgotten.
/// 2. What it returns is valid until the next turn begins.
/// REQUIRES: the context of all calls is the same and current, also at destruction; casters that it was given never change.
class VolumeMemo {
 public:
  using Casters = std::shared_ptr<const shadow::CasterSet>;

  void beginTurn();

  /// Errors: ErrorCode::device when memory is short.
  [[nodiscard]] Result<const gl::Buffer*> positions(const Casters& casters);
  /// `light`: homogeneous, relative to casters->origin. `endsAnywhere`: as shadow::ExtrudeOptions has it.
  [[nodiscard]] Result<const StoredVolume*> volume(const Casters& casters, const Vec4& light, bool endsAnywhere);

  [[nodiscard]] const ShadowWork& work() const { return work_; }

 private:
  struct Entry {
    std::weak_ptr<const shadow::CasterSet> casters;
    gl::Buffer positions;
    std::unique_ptr<shadow::SilhouetteFinder> finder;       ///< does not own the casters, which would keep them alive
    std::map<std::array<double, 5>, StoredVolume> volumes;  ///< by light, and whether they may end anywhere
  };
  [[nodiscard]] Result<Entry*> entryOf(const Casters& casters);

  std::unordered_map<const shadow::CasterSet*, Entry> entries_;
  std::size_t turn_ = 0;
  ShadowWork work_;
};

}  // namespace umbrage::render

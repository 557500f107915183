#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "umbrage/render/gpu_finder.hpp"
#include "umbrage/render/pass_list.hpp"
#include "umbrage/render/receiver_tiles.hpp"
#include "umbrage/render/volume_options.hpp"
#include "umbrage/shadow/eye_count.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::render {

/// How the stencil counts. zPass starts from the count at the eye and falls back to z-fail for casters that the eye is too close to
/// (shadow::countAtEye); zMixed starts from 0 and takes z-fail for every caster that may lie between the eye and the light
/// (shadow::chooseAtEye); zPassPlus starts from what the graphics card counts by drawing the casters as the light sees them through the
/// near rectangle. eachTriangle counts as zFail, with a volume for every triangle by itself (shadow::eachByItself).
enum class Counting { zFail, zPass, zMixed, zPassPlus, eachTriangle };
[[nodiscard]] const char* name(Counting counting);

/// A run of indices in LightVolume::indices.
struct IndexRange {
  std::size_t first = 0, count = 0;
};

/// What of a light's volumes is counted together.
struct VolumeGroup {
  int eyeCount = 0;  ///< where the stencil starts
  IndexRange nearCasters, passSides, failSides, failCaps;
  /// Sides that are wound the other way round than their corners run, so that they have the depths, to the bit, of those they cancel.
  IndexRange turnedSides = {};
};

/// What one light's shadow volumes are made of, ready to be uploaded. Computed without OpenGL.
struct LightVolume {
  Vec4 light{0.0};  ///< homogeneous, relative to the casters' origin
  Counting counting = Counting::zFail;
  std::vector<std::uint32_t> indices;  ///< into doubled vertices (shadow::ShadowVolume)
  std::vector<Vec4f> nearPoints;       ///< of VolumeGroup::nearCasters, in clip coordinates; index 2i + 1 is point i
  bool nearDegenerates = false;        ///< zPassPlus had to start from the count at the eye
  std::vector<Vec4f> farPoints;        ///< shadow::farPoints; empty: all at infinity
  std::vector<Vec4f> points;           ///< when the processor extrudes: what `indices` then point at (carryOnProcessor)
  /// One, unless a ray may meet more surfaces than 8 bits can count; then as many as 7 bits can, one bit keeping the result.
  std::vector<VolumeGroup> groups;
  /// Per component, when volumes are still to be found and extruded on the graphics card (GpuFinder::extrude); then `indices` and the
  /// ranges of the one group are empty.
  std::vector<Role> roles;
};

/// Called with the name of each phase when it has ended.
using PhaseEnd = std::function<void(const char*)>;

/// The count of a group is below these: of the only group, or of one among several.
inline constexpr int kWholeStencil = 255, kSharedStencil = 127;

/// What shadow volumes are made for. Points and boxes are relative to the origin of the finder's casters.
struct VolumeRequest {
  const shadow::SilhouetteFinder& finder;
  Vec4 light{0.0};
  Vec3 eye{0.0};
  Counting counting = Counting::zFail;
  VolumeOptions options = kPlainVolumes;
  Box3 receivers;                        ///< all that can receive shadow; needed for finite volumes
  const ReceiverTiles* tiles = nullptr;  ///< needed to leave out hidden parts
  const View* view = nullptr;            ///< needed for zPassPlus
  bool detailed = false;                 ///< LightStats::choices are wanted

  [[nodiscard]] const shadow::CasterSet& casters() const { return finder.casters(); }
};

/// Fills all of `stats` but its reason.
[[nodiscard]] LightVolume prepareVolume(const VolumeRequest& request, shadow::LightStats& stats,
                                        const PhaseEnd& ended = {});

/// The same for edges that stay on the graphics card: only what becomes of each component, which boxes tell. Components whose box may lie between the
/// eye and the light are counted by z-fail, to infinity, and the stencil starts from 0.
/// REQUIRES: neither zPassPlus nor eachTriangle; no ray from the light meets more than kWholeStencil layers.
[[nodiscard]] LightVolume prepareOnCard(const VolumeRequest& request, shadow::LightStats& stats,
                                        const PhaseEnd& ended = {});

/// What a plan needs to know of it.
[[nodiscard]] std::vector<GroupPlan> planGroups(const LightVolume& volume);

}  // namespace umbrage::render

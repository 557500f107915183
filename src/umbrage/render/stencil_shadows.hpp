#pragma once

#include "umbrage/gl/quirks.hpp"
#include "umbrage/render/posed_casters.hpp"
#include "umbrage/render/run_passes.hpp"
#include "umbrage/render/volume_memo.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::render {

/// How a host looks at its scene.
struct HostView {
  Mat4 view{1.0};         ///< world to eye: a rotation and a translation
  Mat4 projection{1.0};   ///< a perspective, as the host's own shaders use it
  bool reversed = false;  ///< the host's nearer surfaces have the greater depth
};

struct StencilShadowOptions {
  Counting counting = Counting::zPass;  ///< REQUIRES: neither zPassPlus nor eachTriangle
  /// False when some casters are not drawn into the depth buffer (invisible, or transparent ones drawn later): then z-fail counts,
  /// with caps compared with the depth. CAVEAT: caps of casters that are in it after all would fight with their surfaces.
  bool castersInDepth = true;
  /// A box of the world around all surfaces that may receive shadows: then volumes end behind it and the eye (shadow::reachWithin) instead of at infinity, which is far
  /// less to fill; each call takes a pass over the casters' corners for it. Empty: nothing is known. REQUIRES: no surface that shall be shaded lies outside.
  Box3 receivers = {};
};

/// What a caster set of one call has on the graphics card besides its volume.
struct PlaceData {
  gl::Buffer view, farPoints;
  gl::Buffer capIndices;  ///< of the caps that this eye sees, where it sees others edge-on
  gl::VertexArray caps{capIndices};
};

/// Exact shadows inside somebody else's renderer. The host draws its scene's depth into its own framebuffer, calls mark() for a
/// light, and adds that light where the stencil is 0; and so on for every light.
/// 1. Casters may move, come and go between calls: what is drawn follows from what mark() is given and from nothing else.
/// 2. Work is done for what changed only (VolumeMemo): a caster that moves costs its own silhouette, under a directional light
///    not even that unless it turns; casters that change their shape are new casters.
/// REQUIRES of every call and of destruction: the host's OpenGL 4.5 context (core or compatibility) is current, with no query,
/// transform feedback or conditional rendering active. The host's state is left as it was (gl::HostScope).
class StencilShadows {
 public:
  /// Errors: ErrorCode::device when the context is too old.
  [[nodiscard]] static Result<StencilShadows> make();
  /// With casters that stand still, for the shorter mark().
  [[nodiscard]] static Result<StencilShadows> make(shadow::CasterSet casters);
  void setCasters(shadow::CasterSet casters);

  /// Writes the stencil of the bound draw framebuffer, inside the current (first) viewport: 0 where the light meets no caster
  /// on its way to the surface in the depth buffer, another value in shadow. Depth range and clip control are the host's.
  /// 1. Whether a surface faces the light, and a spot's cone, are the host's to decide; pixels outside a spot's screen area
  ///    may keep their old values.
  /// REQUIRES: casters that were given once never change.
  /// Errors: ErrorCode::device when the framebuffer has no depth or fewer than 8 bits of stencil, or memory is short.
  /// CAVEAT: depth that the host computes coarsely (16 or 24 bits with a distant far plane) makes shadow
  /// edges coarse in the distance; a reversed float depth does not. Casters that share an edge or a face are counted as one caster
  /// only inside one CasterSet.
  [[nodiscard]] Result<shadow::LightStats> mark(const scene::Light& light, const HostView& view,
                                                std::span<const PosedCasters> casters,
                                                const StencilShadowOptions& options = {});
  /// The same for the casters of make() or setCasters().
  [[nodiscard]] Result<shadow::LightStats> mark(const scene::Light& light, const HostView& view,
                                                const StencilShadowOptions& options = {});

  [[nodiscard]] const ShadowWork& work() const { return memo_.work(); }

 private:
  StencilShadows() = default;
  PosedCasters own_;
  VolumeMemo memo_;
  Programs programs_;
  std::vector<PlaceData> places_;  ///< one a caster set of the call
  gl::Quirks quirks_;
  gl::VertexArray nothing_;  ///< for what is drawn without a buffer
};

}  // namespace umbrage::render

#pragma once

#include <vector>

#include "umbrage/gl/pass_state.hpp"
#include "umbrage/math/box.hpp"
#include "umbrage/scene/camera.hpp"
#include "umbrage/scene/light.hpp"

namespace umbrage::render {

/// How points become pixels. The eye is kept apart from the matrix, so that nothing large is subtracted in single precision.
struct View {
  Mat4 toClip{1.0};      ///< from (position - eye, w) to clip coordinates
  Vec3 eye{0.0};         ///< in world coordinates
  bool reversed = true;  ///< nearer surfaces have the greater depth
  double nearDistance =
      1.0;  ///< of viewOf(Camera): depth = nearDistance / distance along the view; see depthToDistance
};

/// The house's own projection of a camera: reversed, infinite, depth in [0, 1].
/// `sceneRadius` sets only the unit of depth: the camera has no near plane (with depth clamp, surfaces nearer than 2^-50 of the
/// radius share one depth), and the relative precision of a float is the same everywhere.
[[nodiscard]] View viewOf(const scene::Camera& camera, double sceneRadius);

/// A host's own matrices (column vectors, as OpenGL has them) with its own idea of near and far.
/// REQUIRES: `view` is a rotation and a translation; `projection` is a perspective (its eye is the view's origin).
[[nodiscard]] View viewOf(const Mat4& view, const Mat4& projection, bool reversed);

/// True when the view shows a mirror image, so that counter-clockwise faces come out clockwise.
[[nodiscard]] bool mirrors(const View& view);

/// Distance along the view for a depth of viewOf(Camera); infinite for 0.
[[nodiscard]] float depthToDistance(const View& view, float depth);

/// The pixels that a box can be seen in. The whole viewport when it crosses the plane of the eye, none when it is empty.
/// `box` is relative to `origin`.
[[nodiscard]] gl::Rect boxArea(const View& view, const Box3& box, const Vec3& origin, const gl::PassState& placement);

/// Points whose hull holds the casters' box swept away from the light as far as there are receivers; w = 0 for those at infinity. Boxes, `light` and the points are
/// relative to the same origin. REQUIRES: the box of casters is not empty.
[[nodiscard]] std::vector<Vec4> sweptCorners(const Box3& casters, const Box3& receivers, const Vec4& light);

/// The pixels in which the casters' shadow volumes can matter: their box swept away from the light, as far as there are
/// receivers (for z-pass: and the eye). Same fall-back. Boxes and `light` are relative to `origin`; an empty box of receivers stands for all of space.
[[nodiscard]] gl::Rect volumeArea(const View& view, const Box3& casters, const Box3& receivers, const Vec4& light,
                                  const Vec3& origin, const gl::PassState& placement);

/// The pixels that a light can reach: a spot's cone, otherwise the whole viewport. Same fall-back.
[[nodiscard]] gl::Rect litArea(const View& view, const scene::Light& light, const gl::PassState& placement);

}  // namespace umbrage::render

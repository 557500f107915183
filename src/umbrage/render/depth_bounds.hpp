#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "umbrage/render/pass_list.hpp"
#include "umbrage/render/view.hpp"

namespace umbrage::render {

/// Distances along the view.
struct ViewDistances {
  double nearest = 0.0;
  double farthest = std::numeric_limits<double>::infinity();
};

/// Between which distances a receiver may lie in a shadow volume: a hull around the casters swept away from the light, as far as there are receivers,
/// a little wider for rounding. Boxes and `light` are relative to `origin`; an empty box of receivers stands for all of space.
/// Law: no point of the receivers' box nearer or farther than that lies in a volume; when `nearest` is not 0 and the box holds the eye, the eye does not either.
[[nodiscard]] ViewDistances volumeDistances(const View& view, const Box3& casters, const Box3& receivers,
                                            const Vec4& light, const Vec3& origin);

/// The same as stored depths, lowest first, for gl::PassState::depthBounds: what must be counted, given how. None where nothing could be left out.
/// 1. Pixels whose stored depth lies outside end with a count of 0 without any volume drawn: before `nearest` nothing of a volume is, and behind `farthest` only
///    a count that started from 0 stays right without the volumes in front of it. What starts by drawing (zp_plus) has no bounds.
[[nodiscard]] std::optional<std::array<float, 2>> depthBounds(const View& view, const gl::PassState& placement,
                                                              ViewDistances distances,
                                                              const std::vector<GroupPlan>& groups);

}  // namespace umbrage::render

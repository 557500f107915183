#include "umbrage/render/depth_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace umbrage::render {
namespace {

// Stored depths are right to 2^-16 of the distance at worst; a thousandth is generous.
constexpr double kMargin = 1e-3;

Vec4 row(const Mat4& m, int r) { return {m[0][r], m[1][r], m[2][r], m[3][r]}; }

// What the depth buffer holds of a surface at that distance along the view.
float storedDepth(const View& view, const gl::PassState& placement, double distance) {
  // The third and the fourth row of a perspective look along the same axis, so depth depends on the distance alone.
  const Vec4 z = row(view.toClip, 2), w = row(view.toClip, 3);
  const double along = glm::dot(Vec3(z), Vec3(w)) / glm::dot(Vec3(w), Vec3(w));
  double depth = std::isinf(distance) ? along : along + z.w / distance;
  if (placement.clipDepth == gl::ClipDepth::minusOneToOne) depth = 0.5 + 0.5 * depth;
  depth = std::clamp(depth, 0.0, 1.0);
  const double start = placement.depthRange[0], end = placement.depthRange[1];
  return static_cast<float>(start + depth * (end - start));
}

}  // namespace

ViewDistances volumeDistances(const View& view, const Box3& casters, const Box3& receivers, const Vec4& light,
                              const Vec3& origin) {
  ViewDistances out{std::numeric_limits<double>::infinity(), 0.0};
  if (casters.empty()) return out;
  const Vec3 forward(row(view.toClip, 3));
  for (const Vec4& corner : sweptCorners(casters, receivers, light)) {
    const double along = glm::dot(forward, Vec3(corner) + (origin - view.eye) * corner.w);
    if (corner.w != 0.0) {
      out.nearest = std::min(out.nearest, along);
      out.farthest = std::max(out.farthest, along);
    } else if (along > 0.0) {
      out.farthest = std::numeric_limits<double>::infinity();
    } else if (along < 0.0) {
      out.nearest = 0.0;
    }
  }
  out.nearest = std::max(0.0, out.nearest * (1.0 - kMargin));
  out.farthest = std::max(0.0, out.farthest * (1.0 + kMargin));
  return out;
}

std::optional<std::array<float, 2>> depthBounds(const View& view, const gl::PassState& placement,
                                                ViewDistances distances, const std::vector<GroupPlan>& groups) {
  for (const GroupPlan& group : groups) {
    if (group.nearCasters) return std::nullopt;
    if (group.eyeCount != 0) distances.farthest = std::numeric_limits<double>::infinity();
  }
  if (distances.nearest <= 0.0 && std::isinf(distances.farthest)) return std::nullopt;
  const auto at = [&](double distance) { return storedDepth(view, placement, distance); };
  // At the eye itself depth has no limit but that of the buffer.
  const float whole = placement.depthRange[view.reversed ? 1 : 0];
  const float nearest = distances.nearest > 0.0 ? at(distances.nearest) : whole;
  const float farthest = distances.farthest > 0.0 ? at(distances.farthest) : whole;
  return std::array{std::min(nearest, farthest), std::max(nearest, farthest)};
}

}  // namespace umbrage::render

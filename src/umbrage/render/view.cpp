#include "umbrage/render/view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "umbrage/base/check.hpp"

namespace umbrage::render {
namespace {

// Surfaces nearer than this share one depth. A power of two, so that depths round alike in scenes of every size.
constexpr int kNearExponent = -50;
// Wider cones are treated as reaching everywhere; their tangent says nothing.
constexpr double kWidestCone = 80.0;

struct Bounds2 {
  double left = std::numeric_limits<double>::infinity(), right = -left, bottom = left, top = -left;
};

// The pixels that hold the convex hull of homogeneous points; false when the hull crosses the plane of the eye.
bool project(const View& view, const std::vector<Vec4>& points, Bounds2& out) {
  for (const Vec4& p : points) {
    const Vec4 clip = view.toClip * p;
    if (!(clip.w > 1e-9 * glm::length(Vec3(p)))) return false;
    out.left = std::min(out.left, clip.x / clip.w);
    out.right = std::max(out.right, clip.x / clip.w);
    out.bottom = std::min(out.bottom, clip.y / clip.w);
    out.top = std::max(out.top, clip.y / clip.w);
  }
  return true;
}

// One pixel more on each side, for the rounding of the rasteriser.
gl::Rect pixelsOf(const View& view, const std::vector<Vec4>& points, const gl::PassState& placement) {
  const gl::Rect& viewport = placement.viewport;
  Bounds2 b;
  if (!project(view, points, b)) return viewport;
  if (placement.clipOrigin == gl::ClipOrigin::upperLeft) b = {b.left, b.right, -b.top, -b.bottom};
  const auto pixel = [](double ndc, int start, int size, double margin) {
    const double bounded = std::clamp(0.5 + 0.5 * ndc, -0.5, 1.5);
    return static_cast<int>(std::floor(start + bounded * size + margin));
  };
  const int left = pixel(b.left, viewport.x, viewport.width, -1), right = pixel(b.right, viewport.x, viewport.width, 2);
  const int bottom = pixel(b.bottom, viewport.y, viewport.height, -1),
            top = pixel(b.top, viewport.y, viewport.height, 2);
  return gl::intersect({left, bottom, right - left, top - bottom}, viewport);
}

constexpr double kEndless = std::numeric_limits<double>::infinity();

// How far along one axis the interval of the casters must be swept to leave that of the receivers for good. A point p of the
// casters moves by t * (p * light.w - light).
double sweepOutAlong(int axis, const Box3& casters, const Box3& receivers, const Vec4& light) {
  const double low = casters.min[axis] * light.w - light[axis], high = casters.max[axis] * light.w - light[axis];
  if (low > 0.0) return std::max(0.0, (receivers.max[axis] - casters.min[axis]) / low);
  if (high < 0.0) return std::max(0.0, (receivers.min[axis] - casters.max[axis]) / high);
  return kEndless;
}

// How far the box of the casters must be swept away from the light until it touches no receiver any more; with a little more
// for rounding.
double sweepOut(const Box3& casters, const Box3& receivers, const Vec4& light) {
  double reach = kEndless;
  for (int axis = 0; axis < 3; ++axis) reach = std::min(reach, sweepOutAlong(axis, casters, receivers, light));
  return reach * (1.0 + 1e-6);
}

std::array<Vec3, 8> cornersOf(const Box3& box) {
  std::array<Vec3, 8> corners;
  for (int i = 0; i < 8; ++i)
    corners[i] = Vec3((i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                      (i & 4) != 0 ? box.max.z : box.min.z);
  return corners;
}

}  // namespace

View viewOf(const scene::Camera& camera, double sceneRadius) {
  const scene::CameraBasis b = scene::basis(camera);
  const double f = 1.0 / tan(0.5 * camera.fovY);
  const double aspect = double(camera.width) / double(camera.height);
  View view;
  view.eye = camera.eye;
  view.nearDistance = std::ldexp(1.0, std::ilogb(sceneRadius > 0.0 ? sceneRadius : 1.0) + kNearExponent);
  const Vec3 x = b.right * (f / aspect), y = b.up * f;
  for (int c = 0; c < 3; ++c) view.toClip[c] = Vec4(x[c], y[c], 0.0, b.forward[c]);
  view.toClip[3] = Vec4(0.0, 0.0, view.nearDistance, 0.0);
  return view;
}

View viewOf(const Mat4& view, const Mat4& projection, bool reversed) {
  UMBRAGE_CHECK(projection[3][3] == 0.0 && projection[2][3] != 0.0, "a perspective projection");
  const Mat3 rotation(view);
  const Mat3 square = glm::transpose(rotation) * rotation - Mat3(1.0);
  for (int c = 0; c < 3; ++c) UMBRAGE_CHECK(glm::length(square[c]) < 1e-3, "a view that rotates and moves only");
  View out;
  out.eye = -(glm::transpose(rotation) * Vec3(view[3]));
  out.toClip = projection * Mat4(rotation);
  out.reversed = reversed;
  return out;
}

bool mirrors(const View& view) {
  const auto row = [&](int r) { return Vec3(view.toClip[0][r], view.toClip[1][r], view.toClip[2][r]); };
  // Right, up and forward are left-handed in a picture that does not mirror.
  return glm::dot(glm::cross(row(0), row(1)), row(3)) > 0.0;
}

float depthToDistance(const View& view, float depth) {
  return depth > 0.0f ? static_cast<float>(view.nearDistance / double(depth)) : std::numeric_limits<float>::infinity();
}

gl::Rect boxArea(const View& view, const Box3& box, const Vec3& origin, const gl::PassState& placement) {
  if (box.empty()) return {};
  std::vector<Vec4> points;
  for (const Vec3& corner : cornersOf(box)) points.emplace_back(corner + origin - view.eye, 1.0);
  return pixelsOf(view, points, placement);
}

std::vector<Vec4> sweptCorners(const Box3& casters, const Box3& receivers, const Vec4& light) {
  const double reach = receivers.empty() ? kEndless : sweepOut(casters, receivers, light);
  std::vector<Vec4> points;
  for (const Vec3& corner : cornersOf(casters)) {
    const Vec3 away = corner * light.w - Vec3(light);
    points.emplace_back(corner, 1.0);
    points.emplace_back(reach < kEndless ? Vec4(corner + reach * away, 1.0) : Vec4(away, 0.0));
  }
  return points;
}

gl::Rect volumeArea(const View& view, const Box3& casters, const Box3& receivers, const Vec4& light, const Vec3& origin,
                    const gl::PassState& placement) {
  if (casters.empty()) return {};
  std::vector<Vec4> points = sweptCorners(casters, receivers, light);
  for (Vec4& point : points) point += Vec4((origin - view.eye) * point.w, 0.0);
  return pixelsOf(view, points, placement);
}

gl::Rect litArea(const View& view, const scene::Light& light, const gl::PassState& placement) {
  const auto* spot = std::get_if<scene::SpotLight>(&light.shape);
  if (spot == nullptr || spot->cutoff > Angle::degrees(kWidestCone)) return placement.viewport;
  // A pyramid around the cone.
  const Vec3 axis = glm::normalize(spot->direction);
  const Vec3 u = glm::normalize(glm::cross(axis, std::abs(axis.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
  const Vec3 v = glm::cross(axis, u);
  const double reach = tan(spot->cutoff);
  std::vector<Vec4> points{Vec4(spot->position - view.eye, 1.0)};
  for (const double i : {-reach, reach})
    for (const double j : {-reach, reach}) points.emplace_back(axis + i * u + j * v, 0.0);
  return pixelsOf(view, points, placement);
}

}  // namespace umbrage::render

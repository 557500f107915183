#include "umbrage/coin/detail/view.hpp"

#include <cmath>
#include <glm/matrix.hpp>

#include "umbrage/coin/detail/extractor.hpp"
#include "umbrage/coin/detail/matrices.hpp"

namespace umbrage::coin::detail {
namespace {

// Coin's matrices are of single precision. What they leave open moves no ray by more than 1/500 of a pixel.
constexpr double kSame = 2e-6;

bool nearly(double a, double b) { return std::abs(a - b) <= kSame * std::max(1.0, std::abs(b)); }

bool isRigid(const Mat4& m) {
  const Vec3 x(m[0]), y(m[1]), z(m[2]);
  return nearly(glm::dot(x, x), 1.0) && nearly(glm::dot(y, y), 1.0) && nearly(glm::dot(z, z), 1.0) &&
         nearly(glm::dot(x, y), 0.0) && nearly(glm::dot(y, z), 0.0) && nearly(glm::dot(z, x), 0.0) &&
         glm::determinant(Mat3(m)) > 0.0;
}

bool isCentred(const Mat4& p) { return nearly(p[2][0], 0.0) && nearly(p[2][1], 0.0); }

std::optional<scene::Camera> pinholeOf(const Mat4& viewing, const Mat4& p, int width, int height) {
  const bool perspective = p[2][3] == -1.0 && p[3][3] == 0.0;
  if (!perspective || !isCentred(p) || !isRigid(viewing)) return std::nullopt;
  if (!nearly(p[0][0] * width / (p[1][1] * height), 1.0)) return std::nullopt;
  const Mat4 toWorld = glm::inverse(viewing);
  scene::Camera camera;
  camera.eye = Vec3(toWorld[3]);
  camera.target = camera.eye - Vec3(toWorld[2]);
  camera.up = Vec3(toWorld[1]);
  camera.fovY = Angle::radians(2.0 * std::atan(1.0 / p[1][1]));
  camera.width = width;
  camera.height = height;
  return camera;
}

bool isFinite(const Mat4& m) {
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k)
      if (!std::isfinite(m[i][k])) return false;
  return true;
}

}  // namespace

std::optional<View> viewOf(const Sight& sight) {
  const Mat4 viewing = matrixOf(sight.viewing), projection = matrixOf(sight.projection);
  const SbVec2s origin = sight.viewport.getViewportOriginPixels(), size = sight.viewport.getViewportSizePixels();
  View view{origin[0], origin[1], size[0], size[1], projection * viewing, {}, {}, {}};
  view.fromClip = glm::inverse(view.toClip);
  if (view.width <= 0 || view.height <= 0 || !isFinite(view.fromClip)) return std::nullopt;
  view.eye = view.fromClip * Vec4(0.0, 0.0, -1.0, 0.0);
  // A parallel projection's last row is (0, 0, 0, 1): what is left in w is rounding.
  if (projection[2][3] == 0.0)
    view.eye.w = 0.0;
  else
    view.eye /= view.eye.w;
  view.pinhole = pinholeOf(viewing, projection, view.width, view.height);
  return view;
}

ViewRay rayThrough(const View& view, double x, double y) {
  const double u = 2.0 * x / view.width - 1.0, v = 1.0 - 2.0 * y / view.height;
  const Vec4 nearest = view.fromClip * Vec4(u, v, -1.0, 1.0), farthest = view.fromClip * Vec4(u, v, 1.0, 1.0);
  const Vec3 from = Vec3(nearest) / nearest.w;
  return {from, Vec3(farthest) / farthest.w - from};
}

}  // namespace umbrage::coin::detail

#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "umbrage/base/error.hpp"
#include "umbrage/scene/surfaces.hpp"
#include "umbrage/trace/segment.hpp"

namespace umbrage::trace {

/// The nearest surface on a ray.
struct Hit {
  std::uint32_t triangle;  ///< of Surfaces
  double at;               ///< parameter along the ray, from the triangle's plane in double precision
};

/// Eight rays in single precision, relative to the origin of the surfaces: from + s x direction, 0 <= s <= length.
struct Rays8 {
  alignas(32) std::array<float, 8> fromX, fromY, fromZ, directionX, directionY, directionZ, length;
  std::uint32_t active = 0;  ///< bit k: ray k is there
};
/// The nearest triangles; shadow::kNoTriangle where a ray meets nothing. `at` is in single precision.
struct Hits8 {
  std::array<std::uint32_t, 8> triangle;
  std::array<float, 8> at;
};

struct Trees;

/// Ray queries against a scene's surfaces. Built once, const afterwards; all queries may run in many threads at once and give
/// the same answers in any number of them.
/// The largest coordinate of a triangle's corners.
[[nodiscard]] double reachOf(const scene::Surfaces& surfaces, std::uint32_t triangle);

/// The rounding of single precision among coordinates up to `reach`: below this distance from each other surfaces count as one.
///
/// 16 x 2^-24 x reach. Rounding a start point to float moves it by at most sqrt(3) x 2^-24 of its coordinates, rounding corners
/// relative to it and the plane equation in the ray tracer by about 10 x 2^-24 more; a start point lifted by this distance
/// therefore stays on its side of its own triangle (slivers apart, which light_rays filters).
[[nodiscard]] constexpr double resolution(double reach) { return 0x1p-20 * reach; }

class Occlusion {
 public:
  /// Errors: ErrorCode::device when the ray tracer cannot work here or runs out of memory.
  [[nodiscard]] static Result<Occlusion> build(std::shared_ptr<const scene::Surfaces> surfaces);

  Occlusion(Occlusion&&) noexcept;
  Occlusion& operator=(Occlusion&&) noexcept;
  ~Occlusion();

  [[nodiscard]] const scene::Surfaces& surfaces() const { return *surfaces_; }
  [[nodiscard]] Corners corners(std::uint32_t triangle) const {
    return {surfaces_->corner(triangle, 0), surfaces_->corner(triangle, 1), surfaces_->corner(triangle, 2)};
  }

  /// The nearest surface of any kind, either side; hits are decided in double precision. `from` is relative to the origin of the
  /// surfaces. A surface whose plane holds `from` (liesInPlane) is edge-on and not met.
  [[nodiscard]] std::optional<Hit> nearest(const Vec3& from, const Vec3& direction) const;
  /// In single precision: whether a surface through or very near a start is met is left to chance.
  [[nodiscard]] Hits8 nearest(const Rays8& rays) const;

  /// Bit k: ray k meets a caster.
  [[nodiscard]] std::uint32_t meetsCaster(const Rays8& rays) const;

  /// The largest coordinate of a triangle's corners.
  [[nodiscard]] float reach(std::uint32_t triangle) const { return reach_[triangle]; }

  /// The largest of all that cast.
  [[nodiscard]] float largestReach() const { return largestReach_; }

  /// For the other files of this room.
  [[nodiscard]] const Trees& trees() const { return *trees_; }

 private:
  Occlusion(std::shared_ptr<const scene::Surfaces> surfaces, std::unique_ptr<Trees> trees);

  std::shared_ptr<const scene::Surfaces> surfaces_;
  std::unique_ptr<Trees> trees_;
  std::vector<float> reach_;  ///< per triangle
  float largestReach_ = 0.0f;
};

/// The parameter t at which from + t x direction meets the plane of `triangle`, in double precision, kept within the triangle's
/// own extent along the ray, which matters where it is seen nearly edge-on. `estimate` when exactly edge-on.
[[nodiscard]] double refine(const Corners& triangle, const Vec3& from, const Vec3& direction, double estimate);

}  // namespace umbrage::trace

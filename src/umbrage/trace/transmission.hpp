#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "umbrage/shadow/technique.hpp"
#include "umbrage/trace/occlusion.hpp"

namespace umbrage::trace {

/// Rays through surfaces that let light through: the truth for coloured transparent casters. Everything is decided in double precision, and a ray that
/// meets an edge of two triangles meets one of them.
/// Built once, const afterwards; all queries may run in many threads at once.
class Transmission {
 public:
  /// Errors: ErrorCode::device when the ray tracer cannot work here or runs out of memory.
  [[nodiscard]] static Result<Transmission> build(std::shared_ptr<const shadow::Geometry> geometry);

  Transmission(Transmission&&) noexcept;
  Transmission& operator=(Transmission&&) noexcept;
  ~Transmission();

  [[nodiscard]] const shadow::Geometry& geometry() const { return *geometry_; }

  /// The surfaces on a ray, the nearest first, up to the first opaque one; coincident ones by their number. `from` is relative to the origin of the
  /// surfaces; those in whose plane it lies (liesInPlane) are not met.
  void look(const Vec3& from, const Vec3& direction, std::vector<Hit>& out) const;

  /// What the casters between a point of a surface and a light take; none where one of them is opaque. Neither the surface itself counts nor what
  /// lies upon it (see LightRays). `light`: homogeneous, relative to the origin of the surfaces.
  [[nodiscard]] std::optional<shadow::FilterSum> towards(const Vec4& light, const Vec3& point,
                                                         std::uint32_t surface) const;

 private:
  struct Tree;
  Transmission(std::shared_ptr<const shadow::Geometry> geometry, std::unique_ptr<Tree> tree);
  std::shared_ptr<const shadow::Geometry> geometry_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace umbrage::trace

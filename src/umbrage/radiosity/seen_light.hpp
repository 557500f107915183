#pragma once

#include <array>
#include <vector>

#include "umbrage/radiosity/subdivision.hpp"
#include "umbrage/scene/light.hpp"
#include "umbrage/trace/occlusion.hpp"

namespace umbrage::radiosity {

struct SeenOptions {
  double coarse = 1.0 / 24.0;  ///< edges of elements are at most so long near the casters, in radii of their box
  double fine = 1.0 / 768.0;   ///< and cut no shorter
  double error = 0.05;         ///< elements are cut where parts differ by more
  std::size_t samples = 64;    ///< points of a light that has an extent
  std::size_t mostElements = 1u << 20;
};

/// What of one light all surfaces see.
struct SeenLight {
  Subdivision mesh;
  std::vector<std::array<float, 2>>
      parts;  ///< per vertex and side (see Sheet): the part of the light that is seen, in [0, 1]

  /// Of a point of a triangle, relative to the origin of the surfaces.
  [[nodiscard]] double at(std::uint32_t triangle, const Vec3& point, std::size_t side) const;
};

/// The first step of radiosity alone: the light on elements that are cut where shadows end.
/// Errors: ErrorCode::device when memory runs out.
[[nodiscard]] Result<SeenLight> seenLight(const trace::Occlusion& occlusion, const scene::Light& light,
                                          const SeenOptions& options = {});

}  // namespace umbrage::radiosity

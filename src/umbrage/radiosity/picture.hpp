#pragma once

#include <optional>

#include "umbrage/image/image.hpp"
#include "umbrage/mesh/mesh.hpp"
#include "umbrage/radiosity/solve.hpp"
#include "umbrage/scene/camera.hpp"

namespace umbrage::radiosity {

/// Light over curved surfaces without the edges of their facets: where sheets of one material meet within `crease` of each other in a vertex, that has the
/// mean of their light there.
[[nodiscard]] Solution smoothed(Solution solution, Angle crease);

struct PictureOptions {
  /// What exitance is multiplied by, 1 being the brightest that a picture shows. None: as `exposureOf` finds.
  std::optional<double> exposure;
  Vec3 background{0.93, 0.95, 0.97};  ///< sRGB, where no surface is
};

/// The exposure at which one part in fifty of what only reflects light, by area, is too bright for a picture; 1 where nothing is bright.
[[nodiscard]] double exposureOf(const scene::Scene& scene, const Solution& solution);

/// The light as a camera sees it, the ambient term included.
/// REQUIRES: the solution is of this scene. Errors: ErrorCode::device when memory runs out or rays cannot be had.
[[nodiscard]] Result<image::RgbImage> paint(const scene::Scene& scene, const Solution& solution,
                                            const scene::Camera& camera, const PictureOptions& options = {});

/// A mesh whose vertices know their light.
struct LitMesh {
  std::vector<Vec3> positions;  ///< in the world
  std::vector<mesh::Triangle> triangles;
  std::vector<Vec3f> exitance;  ///< per position: linear RGB, the ambient term included
};

/// The lit sides of all elements as triangles wound to that side; of surfaces that are dark on both, side 0.
[[nodiscard]] LitMesh litMesh(const scene::Scene& scene, const Solution& solution);

}  // namespace umbrage::radiosity

#pragma once

#include "umbrage/image/image.hpp"
#include "umbrage/scene/camera.hpp"
#include "umbrage/scene/surfaces.hpp"
#include "umbrage/shadow/light_mask.hpp"
#include "umbrage/shadow/surface_buffer.hpp"

namespace umbrage::shadow {

/// The same view with every pixel divided into `factor` x `factor`.
[[nodiscard]] scene::Camera divided(scene::Camera camera, int factor);

/// A view of three by three pixels alone, or a little less, with `samples` x `samples` pixels for each: a narrow pinhole aimed at the
/// point (x, y) of the picture; whole numbers plus 0.5 are centres of pixels.
[[nodiscard]] scene::Camera magnified(const scene::Camera& camera, double x, double y, int samples);

/// Where true edges lie, found from a truth of finer grain: `seen` and `truth` are of the view divided(camera, factor).
///
/// A pixel of the result (of the undivided view) is nonzero when between two of its samples, or between one of its samples and
/// the sample beside it in the next pixel, there is
/// 1. a shadow edge: light or covered differ, or
/// 2. a depth edge: the surface breaks off. Two samples on different triangles belong to one unbroken surface when their planes
///    cross between them, as they do at every crease; else the depth jumps, and it counts when by more than two samples' width.
///    So creases and the inner edges of a mesh are no edges.
/// REQUIRES: sizes that fit.
[[nodiscard]] image::GreyImage trueEdges(const scene::Surfaces& surfaces, const scene::Camera& camera, int factor,
                                         const SurfaceBuffer& seen, const LightMask& truth);

}  // namespace umbrage::shadow

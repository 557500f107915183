#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "umbrage/base/progress.hpp"
#include "umbrage/radiosity/subdivision.hpp"
#include "umbrage/radiosity/visible_factor.hpp"
#include "umbrage/scene/scene.hpp"

namespace umbrage::radiosity {

/// How exactly light is followed. Lengths are in scene units.
struct Options {
  double patch =
      0.0;  ///< edges of what gives off light are at most so long; 0: a fifth of the radius of the scene's casters
  double element = 0.0;  ///< edges of what receives it are cut no shorter; 0: a sixteenth of `patch`
  /// Elements are cut where the light on them differs by more than this part of the scene's mean; 0: none is cut further than `patch` asks.
  double error = 0.1;
  double unshot = 1e-3;  ///< ends when so little of all light that was emitted still waits to be given off
  std::size_t mostShots = std::numeric_limits<std::size_t>::max();  ///< or after so many
  std::size_t lightSamples = 64;        ///< points of each light of the scene that has an extent
  std::size_t mostElements = 1u << 20;  ///< no element is cut when there are so many
  std::size_t memory =
      std::size_t{512}
      << 20;  ///< bytes for form factors that are kept; all others are computed again when they are wanted
  VisibilityAccuracy visibility = {};
};

/// Where all the light has gone, per channel: sums of area x light, both sides of all surfaces.
struct Balance {
  Vec3 emitted{0.0};   ///< by materials, and what of the scene's lights falls on surfaces
  Vec3 absorbed{0.0};  ///< by surfaces
  Vec3 escaped{0.0};   ///< past all surfaces, estimated by rays
  Vec3 unshot{0.0};    ///< not yet given off
  /// What is missing or too much, as a part of what was emitted: form factors are those of points, so their sums over surfaces are not exact.
  [[nodiscard]] double error() const;
};

struct SolveStats {
  std::size_t patches = 0, elements = 0, vertices = 0;  ///< patches: counting sides; elements: leaves
  std::size_t shots = 0;
  std::size_t factors = 0;      ///< form factors that were computed
  std::size_t refinements = 0;  ///< rounds in which elements were cut
  bool converged = false;       ///< false: it was cancelled, or had no more shots
  double unshotPart = 0.0;      ///< of what was emitted
};

/// The light on all surfaces.
struct Solution {
  std::shared_ptr<const scene::Surfaces> surfaces;
  Subdivision mesh;
  /// Per vertex and side (see Sheet), linear RGB: what the surface gives off, by itself and of what falls on it. A surface of albedo r under
  /// a light of brightness E gives off r x E, as in every other picture.
  std::vector<std::array<Vec3, 2>> exitance;
  /// What light that is still unshot would add everywhere, were it spread evenly: the ambient term of progressive refinement. Per unit of albedo.
  Vec3 ambient{0.0};
  Balance balance;
  SolveStats stats;
};

/// Progressive refinement: the patch with the most unshot light gives it off to all elements, again and again.
///
/// 1. Both sides of every surface are surfaces of their own. Materials that let light through are opaque here.
/// 2. Light is known at points: the corners and the middles of elements. A point gets from a patch the exact form factor of what is seen of it
///    (visibleFactor), so in a closed room of one albedo r and one emission e every point has e / (1 - r).
/// 3. Patches are as large as `patch` near the casters and grow with the distance from them. Elements are the leaves below them.
/// 4. Where elements are cut after light was shot, the new points get all of it after the fact: the result is that of the finer mesh.
///    What is whiter than 0.98 counts as 0.98: light would never end in a closed room of albedo 1.
/// 5. Same input, same bits, in any number of threads.
/// Cancelled by `progress`, it gives what there is, which is a picture too (with `ambient`).
/// Errors: ErrorCode::device when memory runs out or rays cannot be had; input when the patches are more than a million.
/// Source: M. F. Cohen, S. E. Chen, J. R. Wallace and D. P. Greenberg, A Progressive Refinement Approach to Fast Radiosity Image Generation, 1988;
/// M. F. Cohen, D. P. Greenberg, D. S. Immel and P. J. Brock, An Efficient Radiosity Approach for Realistic Image Synthesis, 1986, for elements in
/// patches.
[[nodiscard]] Result<Solution> solve(const scene::Scene& scene, std::span<const scene::Light> lights,
                                     const Options& options = {}, const ProgressSink& progress = {});

}  // namespace umbrage::radiosity

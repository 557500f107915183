#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "umbrage/math/box.hpp"
#include "umbrage/scene/light.hpp"

namespace umbrage::shadow {

/// One of the points that stand for a light with an extent.
struct LightSample {
  scene::Light light;  ///< a point, a direction or, for what shines to one side only, a spot of half a space
  /// Where it is one of a ball's; all others count alike.
  std::optional<scene::SphereLight> ball = {};

  /// What it counts for at a point of the world.
  [[nodiscard]] double weight(const Vec3& point) const;
};

/// Samples `first` to `first + count - 1` of a light's own sequence: the first 2^n of it fill the light evenly, for every n, and so do the next
/// 2^n. A light without extent is its only sample.
/// `room`: holds all that is lit, in world coordinates; where it lies before a flat light, its points need not be told that they shine to one side
/// only.
///
/// A ball is what is seen of it: every direction to it counts alike. It is filled with points so that, seen from afar from anywhere, they lie evenly over
/// its disc, with density 1 / sqrt(R^2 - r^2). The first 256 were optimised for that from all directions at once, where points on its surface would be
/// wasted on the averted half and a (0, 2)-sequence is even from one side only; those after them are a (0, 2)-sequence seen from the middle of the room. Seen
/// from nearer, a ray that passes the centre at b from a distance d meets (d^2 + R^2 / 2 - 3 b^2 / 2) / d^2 of what it should; that is what the
/// weight takes back.
/// Source: the (0, 2)-sequence of van der Corput and Sobol', T. Kollig and A. Keller, 2002; discs after P. Shirley and K. Chiu, 1997.
[[nodiscard]] std::vector<LightSample> lightSamples(const scene::Light& light, std::size_t first, std::size_t count,
                                                    const Box3& room = {});

/// Which of two halves a sample belongs to, counted from the light's first: by itself each fills the light as evenly, so how much they differ tells the error.
[[nodiscard]] constexpr std::size_t halfOf(std::size_t sample) { return sample / 8 % 2; }

}  // namespace umbrage::shadow

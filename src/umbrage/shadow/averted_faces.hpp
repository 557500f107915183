#pragma once

#include <cstdint>
#include <vector>

#include "umbrage/shadow/technique.hpp"

namespace umbrage::shadow {

/// Per triangle of the surfaces: 1 when it is an averted face of a convex solid that the eye is outside of, so that nothing of it is seen.
/// A face that nearly holds the eye counts as seen. `eye`: relative to the origin of the surfaces.
[[nodiscard]] std::vector<std::uint8_t> avertedFaces(const Geometry& geometry, const Vec3& eye);

}  // namespace umbrage::shadow

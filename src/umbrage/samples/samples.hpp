#pragma once

#include <span>
#include <string_view>

#include "umbrage/base/error.hpp"
#include "umbrage/scene/scene.hpp"

namespace umbrage::samples {

/// A scene that comes with the library.
struct SampleInfo {
  std::string_view name;     ///< as make() and the command line spell it
  std::string_view summary;  ///< one sentence
};

/// All samples, in the order in which they are worth looking at.
[[nodiscard]] std::span<const SampleInfo> list();

/// Builds a sample: metres, Z up, north is +Y, the lowest point at height 0; the same bytes on every machine.
/// 1. Coordinates of meshes are whole multiples of 1/1024 m and placing is exact too, so single precision loses nothing.
/// 2. Closed parts are wound outwards; panes, awnings and shells are single sheets on purpose.
/// 3. No triangle without area; no two faces that look the same way lie in one plane upon each other, save those on the ground.
/// Errors: ErrorCode::usage for a name that is not in list().
[[nodiscard]] Result<scene::Scene> make(std::string_view name);

}  // namespace umbrage::samples

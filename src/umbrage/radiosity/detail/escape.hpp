#pragma once

#include "umbrage/radiosity/visible_factor.hpp"

namespace umbrage::radiosity::detail {

/// The part of what an emitter gives off that meets no surface at all, by rays.
[[nodiscard]] double escaping(const trace::Occlusion& occlusion, const Emitter& emitter);

}  // namespace umbrage::radiosity::detail

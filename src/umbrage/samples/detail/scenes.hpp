#pragma once

#include "umbrage/scene/scene.hpp"

namespace umbrage::samples::detail {

[[nodiscard]] scene::Scene courtyard();
[[nodiscard]] scene::Scene tower();
[[nodiscard]] scene::Scene industrial();
[[nodiscard]] scene::Scene building();
[[nodiscard]] scene::Scene pavilion();
[[nodiscard]] scene::Scene cornell();
[[nodiscard]] scene::Scene stillLife();

}  // namespace umbrage::samples::detail

#pragma once

#include <string>

#include "umbrage/scene/scene.hpp"
#include "umbrage/study/hours_table.hpp"

namespace umbrage::report::detail {

/// A glTF binary of coloured squares.
[[nodiscard]] std::string hoursGlb(const study::HoursTable& table, const scene::Scene& scene);

}  // namespace umbrage::report::detail

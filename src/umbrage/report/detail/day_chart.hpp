#pragma once

#include <string>

#include "umbrage/report/study_page.hpp"

namespace umbrage::report::detail {

/// The chart as an SVG element of a page that has study_page.css.
[[nodiscard]] std::string chartSvg(const DayChart& chart);

}  // namespace umbrage::report::detail

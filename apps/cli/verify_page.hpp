#pragma once

#include "umbrage/report/study_page.hpp"
#include "verify_output.hpp"

namespace umbrage::cli {

/// A verdict as a page, without its maps, pictures and files. Errors: usage (the clock).
[[nodiscard]] Result<report::StudyPage> verdictPage(const VerdictReport& report, const scene::Scene& scene);

}  // namespace umbrage::cli

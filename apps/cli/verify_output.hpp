#pragma once

#include <string>
#include <vector>

#include "json.hpp"
#include "umbrage/report/vector_map.hpp"
#include "umbrage/rules/net_new.hpp"
#include "umbrage/rules/verify.hpp"

// A verdict and what it rests on, as text, JSON, CSV and map.
namespace umbrage::cli {

/// What a day brings in new shadow.
struct DayNews {
  std::chrono::year_month_day date{};
  rules::NetNew news;
};

/// Everything that `verify` found out.
struct VerdictReport {
  rules::Verdict verdict;
  rules::VerifyRequest request;
  rules::TargetSet targets;
  std::vector<rules::Area> areas;  ///< the open spaces, or the site
  std::vector<DayNews> news;
  double metresPerUnit = 1.0;  ///< of the scene, in which receivers lie
};

[[nodiscard]] std::string verdictText(const VerdictReport& report);
[[nodiscard]] Json verdictJson(const VerdictReport& report);
/// A name as a cell of a CSV: in quotes, and with an apostrophe before what a spreadsheet would run as a formula (= + - @).
[[nodiscard]] std::string csvText(const std::string& text);
/// A row for each receiver and requirement.
[[nodiscard]] std::string verdictCsv(const VerdictReport& report);
/// The areas, the receivers that fail, and the new shadow of the moments. `map` has title, ledger and buildings.
void addVerdict(report::VectorMap& map, const VerdictReport& report, const scene::Scene& scene);

}  // namespace umbrage::cli

#include "umbrage/report/write_hours.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "umbrage/base/file.hpp"
#include "umbrage/png/png.hpp"
#include "umbrage/report/detail/hours_glb.hpp"
#include "umbrage/report/detail/hours_tiff.hpp"
#include "umbrage/report/detail/remarks.hpp"

namespace umbrage::report {
namespace {

std::string ledgerText(const study::HoursTable& table) {
  std::string text;
  for (const study::LedgerLine& line : table.ledger) text += line.subject + ": " + line.text + "\n";
  return text;
}

std::string csvOf(const study::HoursTable& table, bool withPlaces) {
  std::string text = withPlaces ? "x,y,z,nx,ny,nz," : "";
  text += "hours,longest,intervals";
  if (!table.runs.empty()) text += ",runs,run_hours";
  if (!table.months.empty())
    for (int m = 1; m <= 12; ++m) text += fmt::format(",month_{:02}", m);
  text += "\n";
  for (std::size_t i = 0; i < table.hours.size(); ++i) {
    const study::Receiver& r = table.set.receivers[i];
    if (withPlaces)
      text += fmt::format("{},{},{},{:.6g},{:.6g},{:.6g},", r.position.x, r.position.y, r.position.z, r.normal.x,
                          r.normal.y, r.normal.z);
    text += fmt::format("{:.4f},{:.4f},{}", table.hours[i], table.longest[i], study::stretchesText(table, i));
    if (!table.runs.empty()) text += fmt::format(",{},{:.4f}", table.runs[i], table.runHours[i]);
    if (!table.months.empty())
      for (const float h : table.months[i]) text += fmt::format(",{:.3f}", h);
    text += "\n";
  }
  return text;
}

}  // namespace

Result<std::vector<std::filesystem::path>> writeHours(const study::HoursTable& table, const scene::Scene& scene,
                                                      const std::filesystem::path& path) {
  const std::string kind = lowerExtension(path);
  const bool grid = table.set.lattice.columns > 0;
  if ((kind == ".png" || kind == ".tif") && !grid)
    return fail(ErrorCode::usage,
                "a picture in plan or a GeoTIFF takes a grid in plan; write faces and points to .csv or .glb",
                path.string());
  std::vector<std::filesystem::path> written{path};
  Result<void> done = fail(ErrorCode::usage, "the extension must be .csv, .png, .tif or .glb", path.string());
  if (kind == ".csv") {
    std::filesystem::path beside = path;
    beside += ".ledger.txt";
    done = writeFile(beside, ledgerText(table));
    if (done) done = writeFile(path, csvOf(table, grid || table.set.spacing > 0.0));
    written.push_back(beside);
  } else if (kind == ".png") {
    done = png::write(path, hoursPlan(scene, table), detail::remarksOf(table.ledger));
  } else if (kind == ".tif") {
    done = detail::writeHoursTiff(table, scene, path);
  } else if (kind == ".glb") {
    done = writeFile(path, detail::hoursGlb(table, scene));
  }
  if (!done) return tl::unexpected(done.error());
  return written;
}

}  // namespace umbrage::report

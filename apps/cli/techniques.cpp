#include <algorithm>

#include <fmt/format.h>

#include "choice.hpp"
#include "commands.hpp"
#include "graphics.hpp"
#include "json.hpp"

namespace umbrage::cli {
namespace {

/// A technique as this machine sees it.
struct Row {
  shadow::Traits traits;
  std::string obstacle;  ///< why it cannot run here; empty: it can
};

std::vector<Row> gather() {
  std::vector<Row> rows;
  for (const auto& entry : allTechniques()) {
    const auto made = entry.create();
    rows.push_back({entry.traits, made ? std::string() : made.error().text()});
  }
  return rows;
}

Json rowsJson(const std::vector<Row>& rows) {
  Json list = Json::array();
  for (const auto& [traits, obstacle] : rows)
    list.push_back({{"name", traits.name},
                    {"summary", traits.summary},
                    {"soft", traits.soft},
                    {"tinted", traits.tinted},
                    {"needs_closed", traits.needsClosed},
                    {"needs_graphics", traits.needsGraphics},
                    {"edge_tolerance_px", traits.edgeTolerancePx},
                    {"approximate", traits.approximate},
                    {"available", obstacle.empty()},
                    {"reason", obstacle.empty() ? Json(nullptr) : Json(obstacle)}});
  return list;
}

std::string traitsText(const shadow::Traits& traits) {
  return fmt::format("{}; {}; {}; {}; {}", traits.needsGraphics ? "OpenGL" : "CPU",
                     traits.soft ? "soft and hard shadows" : "hard shadows",
                     traits.tinted ? "tinted glass" : "no tinted glass",
                     traits.needsClosed ? "closed casters only" : "any caster",
                     traits.approximate ? "approximate" : fmt::format("edges within {} px", traits.edgeTolerancePx));
}

std::string rowsText(const std::vector<Row>& rows) {
  const Graphics graphics = findGraphics();
  std::size_t width = 0;
  for (const Row& row : rows) width = std::max(width, row.traits.name.size());
  std::string text;
  for (const auto& [traits, obstacle] : rows) {
    text += fmt::format("{:<{}} {}\n", traits.name, width, traits.summary);
    text += fmt::format("{:<{}} {}\n", "", width, traitsText(traits));
    if (!obstacle.empty()) text += fmt::format("{:<{}} cannot run here: {}\n", "", width, obstacle);
  }
  text += fmt::format("{:<{}} {}\n", "graphics", width,
                      graphics.renderer.empty() ? "none: " + graphics.reason : graphics.renderer);
  return printable(text);
}

}  // namespace

Run addTechniques(CLI::App& app) {
  const auto json = std::make_shared<bool>(false);
  addFlag(app, "--json", "As JSON", *json);
  return [json](const Console&) -> Result<Outcome> {
    const auto rows = gather();
    return Outcome{*json ? jsonText(rowsJson(rows)) : rowsText(rows), 0};
  };
}

}  // namespace umbrage::cli

#pragma once

#include "drawing.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::cli {

/// What --stats tells, gathered while a picture is made.
struct Stats {
  const View& view;
  const shadow::Geometry& geometry;
  const Drawing& drawing;
  std::vector<shadow::PhaseTime> phases;  ///< of the whole run; the technique's own stand inside the drawing
};

[[nodiscard]] std::string statsJson(const Stats& stats);

/// The same in a few lines, for --verbose.
[[nodiscard]] std::string statsText(const Stats& stats);

}  // namespace umbrage::cli

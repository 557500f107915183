#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "umbrage/image/image.hpp"
#include "umbrage/study/profile.hpp"

namespace umbrage::report {

/// Part of a day, in hours of the clock that the page tells: 9.5 is half past nine; a day that begins before midnight has negative ones.
struct DayPart {
  double from = 0.0, to = 0.0;
};

/// What is asked for and what there is.
struct Criterion {
  std::string what, found, asked, margin;
  bool passes = false;
};

/// What another convention would say.
struct Otherwise {
  std::string convention, taken, instead, margin;
  bool passes = false;
};

/// One receiver's day.
struct DayBar {
  std::string name, figure;    ///< "12.5 E, 3.0 N, 1.5 m up" and "2 h 13 min"
  std::optional<bool> passes;  ///< none: nothing is asked of it
  std::vector<DayPart> parts;  ///< of the day: what the page's bars show
};

/// Bars on one axis.
struct DayChart {
  std::string title, note;
  DayPart axis;                 ///< from left to right; whole hours are marked
  std::vector<DayPart> counts;  ///< when it counts: the rest is shaded
  std::string shown;            ///< what a bar is: "sun", "new shadow"
  std::vector<DayBar> bars;
};

struct PageTable {
  std::string title, note;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

/// A drawing of ours (report::svgText), as it stands.
struct PageMap {
  std::string title, svg;
};

/// A picture as the bytes of a PNG, with what is written beneath.
struct PagePicture {
  std::string caption;
  std::vector<std::uint8_t> png;
};

/// A study as one page.
struct StudyPage {
  std::string title, subtitle;
  std::optional<bool> passes;  ///< none: nothing was judged
  std::string verdict;         ///< one sentence
  std::vector<std::string> warnings;
  std::vector<std::pair<std::string, std::string>> facts;  ///< what, and its value
  std::vector<Criterion> criteria;
  std::string whyOtherwise;  ///< before `otherwise`
  std::vector<Otherwise> otherwise;
  std::vector<DayChart> charts;
  std::vector<PageTable> tables;
  std::vector<PageMap> maps;
  std::vector<PagePicture> pictures;  ///< of a day, in order: one is shown, and a slider changes it
  std::vector<std::pair<std::string, std::string>>
      sources;  ///< where figures of the rule come from, and which are uncertain
  std::vector<study::LedgerLine> ledger;
  std::vector<std::string> evidence;  ///< names of the files that hold all figures
  std::string command;                ///< that makes the page again
};

/// The page by itself: pictures, style and script stand inside it; it needs no network, and prints without the controls, every picture small.
[[nodiscard]] std::string studyPage(const StudyPage& page);

}  // namespace umbrage::report

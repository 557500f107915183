#pragma once

#include "options.hpp"
#include "umbrage/sun/zone.hpp"

namespace umbrage::cli {

/// PLACE+TIME of a study.
struct PlaceOptions {
  double latitude = 0.0, longitude = 0.0;  ///< degrees
  std::chrono::year_month_day date{};
  sun::Zone zone;
};

/// --lat, --lon, --date and --tz, all required.
void addPlaceOptions(CLI::App& app, PlaceOptions& options);

[[nodiscard]] Result<sun::Place> placeOf(const PlaceOptions& options);

}  // namespace umbrage::cli

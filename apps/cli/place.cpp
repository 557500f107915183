#include "place.hpp"

namespace umbrage::cli {

void addPlaceOptions(CLI::App& app, PlaceOptions& options) {
  constexpr Manner manner{.group = "Place and time", .required = true};
  const auto degrees = [](double limit) {
    return [limit](const std::string& word) { return parseNumber(word, -limit, limit); };
  };
  addValue(app, "--lat", "DEG", "Latitude, north positive", options.latitude, degrees(90), manner);
  addValue(app, "--lon", "DEG", "Longitude, east positive", options.longitude, degrees(180), manner);
  addValue(app, "--date", "YYYY-MM-DD", "The day", options.date, sun::parseDate, manner);
  addValue(app, "--tz", "ZONE", "The clock: Europe/Vienna, +01:00, or solar (true solar time)", options.zone,
           sun::parseZone, manner);
}

Result<sun::Place> placeOf(const PlaceOptions& options) { return sun::makePlace(options.latitude, options.longitude); }

}  // namespace umbrage::cli

#include "place.hpp"

#include <cmath>

#include <fmt/format.h>

namespace umbrage::cli {

void addPlaceOptions(CLI::App& app, PlaceOptions& options) {
  const auto degrees = [](double limit) {
    return [limit](const std::string& word) { return parseNumber(word, -limit, limit); };
  };
  addValue(app, "--lat", "DEG", "Latitude, north positive", options.latitude, degrees(90))
      ->required()
      ->group("Place and time");
  addValue(app, "--lon", "DEG", "Longitude, east positive", options.longitude, degrees(180))
      ->required()
      ->group("Place and time");
  addValue(app, "--date", "YYYY-MM-DD", "The day", options.date, sun::parseDate)->required()->group("Place and time");
  addValue(app, "--tz", "ZONE", "The clock: Europe/Vienna, +01:00, or solar (true solar time)", options.zone,
           sun::parseZone)
      ->required()
      ->group("Place and time");
}

Result<sun::Place> placeOf(const PlaceOptions& options) { return sun::makePlace(options.latitude, options.longitude); }

std::string placeText(const PlaceOptions& options) {
  return fmt::format("{:g} {}, {:g} {}", std::abs(options.latitude), options.latitude < 0 ? "S" : "N",
                     std::abs(options.longitude), options.longitude < 0 ? "W" : "E");
}

}  // namespace umbrage::cli

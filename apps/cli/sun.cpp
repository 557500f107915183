#include <fmt/format.h>

#include "commands.hpp"
#include "json.hpp"
#include "place.hpp"
#include "self_check.hpp"
#include "umbrage/study/ledger.hpp"
#include "umbrage/sun/sun.hpp"

namespace umbrage::cli {
namespace {

struct SunOptions {
  PlaceOptions place;
  std::chrono::milliseconds time{};
  bool json = false;
};

/// The sun, and everything that was assumed to find it.
struct Answer {
  sun::Place place;
  sun::Instant instant;
  sun::ClockReading utc;
  sun::ClockReading clock;
  sun::SunPosition position;
  Vec3 direction;  ///< towards the sun: east, north, up
};

// The way the light travels, as --light wants it.
std::string lightZUp(const Vec3& d) { return fmt::format("directional:{:.6f},{:.6f},{:.6f}", -d.x, -d.y, -d.z); }
std::string lightYUp(const Vec3& d) { return fmt::format("directional:{:.6f},{:.6f},{:.6f}", -d.x, -d.z, d.y); }

std::string utcText(const Answer& answer) {
  return fmt::format("{} {}", sun::dateText(answer.utc.clock.date), sun::timeText(answer.utc.clock.time));
}

std::string clockText(const SunOptions& options, const Answer& answer) {
  const auto reading = fmt::format("{} {}", sun::dateText(options.place.date), sun::timeText(options.time));
  if (options.place.zone.kind == sun::Zone::Kind::solar) return reading + " true solar time";
  const auto& abbreviation = answer.clock.abbreviation;
  return fmt::format("{} {}{}(UTC{})", reading, abbreviation, abbreviation.empty() ? "" : " ",
                     sun::offsetText(answer.clock.offset));
}

std::string answerText(const SunOptions& options, const Answer& answer) {
  const auto& [elevation, azimuth] = answer.position;
  const Vec3& d = answer.direction;
  std::string text = fmt::format("place      {}\n", study::placeText(answer.place));
  text += fmt::format("clock      {}, which is {} UTC\n", clockText(options, answer), utcText(answer));
  text += fmt::format("elevation  {:8.4f} degrees, geometric: the disc's centre, no refraction\n", elevation.degrees());
  text += fmt::format("azimuth    {:8.4f} degrees, clockwise from true north ({})\n", azimuth.degrees(),
                      sun::compassPoint(azimuth));
  text += fmt::format("direction  {:.6f} east, {:.6f} north, {:.6f} up, towards the sun\n", d.x, d.y, d.z);
  if (d.z <= 0.0) return text + "light      none: the sun is below the horizon\n";
  return text + fmt::format("light      {} (Z up)\n           {} (Y up)\n", lightZUp(d), lightYUp(d));
}

std::string answerJson(const SunOptions& options, const Answer& answer) {
  return jsonText({{"latitude", options.place.latitude.value_or(0.0)},
                   {"longitude", options.place.longitude.value_or(0.0)},
                   {"date", sun::dateText(options.place.date)},
                   {"time", sun::timeText(options.time)},
                   {"zone", options.place.zone.name},
                   {"utc", utcText(answer)},
                   {"elevation", answer.position.elevation.degrees()},
                   {"azimuth", answer.position.azimuth.degrees()},
                   {"direction", toJson(answer.direction)},
                   {"conventions",
                    "degrees; geometric centre of the disc, no refraction; azimuth clockwise from true north; "
                    "direction towards the sun as east, north, up"},
                   {"light_z_up", lightZUp(answer.direction)},
                   {"light_y_up", lightYUp(answer.direction)}});
}

Result<Outcome> run(const SunOptions& options, const Console& console) {
  const auto place = placeOf(options.place);
  if (!place) return tl::unexpected(place.error());
  const auto moment = sun::instantOf(options.place.zone, *place, {options.place.date, options.time});
  if (!moment) return tl::unexpected(moment.error());
  if (moment->warning) console.warn(*moment->warning);
  const auto position = sun::sunPosition(*place, moment->instant);
  const Answer answer{*place,
                      moment->instant,
                      sun::clockAt(sun::Zone{}, *place, moment->instant),
                      sun::clockAt(options.place.zone, *place, moment->instant),
                      position,
                      sun::eastNorthUp(position)};
  return Outcome{options.json ? answerJson(options, answer) : answerText(options, answer), 0};
}

}  // namespace

Run addSun(CLI::App& app) {
  const auto options = std::make_shared<SunOptions>();
  addPlaceOptions(app, options->place);
  addValue(app, "--at", "HH:MM[:SS]", "The time on that clock", options->time, sun::parseTime,
           {.group = "Place and time", .required = true});
  addFlag(app, "--json", "As JSON", options->json);
  addAnswer(app, "--self-check", "",
            "Holds this program's sun, days and times of shadow against ERFA by another road, and no more; exit code 1 "
            "where they differ by more than they should",
            selfCheck);
  return [options](const Console& console) { return run(*options, console); };
}

}  // namespace umbrage::cli

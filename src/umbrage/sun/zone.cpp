#include "umbrage/sun/zone.hpp"

#include <date/tz.h>
#include <erfaextra.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <exception>
#include <fstream>

namespace umbrage::sun {
namespace {

using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;
using std::chrono::year_month_day;

using LocalSeconds = date::local_seconds;

constexpr milliseconds kDay = std::chrono::hours(24);
constexpr int kLastTabledYear = 2037;

std::optional<int> number(std::string_view digits) {
  if (digits.empty() ||
      !std::all_of(digits.begin(), digits.end(), [](unsigned char c) { return std::isdigit(c) != 0; }))
    return std::nullopt;
  int value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return error == std::errc() && end == digits.data() + digits.size() ? std::optional(value) : std::nullopt;
}

// ---- zones

std::string lowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

// Zones whose city, or whole name, is the one asked for but for case: what somebody who wrote "vienna" meant.
std::string suggestion(std::string_view text) {
  const std::string wanted = lowerCase(text.substr(text.rfind('/') == text.npos ? 0 : text.rfind('/') + 1));
  std::string found;
  for (const date::time_zone& zone : date::get_tzdb().zones) {
    const std::string name = lowerCase(zone.name());
    if (wanted.empty() || name.substr(name.rfind('/') == name.npos ? 0 : name.rfind('/') + 1) != wanted) continue;
    found += (found.empty() ? "; did you mean " : " or ") + zone.name();
  }
  return found;
}

Result<Zone> parseOffset(std::string_view text) {
  const auto hours = text.size() == 6 && text[3] == ':' ? number(text.substr(1, 2)) : std::nullopt;
  const auto rest = text.size() == 6 ? number(text.substr(4, 2)) : std::nullopt;
  if (!hours || !rest || *rest > 59 || *hours * 60 + *rest > 18 * 60)
    return fail(ErrorCode::usage,
                fmt::format("'{}' is no offset from UTC; write +HH:MM or -HH:MM, at most 18:00", text));
  const minutes offset(*hours * 60 + *rest);
  return Zone{Zone::Kind::fixed, std::string(text), text[0] == '-' ? -offset : offset};
}

// ---- the named zones' rules

bool isTabled(const date::sys_info& info) {
  return date::year_month_day(date::floor<date::days>(info.end)).year() < date::year(3000);
}

// Whole days back to the time of year, with the same weekdays, of a common year in 2027..2037; rules name weekdays of
// months, so January and February are matched by New Year's weekday and the rest by that of 1 March.
date::days toTabledYears(date::local_days day) {
  const date::year_month_day date(day);
  const bool early = date.month() <= date::February;
  const auto reference = [&](date::year y) { return date::local_days(y / (early ? date::January : date::March) / 1); };
  for (int y = kLastTabledYear; y > kLastTabledYear - 11; --y) {
    const date::year year(y);
    if (!year.is_leap() && date::weekday(reference(year)) == date::weekday(reference(date.year())))
      return reference(date.year()) - reference(year);
  }
  return date::days(0);
}

bool isBeyondTable(const date::sys_info& info, date::year year) {
  return int(year) > kLastTabledYear && !isTabled(info);
}

date::local_info localInfo(const date::time_zone& zone, LocalSeconds local, date::days& shift) {
  auto info = zone.get_info(local);
  const auto day = date::floor<date::days>(local);
  if (!isBeyondTable(info.first, date::year_month_day(day).year())) return info;
  shift = toTabledYears(day);
  return zone.get_info(local - shift);
}

date::sys_info sysInfo(const date::time_zone& zone, date::sys_seconds instant) {
  const auto info = zone.get_info(instant);
  const auto day = date::floor<date::days>(instant);
  if (!isBeyondTable(info, date::year_month_day(day).year())) return info;
  return zone.get_info(instant - toTabledYears(date::local_days(day.time_since_epoch())));
}

std::string clockText(date::sys_seconds instant, seconds offset) {
  const auto local = instant + offset;
  return timeText(local - date::floor<date::days>(local));
}

// A reading of a named zone's clock, and what is known about it.
struct NamedReading {
  std::string asked;
  LocalSeconds local;
  milliseconds rest{0};
  date::days shift{0};  // to years whose rules are tabled
  date::local_info info;
};

NamedReading readNamed(const Zone& zone, const ClockTime& clock) {
  NamedReading r;
  r.local =
      LocalSeconds(std::chrono::floor<seconds>(std::chrono::sys_days(clock.date).time_since_epoch() + clock.time));
  r.rest = clock.time - std::chrono::floor<seconds>(clock.time);
  r.info = localInfo(*date::locate_zone(zone.name), r.local, r.shift);
  r.asked = fmt::format("{} on {}", timeText(clock.time), dateText(clock.date));
  return r;
}

bool isLeftOut(const NamedReading& r) { return r.info.result == date::local_info::nonexistent; }

std::string leftOutText(const NamedReading& r, const Zone& zone) {
  return fmt::format("{} does not exist in {}: clocks were put forward from {} to {}", r.asked, zone.name,
                     clockText(r.info.first.end, r.info.first.offset),
                     clockText(r.info.second.begin, r.info.second.offset));
}

Moment momentOf(const NamedReading& r, const Zone& zone, Twice twice) {
  const bool isTwice = r.info.result == date::local_info::ambiguous, second = isTwice && twice == Twice::second;
  const date::sys_info& taken = second ? r.info.second : r.info.first;
  Moment moment{Instant(r.local.time_since_epoch() - taken.offset + r.rest), std::nullopt};
  if (isTwice)
    moment.warning =
        fmt::format("{} occurs twice in {}: taken as the {}, {} (UTC{}), {} clocks were put back", r.asked, zone.name,
                    second ? "second" : "first", taken.abbrev, offsetText(taken.offset), second ? "after" : "before");
  return moment;
}

Instant instantOfSolar(const Place& place, const ClockTime& clock) {
  const milliseconds east(std::llround(place.longitude.degrees() / 360.0 * double(kDay.count())));
  const Instant mean = std::chrono::sys_days(clock.date) + clock.time - east;
  return instantOfHourAngle(place, mean,
                            Angle::degrees(360.0 * (double(clock.time.count()) / double(kDay.count()) - 0.5)));
}

ClockReading reading(Instant instant, milliseconds offset, std::string abbreviation = {}) {
  const Instant local = instant + offset;
  const auto day = std::chrono::floor<std::chrono::days>(local);
  return {{year_month_day(day), local - day}, std::chrono::round<seconds>(offset), std::move(abbreviation)};
}

ClockReading solarClock(const Place& place, Instant instant) {
  // The equation of time, at most 17 minutes, carries the mean solar clock to the true one.
  const double meanHours = double((instant - std::chrono::floor<std::chrono::days>(instant)).count()) / 3.6e6 +
                           place.longitude.degrees() / 15.0;
  const double trueHours = hourAngle(place, instant).degrees() / 15.0 + 12.0;
  const double equation = std::remainder(trueHours - meanHours, 24.0);
  const double offsetHours = place.longitude.degrees() / 15.0 + equation;
  return reading(instant, milliseconds(std::llround(offsetHours * 3.6e6)));
}

// "2025b"; empty where the system does not say. Its own files carry the release in the first line of one of them.
std::string releaseOfZones() {
  try {
    if (const std::string known = date::get_tzdb().version; !known.empty() && known != "unknown") return known;
  } catch (const std::exception&) {
    return {};
  }
  constexpr std::string_view kBefore = "# version ";
  std::ifstream file("/usr/share/zoneinfo/tzdata.zi");
  std::string line;
  std::getline(file, line);
  return line.starts_with(kBefore) && line.size() < 40 ? line.substr(kBefore.size()) : std::string();
}

}  // namespace

Result<Zone> parseZone(std::string_view text) {
  if (text == "solar") return Zone{Zone::Kind::solar, "solar", {}};
  if (text == "Z") return Zone{Zone::Kind::fixed, "Z", {}};
  if (!text.empty() && (text[0] == '+' || text[0] == '-')) return parseOffset(text);
  try {
    const auto& zones = date::get_tzdb().zones;
    if (zones.empty())
      return fail(ErrorCode::usage, fmt::format("time zone '{}' is not known, for this system has no time zone data "
                                                "(Debian: the package tzdata); +HH:MM and 'solar' work without them",
                                                text));
    const bool known = std::any_of(zones.begin(), zones.end(), [&](const auto& zone) { return zone.name() == text; });
    if (known) {
      const Zone zone{Zone::Kind::named, std::string(text), {}};
      static_cast<void>(date::locate_zone(zone.name)->get_info(date::sys_seconds{}));  // its file is read here
      return zone;
    }
    return fail(ErrorCode::usage,
                fmt::format("unknown time zone '{}': an IANA name such as Europe/Vienna, +HH:MM or 'solar' "
                            "is wanted{}",
                            text, suggestion(text)));
  } catch (const std::exception& fault) {
    return fail(ErrorCode::usage, fmt::format("time zone '{}' cannot be read from the system's tzdata ({}); +HH:MM and "
                                              "'solar' work without it",
                                              text, fault.what()));
  }
}

std::string versions(const Zone& zone) {
  std::string text = std::string("ERFA ") + eraVersion();
  if (zone.kind != Zone::Kind::named) return text;
  const std::string release = releaseOfZones();
  return text + ", tzdata " + (release.empty() ? "of an unknown release" : release);
}

Result<year_month_day> parseDate(std::string_view text) {
  const bool shaped = text.size() == 10 && text[4] == '-' && text[7] == '-';
  const auto y = shaped ? number(text.substr(0, 4)) : std::nullopt;
  const auto m = shaped ? number(text.substr(5, 2)) : std::nullopt;
  const auto d = shaped ? number(text.substr(8, 2)) : std::nullopt;
  if (!y || !m || !d) return fail(ErrorCode::usage, fmt::format("'{}' is no date; write YYYY-MM-DD", text));
  if (*y < kFirstYear || *y > kLastYear)
    return fail(ErrorCode::usage,
                fmt::format("{}: the sun is known here for the years {} to {}", text, kFirstYear, kLastYear));
  const year_month_day date{std::chrono::year(*y), std::chrono::month(unsigned(*m)), std::chrono::day(unsigned(*d))};
  if (!date.ok()) return fail(ErrorCode::usage, fmt::format("{} is not a day of the calendar", text));
  return date;
}

Result<milliseconds> parseTime(std::string_view text) {
  const bool shaped = (text.size() == 5 || text.size() == 8) && text[2] == ':' && (text.size() == 5 || text[5] == ':');
  const auto h = shaped ? number(text.substr(0, 2)) : std::nullopt;
  const auto m = shaped ? number(text.substr(3, 2)) : std::nullopt;
  const auto s = shaped && text.size() == 8 ? number(text.substr(6, 2)) : std::optional(0);
  if (!h || !m || !s || *m > 59 || *s > 59 || *h * 3600 + *m * 60 + *s > 86400)
    return fail(ErrorCode::usage, fmt::format("'{}' is no time of day; write HH:MM or HH:MM:SS, 00:00 to 24:00", text));
  return std::chrono::hours(*h) + minutes(*m) + seconds(*s);
}

Result<Place> makePlace(double latitudeDegrees, double longitudeDegrees) {
  if (!(std::abs(latitudeDegrees) <= 90.0))
    return fail(ErrorCode::usage,
                fmt::format("latitude {}: -90 to 90 degrees are wanted, north positive", latitudeDegrees));
  if (!(longitudeDegrees >= -180.0 && longitudeDegrees <= 360.0))
    return fail(ErrorCode::usage,
                fmt::format("longitude {}: -180 to 180 degrees are wanted, east positive", longitudeDegrees));
  const double longitude = longitudeDegrees > 180.0 ? longitudeDegrees - 360.0 : longitudeDegrees;
  return Place{Angle::degrees(latitudeDegrees), Angle::degrees(longitude)};
}

Result<Moment> instantOf(const Zone& zone, const Place& place, const ClockTime& clock) {
  if (zone.kind == Zone::Kind::solar) return Moment{instantOfSolar(place, clock), std::nullopt};
  if (zone.kind == Zone::Kind::fixed)
    return Moment{std::chrono::sys_days(clock.date) + clock.time - zone.offset, std::nullopt};
  const NamedReading reading = readNamed(zone, clock);
  if (isLeftOut(reading)) return fail(ErrorCode::usage, leftOutText(reading, zone));
  return momentOf(reading, zone, Twice::first);
}

Moment nearestInstantOf(const Zone& zone, const Place& place, const ClockTime& clock, Twice twice) {
  if (zone.kind != Zone::Kind::named) return *instantOf(zone, place, clock);
  const NamedReading reading = readNamed(zone, clock);
  if (!isLeftOut(reading)) return momentOf(reading, zone, twice);
  const date::sys_seconds jump = reading.info.first.end + reading.shift;
  return {Instant(jump.time_since_epoch()),
          leftOutText(reading, zone) + "; taken as the moment at which they were put forward"};
}

ClockReading clockAt(const Zone& zone, const Place& place, Instant instant) {
  if (zone.kind == Zone::Kind::solar) return solarClock(place, instant);
  if (zone.kind == Zone::Kind::fixed) return reading(instant, zone.offset);
  const auto info = sysInfo(*date::locate_zone(zone.name), std::chrono::floor<seconds>(instant));
  return reading(instant, info.offset, info.abbrev);
}

std::string dateText(year_month_day date) {
  return fmt::format("{:04}-{:02}-{:02}", int(date.year()), unsigned(date.month()), unsigned(date.day()));
}

std::string timeText(milliseconds time) {
  const auto total = std::chrono::round<seconds>(time).count();
  const auto hours = total / 3600, rest = total / 60 % 60, second = total % 60;
  return second == 0 ? fmt::format("{:02}:{:02}", hours, rest) : fmt::format("{:02}:{:02}:{:02}", hours, rest, second);
}

std::string offsetText(seconds offset) {
  const auto total = std::abs(offset.count());
  const std::string text = fmt::format("{}{:02}:{:02}", offset.count() < 0 ? '-' : '+', total / 3600, total / 60 % 60);
  return total % 60 == 0 ? text : text + fmt::format(":{:02}", total % 60);
}

std::string offsetText(const ClockReading& reading) {
  const std::string& letters = reading.abbreviation;
  // Zones without letters of their own are abbreviated by their offset.
  const bool lettered = !letters.empty() && letters[0] != '+' && letters[0] != '-';
  return "UTC" + offsetText(reading.offset) + (lettered ? " (" + letters + ")" : "");
}

}  // namespace umbrage::sun

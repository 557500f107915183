#include "umbrage/io/reader/building_height.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <span>
#include <string_view>

#include "umbrage/io/reader/json_access.hpp"

namespace umbrage::io::reader {
namespace {

// In the order in which they are believed.
constexpr std::array<std::string_view, 13> kHeights = {
    "height",       "measuredheight", "buildingheight", "bldgheight", "heightm", "heightmetres", "heightmeters",
    "renderheight", "hoehe",          "hohe",           "hauteur",    "altura",  "hoogte"};
constexpr std::array<std::string_view, 14> kFloors = {
    "buildinglevels", "levels",  "floors",  "numfloors", "nfloors",  "numlevels", "floorcount",
    "numberoffloors", "storeys", "stories", "geschosse", "nbetages", "etages",    "bouwlagen"};
constexpr std::array<std::string_view, 4> kBases = {"minheight", "buildingminheight", "baseheight", "renderminheight"};
constexpr std::array<std::string_view, 2> kBaseFloors = {"buildingminlevel", "minlevel"};
constexpr double kFoot = 0.3048;

std::string plain(std::string_view name) {
  std::string letters;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c)))
      letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return letters;
}

// Metres in one of the unit that stands behind a number.
std::optional<double> unitNamed(const std::string& name) {
  if (name.empty() || name == "m" || name.starts_with("metre") || name.starts_with("meter")) return 1.0;
  if (name == "ft" || name == "feet" || name == "foot" || name == "'") return kFoot;
  return std::nullopt;
}

std::optional<double> lengthIn(std::string text) {
  std::replace(text.begin(), text.end(), ',', '.');
  const auto isBlank = [](unsigned char c) { return std::isspace(c) != 0; };
  std::erase_if(text, isBlank);
  double value = 0.0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (read.ec != std::errc()) return std::nullopt;
  const auto unit = unitNamed(text.substr(static_cast<std::size_t>(read.ptr - text.data())));
  return unit ? std::optional(value * *unit) : std::nullopt;
}

bool hasValue(const Json& value) {
  return !value.is_null() && !(value.is_string() && value.get<std::string>().empty());
}

std::optional<double> lengthOf(const Json& value) {
  const auto length = value.is_string() ? lengthIn(value.get<std::string>()) : numberOf(value);
  return length && std::isfinite(*length) ? length : std::nullopt;
}

using Named = std::map<std::string, const Json*>;

Named namedProperties(const Json& properties) {
  Named named;
  if (properties.is_object())
    for (const auto& [name, value] : properties.items())
      if (hasValue(value)) named.try_emplace(plain(name), &value);
  return named;
}

const Json* firstOf(const Named& named, std::span<const std::string_view> names) {
  for (const std::string_view name : names)
    if (const auto found = named.find(std::string(name)); found != named.end()) return found->second;
  return nullptr;
}

double baseOf(const Named& named, const HeightRules& rules) {
  if (const Json* base = firstOf(named, kBases)) return lengthOf(*base).value_or(0.0);
  if (const Json* floors = firstOf(named, kBaseFloors)) return lengthOf(*floors).value_or(0.0) * rules.floorHeight;
  return 0.0;
}

std::variant<BuildingHeight, HeightFault> checked(BuildingHeight height) {
  if (height.top <= 0.0 || height.top <= height.base) return HeightFault::notPositive;
  if (height.top > kTallest || height.base < -kTallest) return HeightFault::tooTall;
  return height;
}

}  // namespace

std::variant<BuildingHeight, HeightFault> heightOf(const Json& properties, const HeightRules& rules) {
  const Named named = namedProperties(properties);
  BuildingHeight height{baseOf(named, rules), 0.0};
  const Json* given =
      rules.property ? firstOf(named, std::array{std::string_view(plain(*rules.property))}) : firstOf(named, kHeights);
  const Json* floors = rules.property ? nullptr : firstOf(named, kFloors);
  if (given == nullptr && floors == nullptr) {
    if (!rules.fallback) return HeightFault::absent;
    return checked({height.base, height.base + *rules.fallback, false, true});
  }
  height.fromFloors = given == nullptr;
  const auto length = lengthOf(given != nullptr ? *given : *floors);
  if (!length) return HeightFault::notANumber;
  height.top = height.fromFloors ? *length * rules.floorHeight : *length;
  return checked(height);
}

}  // namespace umbrage::io::reader

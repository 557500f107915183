#include "parse.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "umbrage/shadow/composite.hpp"

namespace umbrage::cli {
namespace {

constexpr double kFarthest = 1e12;
constexpr int kLargestSide = 16384;
constexpr long kMostPixels = 1L << 26;

tl::unexpected<Error> refuse(std::string_view text, std::string_view expected) {
  return fail(ErrorCode::usage, fmt::format("'{}' is not {}", text, expected));
}

bool isDigit(char c) { return c >= '0' && c <= '9'; }

std::optional<int> wholeNumber(std::string_view text) {
  int value = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || !isDigit(text.front()) || failure != std::errc{} || end != text.data() + text.size())
    return std::nullopt;
  return value;
}

Result<std::vector<double>> numbers(std::span<const std::string_view> words) {
  std::vector<double> values;
  for (const auto word : words) {
    const auto value = parseNumber(word, -kFarthest, kFarthest);
    if (!value) return tl::unexpected(value.error());
    values.push_back(*value);
  }
  return values;
}

struct LightKind {
  std::string_view name;
  std::size_t count;
  std::string_view form;
};
constexpr std::array<LightKind, 7> kLightKinds{{{"point", 3, "point:x,y,z"},
                                                {"directional", 3, "directional:dx,dy,dz"},
                                                {"spot", 7, "spot:x,y,z,dx,dy,dz,CUTOFF_DEG"},
                                                {"disc", 7, "disc:x,y,z,dx,dy,dz,RADIUS"},
                                                {"rect", 9, "rect:x,y,z,ux,uy,uz,vx,vy,vz"},
                                                {"sphere", 4, "sphere:x,y,z,RADIUS"},
                                                {"sun", 4, "sun:dx,dy,dz,DIAMETER_DEG"}}};
constexpr std::string_view kLightForms =
    "point:x,y,z, directional:dx,dy,dz, spot:x,y,z,dx,dy,dz,CUTOFF_DEG, disc:x,y,z,dx,dy,dz,RADIUS, "
    "rect:x,y,z,ux,uy,uz,vx,vy,vz, sphere:x,y,z,RADIUS or "
    "sun:dx,dy,dz,DIAMETER_DEG, each with an optional ,#rrggbb[,intensity]";

using Shape = decltype(scene::Light::shape);

// Of lights with an extent: that they have one.
Result<Shape> checked(std::string_view text, Shape shape) {
  if (scene::isValid({shape})) return shape;
  return fail(ErrorCode::usage, fmt::format("'{}' has no extent: a radius or diameter must be above 0 (a sun's below "
                                            "180 degrees), and a rectangle's half sides not in line",
                                            text));
}

Result<Shape> makeShape(std::string_view text, std::string_view kind, const std::vector<double>& v) {
  const Vec3 first(v[0], v[1], v[2]);
  if (kind == "point") return Shape(scene::PointLight{first});
  if (kind == "sphere") return checked(text, scene::SphereLight{first, v[3]});
  if (kind == "rect")
    return checked(text, scene::RectangleLight{first, Vec3(v[3], v[4], v[5]), Vec3(v[6], v[7], v[8])});
  const Vec3 direction = kind == "spot" || kind == "disc" ? Vec3(v[3], v[4], v[5]) : first;
  if (direction == Vec3(0.0))
    return fail(ErrorCode::usage, fmt::format("'{}' has no direction: 0,0,0 points nowhere", text));
  if (kind == "directional") return Shape(scene::DirectionalLight{direction});
  if (kind == "disc") return checked(text, scene::DiscLight{first, direction, v[6]});
  if (kind == "sun") return checked(text, scene::SunLight{direction, Angle::degrees(v[3] / 2)});
  if (!(v[6] > 0.0 && v[6] <= 180.0))
    return fail(ErrorCode::usage,
                fmt::format("'{}' has a cutoff of {} degrees; it must be above 0 and at most 180", text, v[6]));
  return Shape(scene::SpotLight{first, direction, Angle::degrees(v[6])});
}

// The words after the numbers: nothing, a colour, or a colour and an intensity.
Result<void> readColourAndIntensity(std::span<const std::string_view> words, scene::Light& light) {
  if (words.empty()) return {};
  const auto colour = parseColour(words[0]);
  if (!colour) return tl::unexpected(colour.error());
  light.colour = *colour;
  if (words.size() < 2) return {};
  const auto intensity = parseNumber(words[1], 0.0, 1e6);
  if (!intensity) return tl::unexpected(intensity.error());
  light.intensity = *intensity;
  return {};
}

}  // namespace

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> pieces;
  while (true) {
    const auto end = text.find(separator);
    pieces.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return pieces;
    text.remove_prefix(end + 1);
  }
}

Result<double> parseNumber(std::string_view text) {
  std::string_view digits = text;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double value = 0.0;
  const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool doubleSign = text.starts_with("+-");
  if (digits.empty() || doubleSign || failure == std::errc::invalid_argument || end != digits.data() + digits.size())
    return refuse(text, "a number");
  if (failure != std::errc{} || !std::isfinite(value)) return refuse(text, "a finite number");
  return value;
}

Result<double> parseNumber(std::string_view text, double low, double high) {
  const auto value = parseNumber(text);
  if (value && !(*value >= low && *value <= high)) return refuse(text, fmt::format("between {:g} and {:g}", low, high));
  return value;
}

Result<std::string> parseWord(std::string_view text) {
  if (text.empty()) return fail(ErrorCode::usage, "is empty");
  return std::string(text);
}

Result<Angle> parseDegrees(std::string_view text, double low, double high) {
  const auto value = parseNumber(text, low, high);
  if (!value) return tl::unexpected(value.error());
  return Angle::degrees(*value);
}

Result<Vec3> parsePoint(std::string_view text) {
  const auto words = split(text, ',');
  if (words.size() != 3) return refuse(text, "x,y,z: three numbers with commas and no spaces");
  const auto values = numbers(words);
  if (!values) return tl::unexpected(values.error());
  return Vec3((*values)[0], (*values)[1], (*values)[2]);
}

Result<Size> parseSize(std::string_view text) {
  const auto words = split(text, 'x');
  if (words.size() != 2) return refuse(text, "WIDTHxHEIGHT, for example 1280x720");
  const auto width = wholeNumber(words[0]);
  const auto height = wholeNumber(words[1]);
  if (!width || !height) return refuse(text, "WIDTHxHEIGHT in whole pixels, for example 1280x720");
  if (*width < 1 || *height < 1 || *width > kLargestSide || *height > kLargestSide)
    return fail(ErrorCode::usage, fmt::format("'{}': each side must be 1 to {} pixels", text, kLargestSide));
  if (long{*width} * *height > kMostPixels)
    return fail(ErrorCode::usage,
                fmt::format("'{}' is too large: at most {} pixels in all, for example 8192x8192", text, kMostPixels));
  return Size{*width, *height};
}

Result<Vec3> parseColour(std::string_view text) {
  unsigned code = 0;
  const bool form = text.size() == 7 && text.front() == '#';
  if (!form) return refuse(text, "a colour #rrggbb");
  const auto [end, failure] = std::from_chars(text.data() + 1, text.data() + 7, code, 16);
  if (failure != std::errc{} || end != text.data() + 7) return refuse(text, "a colour #rrggbb");
  const auto channel = [&](unsigned shift) {
    return shadow::decodeSrgb(static_cast<std::uint8_t>(code >> shift & 0xffU));
  };
  return Vec3(channel(16), channel(8), channel(0));
}

Result<scene::Light> parseLight(std::string_view text) {
  const auto colon = text.find(':');
  const auto name = text.substr(0, colon);
  const auto* kind =
      std::find_if(kLightKinds.begin(), kLightKinds.end(), [&](const LightKind& k) { return k.name == name; });
  if (colon == std::string_view::npos || kind == kLightKinds.end())
    return refuse(text, fmt::format("a light: {}", kLightForms));

  const auto words = split(text.substr(colon + 1), ',');
  const std::span all(words);
  if (all.size() < kind->count || all.size() > kind->count + 2)
    return refuse(text, fmt::format("{}[,#rrggbb[,intensity]]", kind->form));
  const auto values = numbers(all.first(kind->count));
  if (!values) return fail(ErrorCode::usage, fmt::format("{} in '{}'", values.error().message, text));
  auto shape = makeShape(text, name, *values);
  if (!shape) return tl::unexpected(shape.error());

  scene::Light light{*shape, Vec3(1.0), 1.0, std::string(text)};
  if (const auto read = readColourAndIntensity(all.subspan(kind->count), light); !read)
    return fail(ErrorCode::usage, fmt::format("{} in '{}'", read.error().message, text));
  return light;
}

Result<scene::UpAxis> parseUp(std::string_view text) {
  if (text == "y" || text == "Y") return scene::UpAxis::y;
  if (text == "z" || text == "Z") return scene::UpAxis::z;
  return refuse(text, "y or z");
}

Result<double> parseUnit(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, double>, 5> units{
      {{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"ft", 0.3048}, {"in", 0.0254}}};
  for (const auto& [name, metres] : units)
    if (name == text) return metres;
  return refuse(text, "one of m, cm, mm, ft, in");
}

Result<shadow::FinderKind> parseFinder(std::string_view text) {
  if (const auto kind = shadow::finderNamed(text)) return *kind;
  std::vector<std::string_view> names;
  for (const shadow::FinderKind kind : shadow::allFinderKinds()) names.push_back(shadow::name(kind));
  return refuse(text, fmt::format("one of {}", fmt::join(names, ", ")));
}

Result<std::vector<std::string>> parseWords(std::string_view text, const std::vector<std::string>& allowed) {
  std::vector<std::string> words;
  for (const auto word : split(text, ',')) {
    if (std::find(allowed.begin(), allowed.end(), word) == allowed.end())
      return refuse(word, fmt::format("one of {}", fmt::join(allowed, ", ")));
    if (std::find(words.begin(), words.end(), word) == words.end()) words.emplace_back(word);
  }
  return words;
}

}  // namespace umbrage::cli

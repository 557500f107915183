#include "technique_options.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "declare.hpp"
#include "parse.hpp"

namespace umbrage::cli {
namespace {

constexpr Manner kTechniques{.group = "Techniques"};
constexpr int kLargestMap = 65536, kWidestFilter = 16;

Result<StencilCounter> parseCounter(std::string_view word) {
  if (word == "exact") return StencilCounter::exact;
  if (word == "wrap") return StencilCounter::wrap;
  if (word == "saturate") return StencilCounter::saturate;
  return fail(ErrorCode::usage, "must be one of exact, wrap, saturate");
}

Result<int> wholeIn(std::string_view word, int low, int high) {
  const auto number = parseNumber(word, low, high);
  if (!number || *number != std::floor(*number))
    return fail(ErrorCode::usage, fmt::format("must be a whole number from {} to {}", low, high));
  return static_cast<int>(*number);
}

Result<shadow::Plane> parsePlane(std::string_view word) {
  const auto words = split(word, ',');
  std::array<double, 6> values{};
  bool good = words.size() == values.size();
  for (std::size_t i = 0; good && i < values.size(); ++i) {
    const auto value = parseNumber(words[i], -1e12, 1e12);
    good = value.has_value();
    if (good) values[i] = *value;
  }
  const Vec3 normal(values[3], values[4], values[5]);
  if (!good || !(glm::length(normal) > 0.0))
    return fail(ErrorCode::usage, "must be x,y,z,nx,ny,nz: a point of the plane and its normal");
  return shadow::Plane{{values[0], values[1], values[2]}, normal};
}

Result<std::optional<Vec2>> parseBias(std::string_view word) {
  const auto words = split(word, ',');
  if (words.size() == 2) {
    const auto constant = parseNumber(words[0], 0.0, 1.0), slope = parseNumber(words[1], 0.0, 100.0);
    if (constant && slope) return std::optional(Vec2(*constant, *slope));
  }
  return fail(ErrorCode::usage, "must be CONSTANT,SLOPE: 0 to 1, and 0 to 100");
}

}  // namespace

void addTechniqueOptions(CLI::App& app, TechniqueOptions& options) {
  addValue(app, "--stencil-counter", "exact|wrap|saturate",
           "What counts do that 8 bits of stencil cannot hold; wrap and saturate give wrong shadows, to show what the "
           "first engines had to live with (default exact)",
           options.counter, parseCounter, kTechniques);
  addValue(
      app, "--planes", "N",
      "planar: the N largest planes of the scene, 1 to 127 (default: those that are large enough, at most 64)",
      options.planes,
      [&options](std::string_view word) -> Result<shadow::PlaneSearch> {
        const auto most = wholeIn(word, 1, static_cast<int>(shadow::kMostPlanes));
        if (!most) return tl::unexpected(most.error());
        return shadow::PlaneSearch{static_cast<std::size_t>(*most), 0.0, options.planes.given};
      },
      kTechniques);
  addValues(
      app, "--plane", "X,Y,Z,NX,NY,NZ",
      "planar: this plane (a point and a normal) and no others; repeatable, at most 127", options.planes.given,
      [&options](std::string_view word) -> Result<shadow::Plane> {
        if (options.planes.given.size() == shadow::kMostPlanes)
          return fail(ErrorCode::usage, fmt::format("at most {} planes", shadow::kMostPlanes));
        return parsePlane(word);
      },
      kTechniques);
  addValue(
      app, "--map-size", "N|auto",
      "Shadow maps: texels a side, 16 to 65536, as far as the driver goes (default auto: as the picture asks for)",
      options.mapTexels,
      [](std::string_view word) { return word == "auto" ? Result<int>(0) : wholeIn(word, 16, kLargestMap); },
      kTechniques);
  addValue(
      app, "--map-filter", "N",
      "Shadow maps: texels around the nearest that are compared too, 0 to 16 (default 1; 0: hard shadows)",
      options.mapFilter, [](std::string_view word) { return wholeIn(word, 0, kWidestFilter); }, kTechniques);
  addValue(
      app, "--map-bias", "C,S",
      "Shadow maps: how much nearer to the light a caster must be, in the depth of the map, and in the surface's slope "
      "over a texel (default 0.00006,0.25)",
      options.mapBias, parseBias, kTechniques);
}

}  // namespace umbrage::cli

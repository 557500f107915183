#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "umbrage/base/angle.hpp"
#include "umbrage/base/error.hpp"
#include "umbrage/math/vec.hpp"
#include "umbrage/scene/camera.hpp"
#include "umbrage/scene/light.hpp"
#include "umbrage/shadow/finders/finder.hpp"

// The words of the command line as values. Every function takes the whole word or refuses it; its error
// (ErrorCode::usage) says what was expected, without the option's name, which the caller puts before it.
namespace umbrage::cli {

struct Size {
  int width = 1280;
  int height = 720;
};

/// A finite decimal number: digits with an optional sign, point and exponent; no spaces, no hexadecimal, whatever the
/// locale.
[[nodiscard]] Result<double> parseNumber(std::string_view text);
/// The same, from `low` to `high`, both included.
[[nodiscard]] Result<double> parseNumber(std::string_view text, double low, double high);

/// Any word but an empty one.
[[nodiscard]] Result<std::string> parseWord(std::string_view text);

/// Degrees from `low` to `high`, both included.
[[nodiscard]] Result<Angle> parseDegrees(std::string_view text, double low, double high);

/// "x,y,z", each within +-1e12 so that no later arithmetic overflows.
[[nodiscard]] Result<Vec3> parsePoint(std::string_view text);

/// "WxH", each side 1 to 16384, at most 67,108,864 pixels.
[[nodiscard]] Result<Size> parseSize(std::string_view text);

/// "#rrggbb" (sRGB) as linear RGB.
[[nodiscard]] Result<Vec3> parseColour(std::string_view text);

/// "point:x,y,z", "directional:dx,dy,dz", "spot:x,y,z,dx,dy,dz,CUTOFF_DEG", each with optional ",#rrggbb[,intensity]".
[[nodiscard]] Result<scene::Light> parseLight(std::string_view text);

/// "y" or "z".
[[nodiscard]] Result<scene::UpAxis> parseUp(std::string_view text);

/// "m", "cm", "mm", "ft" or "in", as metres.
[[nodiscard]] Result<double> parseUnit(std::string_view text);

/// Words between commas, each one of `allowed`; a word given twice counts once.
[[nodiscard]] Result<std::vector<std::string>> parseWords(std::string_view text,
                                                          const std::vector<std::string>& allowed);

/// A name of a silhouette finder, or "auto".
[[nodiscard]] Result<shadow::FinderKind> parseFinder(std::string_view text);

/// The pieces between separators; one more than there are separators.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);

}  // namespace umbrage::cli

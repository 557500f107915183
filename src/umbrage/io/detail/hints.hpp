#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace umbrage::io::detail {

/// A part of a raster, and from where on what lies around it matters (io::RasterTile).
struct TileHint {
  int column = 0, row = 0, columns = 0, rows = 0;
  double slope = 0.0;
  double highest = 0.0;
};

/// What the caller knows about the inside of a file, as it is told to the reader process.
struct Hints {
  std::optional<std::string> lod;
  std::optional<std::string> crs;
  std::optional<std::string> heightProperty;
  std::optional<double> defaultHeight;
  double floorHeight = 3.0;
  std::optional<TileHint> tile = std::nullopt;
  bool inspectOnly = false;
  std::size_t alphaTriangles = 250'000;
  std::size_t alphaLevel = 0;  ///< cells of 2^this texels on a side
};

/// As "key=value" words, and back. Words that are not known are passed over; a number that is none is left at its default.
[[nodiscard]] std::vector<std::string> wordsOf(const Hints& hints);
[[nodiscard]] Hints hintsOf(std::span<const std::string> words);

}  // namespace umbrage::io::detail

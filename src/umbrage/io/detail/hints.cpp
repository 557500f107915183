#include "umbrage/io/detail/hints.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

namespace umbrage::io::detail {
namespace {

std::string numberText(double value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::optional<double> numberIn(std::string_view text) {
  double value = 0.0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  return read.ec == std::errc() && read.ptr == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

std::size_t countIn(std::string_view text, std::size_t otherwise) {
  return static_cast<std::size_t>(std::clamp(numberIn(text).value_or(double(otherwise)), 0.0, 1e9));
}

std::optional<TileHint> tileIn(std::string_view text) {
  std::array<double, 6> numbers{};
  for (double& number : numbers) {
    const auto comma = std::min(text.find(','), text.size());
    const auto value = numberIn(text.substr(0, comma));
    if (!value) return std::nullopt;
    number = *value;
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  const auto whole = [&](std::size_t i) { return static_cast<int>(std::clamp(numbers[i], -2e9, 2e9)); };
  return TileHint{whole(0), whole(1), whole(2), whole(3), numbers[4], numbers[5]};
}

}  // namespace

std::vector<std::string> wordsOf(const Hints& hints) {
  std::vector<std::string> words;
  if (hints.lod) words.push_back("lod=" + *hints.lod);
  if (hints.crs) words.push_back("crs=" + *hints.crs);
  if (hints.heightProperty) words.push_back("height-property=" + *hints.heightProperty);
  if (hints.defaultHeight) words.push_back("default-height=" + numberText(*hints.defaultHeight));
  words.push_back("floor-height=" + numberText(hints.floorHeight));
  if (hints.tile)
    words.push_back("tile=" + std::to_string(hints.tile->column) + "," + std::to_string(hints.tile->row) + "," +
                    std::to_string(hints.tile->columns) + "," + std::to_string(hints.tile->rows) + "," +
                    numberText(hints.tile->slope) + "," + numberText(hints.tile->highest));
  if (hints.inspectOnly) words.push_back("inspect=");
  words.push_back("alpha-triangles=" + std::to_string(hints.alphaTriangles));
  words.push_back("alpha-level=" + std::to_string(hints.alphaLevel));
  return words;
}

Hints hintsOf(std::span<const std::string> words) {
  Hints hints;
  for (const std::string& word : words) {
    const auto split = word.find('=');
    if (split == std::string::npos) continue;
    const std::string key = word.substr(0, split), value = word.substr(split + 1);
    if (key == "lod") hints.lod = value;
    if (key == "crs") hints.crs = value;
    if (key == "height-property") hints.heightProperty = value;
    if (key == "default-height") hints.defaultHeight = numberIn(value);
    if (key == "tile") hints.tile = tileIn(value);
    if (key == "alpha-triangles") hints.alphaTriangles = countIn(value, hints.alphaTriangles);
    if (key == "alpha-level") hints.alphaLevel = countIn(value, hints.alphaLevel);
    if (key == "inspect") hints.inspectOnly = true;
    if (key == "floor-height") hints.floorHeight = numberIn(value).value_or(hints.floorHeight);
  }
  return hints;
}

}  // namespace umbrage::io::detail

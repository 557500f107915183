#include "umbrage/io/detail/hints.hpp"

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

}  // namespace

std::vector<std::string> wordsOf(const Hints& hints) {
  std::vector<std::string> words;
  if (hints.lod) words.push_back("lod=" + *hints.lod);
  if (hints.crs) words.push_back("crs=" + *hints.crs);
  if (hints.heightProperty) words.push_back("height-property=" + *hints.heightProperty);
  if (hints.defaultHeight) words.push_back("default-height=" + numberText(*hints.defaultHeight));
  words.push_back("floor-height=" + numberText(hints.floorHeight));
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
    if (key == "floor-height") hints.floorHeight = numberIn(value).value_or(hints.floorHeight);
  }
  return hints;
}

}  // namespace umbrage::io::detail

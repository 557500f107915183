#include "json.hpp"

#include <algorithm>

namespace umbrage::cli {
namespace {

bool isSpace(char c) { return c == ' ' || c == '\n'; }

// A list of plain values that stands in one line: "[1, 2, 3]".
std::string oneLine(std::string_view list) {
  std::string line;
  for (const char c : list)
    if (!isSpace(c)) line += c == ',' ? ", " : std::string(1, c);
  return line;
}

// The list that starts here, when it holds nothing but numbers; else nothing.
std::string_view numberList(std::string_view text) {
  const auto end = text.find_first_not_of("0123456789+-.eE, \n", 1);
  return end != std::string_view::npos && text[end] == ']' ? text.substr(0, end + 1) : std::string_view();
}

}  // namespace

std::string jsonText(const Json& json) {
  const std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  std::string compact;
  for (std::size_t i = 0; i < text.size();) {
    // Within a string there are no line ends.
    const bool opens = text.compare(i, 2, "[\n") == 0;
    const auto list = opens ? numberList(std::string_view(text).substr(i)) : std::string_view();
    compact += list.empty() ? std::string(1, text[i]) : oneLine(list);
    i += std::max<std::size_t>(1, list.size());
  }
  return compact;
}

}  // namespace umbrage::cli

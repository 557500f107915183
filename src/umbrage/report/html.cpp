#include "umbrage/report/html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <umbrage_texts/page_css.hpp>

namespace umbrage::report {
namespace {

/// How many bytes the UTF-8 letter at the start of `text` has; 0: it is none.
std::size_t letterBytes(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char head = byte(0);
  const std::size_t count = head < 0x80                   ? 1
                            : head >= 0xC2 && head < 0xE0 ? 2
                            : head >= 0xE0 && head < 0xF0 ? 3
                            : head >= 0xF0 && head < 0xF5 ? 4
                                                          : 0;
  if (count == 0 || count > text.size()) return 0;
  for (std::size_t i = 1; i < count; ++i)
    if ((byte(i) & 0xC0) != 0x80) return 0;
  // Longer forms of what is short, surrogates, and what lies beyond Unicode.
  if (head == 0xE0 && byte(1) < 0xA0) return 0;
  if (head == 0xED && byte(1) >= 0xA0) return 0;
  if (head == 0xF0 && byte(1) < 0x90) return 0;
  if (head == 0xF4 && byte(1) >= 0x90) return 0;
  return count;
}

std::string_view entity(char c) {
  switch (c) {
    case '&': return "&amp;";
    case '<': return "&lt;";
    case '>': return "&gt;";
    case '"': return "&quot;";
    case '\'': return "&#39;";
    default: return {};
  }
}

bool isControl(char c) { return (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') || c == 0x7F; }

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const std::size_t bytes = letterBytes(text);
    if (bytes == 0)
      out += "\xEF\xBF\xBD";
    else if (const auto written = entity(text[0]); !written.empty())
      out += written;
    else if (isControl(text[0]))
      out += '?';
    else
      out += text.substr(0, bytes);
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return out;
}

std::string pageText(const HtmlPage& page) {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width, "
      "initial-scale=1\">\n<meta name=\"generator\" content=\"{}\">\n<link rel=\"icon\" "
      "href=\"data:,\">\n<title>{}</title>\n<style>\n{}{}</style>\n</head>\n<body>\n{}",
      escaped(page.kind), escaped(page.title), texts::kPageCss, page.style, page.body);
  if (!page.script.empty()) text += fmt::format("<script>\n{}</script>\n", page.script);
  return text + "</body>\n</html>\n";
}

}  // namespace umbrage::report

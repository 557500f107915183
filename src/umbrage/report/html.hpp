#pragma once

#include <string>
#include <string_view>

namespace umbrage::report {

/// Text as it stands inside an element or an attribute of HTML, SVG or XML: the five marks that mean something there are written as
/// entities, control characters as '?'. Bytes that are no UTF-8 become U+FFFD, so that a name from a hostile file cannot break the page.
[[nodiscard]] std::string escaped(std::string_view text);

/// A page that needs nothing else: its style and its script stand inside it.
struct HtmlPage {
  std::string title;   ///< as plain text
  std::string kind;    ///< who made it, as the page's "generator": "umbrage gallery"
  std::string style;   ///< CSS, after the house's own
  std::string script;  ///< runs when the page is read; may be empty
  std::string body;    ///< HTML
};
[[nodiscard]] std::string pageText(const HtmlPage& page);

}  // namespace umbrage::report

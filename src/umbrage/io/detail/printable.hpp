#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace umbrage::io::detail {

/// The text as UTF-8 that is safe in a terminal, in JSON and in XML: control characters become blanks, bytes that are not UTF-8
/// are taken as Latin-1, and what is longer than `most` bytes ends in "...".
[[nodiscard]] std::string printable(std::string_view text, std::size_t most);

}  // namespace umbrage::io::detail

#include "umbrage/io/detail/printable.hpp"

namespace umbrage::io::detail {
namespace {

unsigned byteAt(std::string_view text, std::size_t i) { return static_cast<unsigned char>(text[i]); }

// Bytes of the well-formed UTF-8 sequence at `i`, or 0. Neither overlong forms nor surrogates are well formed.
std::size_t sequenceAt(std::string_view text, std::size_t i) {
  const unsigned first = byteAt(text, i);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xc2 ? 0
                             : first < 0xe0 ? 2
                             : first < 0xf0 ? 3
                             : first < 0xf5 ? 4
                                            : 0;
  if (length == 0 || length > text.size() - i) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byteAt(text, i + k) & 0xc0) != 0x80) return 0;
  if (length < 3) return length;
  const unsigned second = byteAt(text, i + 1);
  const bool bad = (first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f) ||
                   (first == 0xf0 && second < 0x90) || (first == 0xf4 && second > 0x8f);
  return bad ? 0 : length;
}

bool isControl(std::string_view text, std::size_t i, std::size_t length) {
  if (length == 2)
    return byteAt(text, i) == 0xc2 && byteAt(text, i + 1) < 0xa0;  // the second block of control characters
  return length == 1 && (byteAt(text, i) < 0x20 || byteAt(text, i) == 0x7f);
}

}  // namespace

std::string printable(std::string_view text, std::size_t most) {
  std::string clean;
  for (std::size_t i = 0; i < text.size();) {
    if (clean.size() >= most) return clean + "...";
    const std::size_t length = sequenceAt(text, i);
    if (length == 0 && byteAt(text, i) >= 0xa0) {
      clean += static_cast<char>(0xc0 | (byteAt(text, i) >> 6));
      clean += static_cast<char>(0x80 | (byteAt(text, i) & 0x3f));
    } else if (length == 0 || isControl(text, i, length)) {
      clean += ' ';
    } else {
      clean += text.substr(i, length);
    }
    i += length == 0 ? 1 : length;
  }
  return clean;
}

}  // namespace umbrage::io::detail

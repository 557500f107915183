#include "umbrage/io/writer/glb_file.hpp"

#include <cstdint>
#include <limits>
#include <string_view>

namespace umbrage::io::writer {
namespace {

constexpr std::size_t kMaxBytes = std::numeric_limits<std::uint32_t>::max();

void appendWord(std::string& bytes, std::size_t word) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>(word >> shift & 0xffu));
}

void appendChunk(std::string& bytes, std::string_view type, std::string content, char padding) {
  content.resize((content.size() + 3) / 4 * 4, padding);
  appendWord(bytes, content.size());
  bytes += type;
  bytes += content;
}

}  // namespace

Result<std::string> glbFile(const std::string& json, std::string binary) {
  std::string chunks;
  if (json.size() + binary.size() + 64 > kMaxBytes) return fail(ErrorCode::output, "is too large for a .glb file");
  appendChunk(chunks, "JSON", json, ' ');
  if (!binary.empty()) appendChunk(chunks, std::string_view("BIN\0", 4), std::move(binary), '\0');
  std::string bytes = "glTF";
  appendWord(bytes, 2);
  appendWord(bytes, 12 + chunks.size());
  return bytes + chunks;
}

}  // namespace umbrage::io::writer

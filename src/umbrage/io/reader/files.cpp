#include "umbrage/io/reader/files.hpp"

#include <algorithm>
#include <string>

#include "umbrage/base/file.hpp"

namespace umbrage::io::reader {
bool isInside(const std::filesystem::path& folder, const std::filesystem::path& path) {
  std::error_code failure;
  const auto home = std::filesystem::canonical(folder, failure);
  if (failure) return false;
  const auto real = std::filesystem::canonical(path, failure);
  if (failure || !std::filesystem::is_regular_file(real, failure)) return false;
  return std::mismatch(home.begin(), home.end(), real.begin(), real.end()).first == home.end();
}

std::string withoutFolder(std::string text, const std::filesystem::path& file) {
  const std::string folder = file.parent_path().string() + "/";
  for (auto at = text.find(folder); at != std::string::npos; at = text.find(folder, at)) text.erase(at, folder.size());
  return text;
}

Result<std::vector<std::byte>> readJsonBytes(const std::filesystem::path& path) {
  auto bytes = readFile(path, kMaxFileBytes);
  if (!bytes) return fail(bytes.error().code, bytes.error().message);
  if (bytes->empty()) return fail(ErrorCode::input, "is empty");
  return bytes;
}

}  // namespace umbrage::io::reader

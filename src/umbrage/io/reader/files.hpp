#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "umbrage/base/error.hpp"

namespace umbrage::io::reader {

/// No scene file is larger; the parsers' memory would not suffice anyway.
inline constexpr std::size_t kMaxFileBytes = std::size_t{1} << 30;

/// True when `path`, links and '..' resolved, is a regular file below `folder`. Scene files name other files; those outside
/// their own folder are none of their business.
[[nodiscard]] bool isInside(const std::filesystem::path& folder, const std::filesystem::path& path);

/// The text without the name of the folder that `file` lies in: messages say the file's name once, in front.
[[nodiscard]] std::string withoutFolder(std::string text, const std::filesystem::path& file);

/// The text of a JSON file. Errors: cannot be read, too large, empty, nested deeper than the parsers survive.
[[nodiscard]] Result<std::vector<std::byte>> readJsonBytes(const std::filesystem::path& path);
/// Real files stay below 20; the parsers and their users walk values recursively.
inline constexpr int kMaxJsonDepth = 500;

[[nodiscard]] inline std::string_view asText(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace umbrage::io::reader

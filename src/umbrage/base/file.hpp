#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "umbrage/base/error.hpp"

namespace umbrage {

/// The whole of a regular file. Errors: missing, not a regular file, unreadable, larger than `maxBytes`.
[[nodiscard]] Result<std::vector<std::byte>> readFile(const std::filesystem::path& path,
                                                      std::size_t maxBytes = std::size_t{1} << 31);

/// ".png" of "Picture.PNG": what tells the kind of a file, in small letters.
[[nodiscard]] std::string lowerExtension(const std::filesystem::path& path);

/// Writes a file whole or not at all: into a temporary file beside it, flushed, then renamed over it.
/// What is there and no regular file (a device, a pipe, a folder) is left alone.
/// Errors: ErrorCode::output, with the path and the system's reason.
[[nodiscard]] Result<void> writeFile(const std::filesystem::path& path, std::span<const std::byte> bytes);
[[nodiscard]] Result<void> writeFile(const std::filesystem::path& path, std::string_view text);

/// The same for libraries that insist on writing by name: `write` is given the temporary path, in the same folder and with
/// the same extension; the file is renamed when it returns a value and removed when it returns an error.
[[nodiscard]] Result<void> writeFileWith(const std::filesystem::path& path,
                                         const std::function<Result<void>(const std::filesystem::path&)>& write);

}  // namespace umbrage

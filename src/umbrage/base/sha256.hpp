#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "umbrage/base/error.hpp"

namespace umbrage {

/// The SHA-256 of some bytes, of a file's, as 64 lower-case hexadecimal digits: by it an output says which input it was made of.
/// Source: FIPS PUB 180-4, Secure Hash Standard, 2015.
[[nodiscard]] std::string sha256(std::span<const std::byte> bytes);
/// Reads in pieces. Errors: input, where the file cannot be read.
[[nodiscard]] Result<std::string> sha256OfFile(const std::filesystem::path& path);

}  // namespace umbrage

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "umbrage/base/error.hpp"
#include "umbrage/image/image.hpp"

namespace umbrage::png {

/// Writes an 8-bit PNG, whole or not at all. Same pixels, same bytes.
[[nodiscard]] Result<void> write(const std::filesystem::path& path, const image::GreyImage& picture);
[[nodiscard]] Result<void> write(const std::filesystem::path& path, const image::RgbImage& picture);
[[nodiscard]] Result<void> write(const std::filesystem::path& path, const image::RgbaImage& picture);

/// A remark inside a file (an iTXt chunk): 1 to 79 letters of ASCII, and any UTF-8.
struct Text {
  std::string keyword, text;
};
/// With remarks, which viewers show as properties of the file.
[[nodiscard]] Result<void> write(const std::filesystem::path& path, const image::RgbImage& picture,
                                 const std::vector<Text>& texts);

/// The bytes of such a file. REQUIRES: the picture is not empty. Errors: output, when it is too large for a PNG.
[[nodiscard]] Result<std::vector<std::uint8_t>> encode(const image::RgbImage& picture);

/// Any PNG, converted to 8-bit RGBA. Errors: not a PNG, broken, larger than 16384 pixels on a side.
[[nodiscard]] Result<image::RgbaImage> read(const std::filesystem::path& path);
/// The same of a file's bytes. Errors: the same, and more than `mostPixels` in all.
[[nodiscard]] Result<image::RgbaImage> decode(std::span<const std::byte> bytes,
                                              std::size_t mostPixels = std::size_t{1} << 28);

}  // namespace umbrage::png

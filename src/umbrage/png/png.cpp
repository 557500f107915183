#include "umbrage/png/png.hpp"

#include <png.h>

#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "umbrage/base/file.hpp"

namespace umbrage::png {
namespace {

constexpr std::uint32_t kLargestSide = 16384;

constexpr std::size_t kHeaderEnd = 8 + 25;  // the signature and IHDR, which comes first

// Most significant byte first.
std::string fourBytes(std::uint32_t number) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 0xff);
  return bytes;
}

// Source: Portable Network Graphics Specification, 2003, annex D.
std::uint32_t checksum(std::string_view bytes) {
  std::uint32_t crc = 0xffffffffU;
  for (const char b : bytes) {
    crc ^= static_cast<unsigned char>(b);
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? 0xedb88320U ^ (crc >> 1) : crc >> 1;
  }
  return ~crc;
}

// The simple interface of libpng writes no text, so the chunk is made here.
std::string chunkOf(const Text& text) {
  constexpr std::string_view kPlain("\0\0\0\0\0", 5);  // not compressed, in no language, keyword not translated
  const std::string body = "iTXt" + text.keyword + std::string(kPlain) + text.text;
  return fourBytes(static_cast<std::uint32_t>(body.size() - 4)) + body + fourBytes(checksum(body));
}

/// Errors have no place yet.
template <class Pixel>
Result<std::vector<std::uint8_t>> encoded(const image::Image<Pixel>& picture, png_uint_32 format) {
  if (picture.empty()) return fail(ErrorCode::output, "an empty picture cannot be written");
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(picture.width());
  header.height = static_cast<png_uint_32>(picture.height());
  header.format = format;
  png_alloc_size_t size = 0;
  std::vector<std::uint8_t> bytes;
  const void* pixels = picture.pixels().data();
  if (png_image_write_to_memory(&header, nullptr, &size, 0, pixels, 0, nullptr) != 0) {
    bytes.resize(size);
    if (png_image_write_to_memory(&header, bytes.data(), &size, 0, pixels, 0, nullptr) != 0) {
      bytes.resize(size);
      return bytes;
    }
  }
  return fail(ErrorCode::output, std::string("cannot be encoded: ") + header.message);
}

template <class Pixel>
Result<void> writePixels(const std::filesystem::path& path, const image::Image<Pixel>& picture, png_uint_32 format,
                         const std::vector<Text>& texts = {}) {
  auto bytes = encoded(picture, format);
  if (!bytes) return fail(bytes.error().code, bytes.error().message, path.string());
  std::string remarks;
  for (const Text& text : texts) remarks += chunkOf(text);
  bytes->insert(bytes->begin() + kHeaderEnd, remarks.begin(), remarks.end());
  return writeFile(path, std::as_bytes(std::span(*bytes)));
}

}  // namespace

Result<void> write(const std::filesystem::path& path, const image::GreyImage& picture) {
  return writePixels(path, picture, PNG_FORMAT_GRAY);
}
Result<void> write(const std::filesystem::path& path, const image::RgbImage& picture) {
  return writePixels(path, picture, PNG_FORMAT_RGB);
}
Result<void> write(const std::filesystem::path& path, const image::RgbaImage& picture) {
  return writePixels(path, picture, PNG_FORMAT_RGBA);
}

Result<void> write(const std::filesystem::path& path, const image::RgbImage& picture, const std::vector<Text>& texts) {
  return writePixels(path, picture, PNG_FORMAT_RGB, texts);
}

Result<std::vector<std::uint8_t>> encode(const image::RgbImage& picture) { return encoded(picture, PNG_FORMAT_RGB); }

Result<image::RgbaImage> read(const std::filesystem::path& path) {
  const auto bytes = readFile(path);
  if (!bytes) return tl::unexpected(bytes.error());
  auto picture = decode(*bytes);
  if (!picture) return fail(picture.error().code, picture.error().message, path.string());
  return picture;
}

Result<image::RgbaImage> decode(std::span<const std::byte> bytes, std::size_t mostPixels) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()) == 0)
    return fail(ErrorCode::input, std::string("is not a readable PNG: ") + header.message);
  const bool large = header.width > kLargestSide || header.height > kLargestSide;
  if (large || std::size_t{header.width} * header.height > mostPixels) {
    png_image_free(&header);
    return fail(ErrorCode::input, large ? "is larger than 16384 pixels on a side" : "has too many pixels");
  }
  header.format = PNG_FORMAT_RGBA;
  image::RgbaImage picture(static_cast<int>(header.width), static_cast<int>(header.height));
  if (png_image_finish_read(&header, nullptr, picture.pixels().data(), 0, nullptr) == 0)
    return fail(ErrorCode::input, std::string("is a broken PNG: ") + header.message);
  return picture;
}

}  // namespace umbrage::png

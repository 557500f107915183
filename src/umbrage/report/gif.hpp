#pragma once

#include <chrono>
#include <filesystem>
#include <functional>

#include "umbrage/base/error.hpp"
#include "umbrage/image/image.hpp"

namespace umbrage::report {

/// Pictures of one size, made one after the other; some are asked for twice, as the palette is chosen from a few of them.
struct Animation {
  std::size_t frames = 0;
  std::function<Result<image::RgbImage>(std::size_t)> frame;
  std::chrono::milliseconds delay{500};
  std::vector<std::string> comments;  ///< inside the file, each cut off behind 255 bytes
};

/// Writes an endless animated GIF, whole or not at all: one palette of 256 colours for all frames, no dithering, each frame cut to
/// what changed. Same pictures, same bytes.
/// REQUIRES: at least one frame; all of one size, 1 to 65535 pixels a side. Errors: those of `frame`, output.
[[nodiscard]] Result<void> writeGif(const std::filesystem::path& path, const Animation& animation);

}  // namespace umbrage::report

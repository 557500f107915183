#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "umbrage/base/error.hpp"
#include "umbrage/io/detail/hints.hpp"

namespace umbrage::io::detail {

/// One of the programs that read; `variable` of the environment may say where it is.
struct ReaderProgram {
  const char* name;
  const char* variable;
};
inline constexpr ReaderProgram kReader{"umbrage-reader", "UMBRAGE_READER"};
inline constexpr ReaderProgram kRasterReader{"umbrage-raster-reader", "UMBRAGE_RASTER_READER"};

/// What the reader process is asked for.
struct ReaderJob {
  std::filesystem::path file;
  Hints hints;
  std::chrono::milliseconds timeLimit{0};
  std::size_t memoryLimit = 0;
  ReaderProgram program = kReader;
};

/// The hand-over of one run of the reader. Errors: no reader found or startable; it crashed, hung or ran out of memory.
/// Leaves no process, descriptor or file behind. May be called from any thread: the parent never forks its own code.
[[nodiscard]] Result<std::vector<std::byte>> runReader(const ReaderJob& job);

/// Of a memory limit, the part that the hand-over may take: the caller holds it twice for a moment, as bytes and as a scene.
[[nodiscard]] constexpr std::size_t handoverLimit(std::size_t memoryLimit) { return memoryLimit / 3; }

}  // namespace umbrage::io::detail

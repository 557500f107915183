#pragma once

#include <Inventor/nodes/SoSeparator.h>

#include <filesystem>

#include "umbrage/io/reader/tidy.hpp"

namespace umbrage::io::reader {

/// Starts Coin, silently, with a clock that stands still, and reads the file. Files it names are read only from its own folder
/// and at most so deep as no file includes itself; textures are not read. Complaints are collected, cleared of folder names.
/// Null when the file cannot be read. To be called once in a process.
[[nodiscard]] SoSeparator* readInventorFile(const std::filesystem::path& file, Complaints& complaints);

}  // namespace umbrage::io::reader

#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "umbrage/base/error.hpp"

namespace umbrage::cli {

/// Refuses a folder that cannot be made, or that holds anything but what an earlier writeFolder left there: it would be lost. `index`: the file that
/// tells it, by having `mark` in it. Errors: output, usage.
[[nodiscard]] Result<void> checkFolder(const std::filesystem::path& folder, const std::string& index,
                                       const std::string& mark);

/// A file of a folder: its name there, and how it is made at a path.
struct FolderFile {
  std::string name;
  std::function<Result<void>(const std::string& path)> write;
};

/// Makes a folder with these files, whole or not at all: beside its place first. What is there is replaced. REQUIRES: checkFolder liked it.
[[nodiscard]] Result<void> writeFolder(const std::filesystem::path& folder, const std::vector<FolderFile>& files);

}  // namespace umbrage::cli

#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "umbrage/base/error.hpp"

namespace umbrage::cli {

/// What an earlier writeFolder left: a file that has a mark in it, and others of names that it may have written.
struct FolderContent {
  std::string index, mark;
  std::function<bool(const std::string& name)> isOurs;
};

/// Refuses a folder that cannot be made, or that holds anything else: it would be lost. Errors: output, usage.
[[nodiscard]] Result<void> checkFolder(const std::filesystem::path& folder, const FolderContent& content);

/// A file of a folder: its name there, and how it is made at a path.
struct FolderFile {
  std::string name;
  std::function<Result<void>(const std::string& path)> write;
};

/// Makes a folder with these files, whole or not at all: beside its place first. What is there is replaced. REQUIRES: checkFolder liked it.
[[nodiscard]] Result<void> writeFolder(const std::filesystem::path& folder, const std::vector<FolderFile>& files);

}  // namespace umbrage::cli

#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "umbrage/base/error.hpp"

namespace umbrage::cli {

/// A file to be made at the end, and how.
struct Output {
  std::string path;
  std::function<Result<void>(const std::string& path)> write;
};

/// Refuses outputs that cannot be written before any work is done: two of one name, a folder, a device, a file in a
/// folder that is missing or closed to writing; and the file that is read, under whatever name.
[[nodiscard]] Result<void> checkOutputs(const std::vector<std::string>& paths, const std::string& input = {});

/// Does the name end in it (".png")? Letters count alike in either case.
[[nodiscard]] bool hasExtension(const std::string& path, std::string_view extension);

/// Refuses a name that does not end in one of `extensions`, for example {".png"}. Errors: usage, with the option's
/// name.
[[nodiscard]] Result<void> checkExtension(const std::string& option, const std::string& path,
                                          const std::vector<std::string>& extensions);

/// Writes them in order, each whole or not at all, with SIGINT and SIGTERM waiting. When one fails, the error names
/// those that were written.
[[nodiscard]] Result<void> writeOutputs(const std::vector<Output>& outputs);

}  // namespace umbrage::cli

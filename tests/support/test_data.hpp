#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <string_view>
#include <vector>

// The public models that tests are run on; none of them is in the repository.
namespace umbrage::support {

/// Where they lie: as UMBRAGE_TEST_DATA says, or beside the checkout. An empty path where there are none.
inline std::filesystem::path testData() {
  const char* named = std::getenv("UMBRAGE_TEST_DATA");
  const std::filesystem::path folder = named != nullptr ? named : UMBRAGE_SOURCE_DIR "/../shared/data";
  return std::filesystem::is_directory(folder) ? folder : std::filesystem::path();
}

/// The files below a folder that end in one of `endings`, in order; none where there is no folder.
inline std::vector<std::filesystem::path> filesBelow(const std::filesystem::path& folder,
                                                     std::initializer_list<std::string_view> endings) {
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::is_directory(folder)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (std::ranges::find(endings, entry.path().extension().string()) != endings.end()) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

}  // namespace umbrage::support

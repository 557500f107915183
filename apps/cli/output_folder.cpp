#include "output_folder.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include <fmt/format.h>

#include "console.hpp"
#include "umbrage/base/file.hpp"

namespace umbrage::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestIndex = std::size_t{1} << 26;

/// "dir/" names "dir".
fs::path named(const fs::path& folder) { return folder.has_filename() ? folder : folder.parent_path(); }

fs::path parentOf(const fs::path& folder) { return folder.has_parent_path() ? folder.parent_path() : fs::path("."); }

bool holds(const fs::path& file, const std::string& mark) {
  const auto bytes = readFile(file, kLargestIndex);
  if (!bytes) return false;
  const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  return text.find(mark) != std::string_view::npos;
}

/// Only plain files of names that we write.
bool holdsNothingElse(const fs::path& folder, const FolderContent& content) {
  std::error_code problem;
  for (fs::directory_iterator i(folder, problem), end; !problem && i != end; i.increment(problem))
    if (!fs::is_regular_file(i->symlink_status(problem)) || !content.isOurs(i->path().filename().string()))
      return false;
  return !problem;
}

/// A folder of a new name that goes away unless it is taken.
class Beside {
 public:
  explicit Beside(const fs::path& folder) {
    std::string pattern = (parentOf(folder) / ("." + folder.filename().string() + ".XXXXXX")).string();
    if (::mkdtemp(pattern.data()) != nullptr) path_ = pattern;
  }
  ~Beside() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

tl::unexpected<Error> failed(const fs::path& folder, const std::string& why) {
  return fail(ErrorCode::output, fmt::format("cannot be written: {}", why), folder.string());
}

/// What is at `folder` ends up in `old`, where it goes away.
Result<void> takePlace(const fs::path& made, const fs::path& folder, const fs::path& old) {
  std::error_code problem;
  if (fs::exists(folder, problem)) fs::rename(folder, old / "before", problem);
  if (!problem) fs::rename(made, folder, problem);
  if (problem) return failed(folder, problem.message());
  return {};
}

}  // namespace

Result<void> checkFolder(const fs::path& asked, const FolderContent& content) {
  const fs::path folder = named(asked);
  std::error_code ignored;
  const fs::path parent = parentOf(folder);
  if (!fs::is_directory(parent, ignored)) return failed(folder, fmt::format("there is no folder {}", parent.string()));
  if (::access(parent.c_str(), W_OK) != 0)
    return failed(folder, fmt::format("the folder {} is closed to writing", parent.string()));
  const auto status = fs::symlink_status(folder, ignored);
  if (!fs::exists(status)) return {};
  if (!fs::is_directory(status)) return failed(folder, "it is there and no folder");
  if (fs::is_empty(folder, ignored) ||
      (holdsNothingElse(folder, content) && holds(folder / content.index, content.mark)))
    return {};
  return fail(ErrorCode::usage, "holds other files, which would be lost; name a folder that does not exist yet",
              folder.string());
}

Result<void> writeFolder(const fs::path& asked, const std::vector<FolderFile>& files) {
  const DeferredSignals whole;
  const fs::path folder = named(asked);
  const Beside place(folder);
  if (place.path().empty()) return failed(folder, std::strerror(errno));
  const fs::path made = place.path() / "new";
  std::error_code problem;
  fs::create_directory(made, problem);  // with the rights that the user gives to what is new, which mkdtemp does not
  if (problem) return failed(folder, problem.message());
  for (const auto& file : files)
    if (const auto written = file.write((made / file.name).string()); !written) {
      Error error = written.error();
      error.where = (folder / file.name).string();
      return tl::unexpected(error);
    }
  return takePlace(made, folder, place.path());
}

}  // namespace umbrage::cli

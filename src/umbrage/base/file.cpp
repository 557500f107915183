#include "umbrage/base/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

namespace umbrage {
namespace {

std::string systemReason(int code) { return std::generic_category().message(code); }

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const { return fd_; }
  /// Closes now; false when the system reports a late write error.
  bool close() { return ::close(std::exchange(fd_, -1)) == 0; }

 private:
  int fd_;
};

// Of UTF-8 whole characters.
std::string beginOf(const std::string& text, std::size_t most) {
  std::size_t length = std::min(text.size(), most);
  while (length > 0 && length < text.size() && (static_cast<unsigned char>(text[length]) & 0xC0U) == 0x80U) --length;
  return text.substr(0, length);
}

// What is added to a name must not make it too long.
constexpr std::size_t kLongestStem = 100;

std::filesystem::path temporaryBeside(const std::filesystem::path& path) {
  static std::atomic<unsigned> serial{0};
  const auto name = "." + beginOf(path.stem().string(), kLongestStem) + "." + std::to_string(::getpid()) + "." +
                    std::to_string(serial.fetch_add(1)) + ".part" + path.extension().string();
  return path.parent_path() / name;
}

Result<void> writeAll(const std::filesystem::path& temporary, std::span<const std::byte> bytes,
                      const std::filesystem::path& path) {
  Descriptor out(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (out.get() < 0) return fail(ErrorCode::output, "cannot be written: " + systemReason(errno), path.string());
  while (!bytes.empty()) {
    const ssize_t written = ::write(out.get(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return fail(ErrorCode::output, "cannot be written: " + systemReason(errno), path.string());
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  if (!out.close()) return fail(ErrorCode::output, "cannot be written: " + systemReason(errno), path.string());
  return {};
}

}  // namespace

std::string lowerExtension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

Result<std::vector<std::byte>> readFile(const std::filesystem::path& path, std::size_t maxBytes) {
  // O_NONBLOCK: opening a named pipe must not hang; it is refused below as not a regular file.
  Descriptor in(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (in.get() < 0) return fail(ErrorCode::input, "cannot be opened: " + systemReason(errno), path.string());
  struct stat status {};
  if (::fstat(in.get(), &status) != 0 || !S_ISREG(status.st_mode))
    return fail(ErrorCode::input, "is not a regular file", path.string());
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size > maxBytes)
    return fail(ErrorCode::input,
                "is too large: " + std::to_string(size) + " bytes, at most " + std::to_string(maxBytes) + " are read",
                path.string());
  std::vector<std::byte> bytes(size);
  std::size_t done = 0;
  while (done < size) {
    const ssize_t got = ::read(in.get(), bytes.data() + done, size - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return fail(ErrorCode::input, "cannot be read: " + systemReason(errno), path.string());
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  bytes.resize(done);
  return bytes;
}

Result<void> writeFileWith(const std::filesystem::path& path,
                           const std::function<Result<void>(const std::filesystem::path&)>& write) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  // A rename would replace a device or a pipe by a file.
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    return fail(ErrorCode::output, "is not a regular file and is left alone", path.string());
  const auto temporary = temporaryBeside(path);
  auto done = write(temporary);
  std::error_code failure;
  if (done) {
    std::filesystem::rename(temporary, path, failure);
    if (!failure) return {};
    done = fail(ErrorCode::output, "cannot be written: " + failure.message(), path.string());
  }
  std::filesystem::remove(temporary, failure);
  return done;
}

Result<void> writeFile(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  return writeFileWith(path, [&](const std::filesystem::path& temporary) { return writeAll(temporary, bytes, path); });
}

Result<void> writeFile(const std::filesystem::path& path, std::string_view text) {
  return writeFile(path, std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace umbrage

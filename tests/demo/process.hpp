#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

namespace umbrage::demo_test {

using Milliseconds = std::chrono::milliseconds;
inline constexpr Milliseconds kPatience{30000};  ///< longer than anything takes on a slow machine

/// A program that runs beside the test, with its output in files. It ends with this, and with the test.
class Process {
 public:
  /// `words` begins with the program; `environment` has NAME=VALUE to add, or NAME= to take away.
  Process(const std::vector<std::string>& words, const std::vector<std::string>& environment,
          const std::filesystem::path& output);
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process();

  [[nodiscard]] bool runs();
  /// Its exit code; -1 where a signal ended it, or this did, since it took longer than the limit.
  int wait(Milliseconds limit = kPatience);
  /// Standard output and error so far.
  [[nodiscard]] std::string said() const;

 private:
  void end(int signal);
  pid_t id_ = -1;
  int status_ = 0;
  std::filesystem::path output_;
};

/// Whether a program is found along PATH.
[[nodiscard]] bool isInstalled(const std::string& program);

/// Asks until the answer is yes; false where the limit came first.
template <class Ask>
bool eventually(Ask&& ask, Milliseconds limit = kPatience) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (!ask()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(Milliseconds(20));
  }
  return true;
}

/// A folder that goes with this.
class Folder {
 public:
  Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder();
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  [[nodiscard]] std::string text() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

[[nodiscard]] std::string textOf(const std::filesystem::path& file);

}  // namespace umbrage::demo_test

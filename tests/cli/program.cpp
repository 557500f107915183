#include "program.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>

namespace umbrage::cli_test {
namespace {

using Clock = std::chrono::steady_clock;

struct Pipe {
  std::array<int, 2> ends{-1, -1};
  Pipe() {
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) std::abort();
  }
  ~Pipe() {
    closeEnd(0);
    closeEnd(1);
  }
  void closeEnd(std::size_t end) {
    if (ends[end] >= 0) ::close(std::exchange(ends[end], -1));
  }
};

[[noreturn]] void becomeProgram(const std::vector<std::string>& words, const RunOptions& options, int out, int err) {
  if (!options.workingFolder.empty() && ::chdir(options.workingFolder.c_str()) != 0) ::_exit(127);
  if (!options.outputTo.empty()) out = ::open(options.outputTo.c_str(), O_WRONLY | O_CLOEXEC);
  // glvnd, which is Debian's libEGL, then finds no vendor.
  if (options.hideGraphics) ::setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent", 1);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(err, STDERR_FILENO);
  // A test runner may have been started with these ignored.
  ::signal(SIGINT, SIG_DFL);
  ::signal(SIGPIPE, SIG_DFL);
  std::vector<char*> arguments{const_cast<char*>(UMBRAGE_PROGRAM)};
  for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  ::execv(UMBRAGE_PROGRAM, arguments.data());
  ::_exit(127);
}

// False at the end of the stream.
bool take(int descriptor, std::string& text) {
  std::array<char, 65536> buffer;
  const ssize_t got = ::read(descriptor, buffer.data(), buffer.size());
  if (got > 0) text.append(buffer.data(), static_cast<std::size_t>(got));
  return got > 0;
}

}  // namespace

Ran umbrage(const std::vector<std::string>& words, const RunOptions& options) {
  Pipe out, err;
  if (options.closeOutput) out.closeEnd(0);
  const pid_t child = ::fork();
  if (child == 0) becomeProgram(words, options, out.ends[1], err.ends[1]);
  out.closeEnd(1);
  err.closeEnd(1);

  Ran ran;
  const auto start = Clock::now();
  bool interrupted = options.interruptAfter.count() == 0;
  std::array<pollfd, 2> streams{{{out.ends[0], POLLIN, 0}, {err.ends[0], POLLIN, 0}}};
  while (streams[0].fd >= 0 || streams[1].fd >= 0) {
    ::poll(streams.data(), streams.size(), 5);
    if (streams[0].revents != 0 && !take(streams[0].fd, ran.out)) streams[0].fd = -1;
    if (streams[1].revents != 0 && !take(streams[1].fd, ran.err)) streams[1].fd = -1;
    const auto elapsed = Clock::now() - start;
    if (!interrupted && elapsed > options.interruptAfter) {
      ::kill(child, SIGINT);
      interrupted = true;
    }
    if (elapsed > options.limit) {
      ran.timedOut = true;
      ::kill(child, SIGKILL);
      break;
    }
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  if (WIFEXITED(status)) ran.code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) ran.signal = WTERMSIG(status);
  return ran;
}

void CliTest::SetUp() {
  std::string pattern = (std::filesystem::temp_directory_path() / "umbrage-cli-XXXXXX").string();
  ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
  folder_ = pattern;
}

void CliTest::TearDown() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

std::vector<std::string> CliTest::files() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_))
    names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

std::string CliTest::read(const std::string& name) const {
  std::ifstream in(folder_ / name, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string CliTest::write(const std::string& name, const std::string& text) const {
  std::ofstream(folder_ / name, std::ios::binary) << text;
  return file(name);
}

std::string CliTest::writeBox(const std::string& name, double height) const {
  const auto h = std::to_string(height);
  return write(name, "OFF\n8 6 0\n-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n-1 -1 " + h + "\n1 -1 " + h + "\n1 1 " + h +
                         "\n-1 1 " + h + "\n4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n");
}

}  // namespace umbrage::cli_test

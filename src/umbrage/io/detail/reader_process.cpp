#include "umbrage/io/detail/reader_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

extern char** environ;

namespace umbrage::io::detail {
namespace {

using Clock = std::chrono::steady_clock;
namespace fs = std::filesystem;

constexpr int kHandoverFd = 3;
constexpr std::size_t kMaxChatter = 64 << 10;

class Descriptor {
 public:
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  ~Descriptor() { reset(); }
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  [[nodiscard]] int get() const { return fd_; }
  void reset() {
    if (fd_ >= 0) ::close(std::exchange(fd_, -1));
  }

 private:
  int fd_;
};

// In a program that has closed its standard input or output new descriptors take their places, which the child's own would
// then overwrite.
Descriptor aboveStandard(int fd) {
  if (fd < 0 || fd > kHandoverFd) return Descriptor(fd);
  const Descriptor low(fd);
  return Descriptor(::fcntl(fd, F_DUPFD_CLOEXEC, kHandoverFd + 1));
}

std::string systemReason(int code) { return std::generic_category().message(code); }

std::optional<fs::path> findReader(const ReaderProgram& reader) {
  if (const char* named = std::getenv(reader.variable); named != nullptr && *named != '\0') return fs::path(named);
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  for (const fs::path& folder : {program, program / UMBRAGE_READER_FROM_PROGRAM, fs::path(UMBRAGE_READERS_INSTALLED),
                                 fs::path(UMBRAGE_READERS_BUILT)})
    if (const fs::path candidate = folder / reader.name;
        candidate.is_absolute() && ::access(candidate.c_str(), X_OK) == 0)
      return candidate;
  return std::nullopt;
}

// posix_spawn's C structures, released whatever happens.
struct SpawnPlan {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  SpawnPlan() {
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
  }
  ~SpawnPlan() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;
};

void plan(SpawnPlan& spawn, int handover, int chatter) {
  posix_spawn_file_actions_addopen(&spawn.files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&spawn.files, chatter, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&spawn.files, chatter, STDERR_FILENO);
  posix_spawn_file_actions_adddup2(&spawn.files, handover, kHandoverFd);
  posix_spawn_file_actions_addclosefrom_np(&spawn.files, kHandoverFd + 1);
  // Its own group, so that a kill reaches whatever it may have started; signals as a fresh program finds them.
  sigset_t all, none;
  sigfillset(&all);
  sigemptyset(&none);
  posix_spawnattr_setpgroup(&spawn.attributes, 0);
  posix_spawnattr_setsigdefault(&spawn.attributes, &all);
  posix_spawnattr_setsigmask(&spawn.attributes, &none);
  posix_spawnattr_setflags(&spawn.attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
}

std::vector<std::string> arguments(const fs::path& reader, const ReaderJob& job) {
  const auto seconds = std::chrono::ceil<std::chrono::seconds>(job.timeLimit).count() + 1;
  std::vector<std::string> words = {reader.string(),
                                    std::to_string(kHandoverFd),
                                    std::to_string(job.memoryLimit),
                                    std::to_string(handoverLimit(job.memoryLimit)),
                                    std::to_string(seconds),
                                    job.file.string()};
  for (std::string& hint : wordsOf(job.hints)) words.push_back(std::move(hint));
  return words;
}

Result<pid_t> start(const fs::path& reader, const ReaderJob& job, int handover, int chatter) {
  SpawnPlan spawn;
  plan(spawn, handover, chatter);
  std::vector<std::string> words = arguments(reader, job);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t child = -1;
  if (const int code = posix_spawn(&child, reader.c_str(), &spawn.files, &spawn.attributes, argv.data(), environ);
      code != 0)
    return fail(ErrorCode::input, "the reader " + reader.string() + " cannot be started: " + systemReason(code));
  return child;
}

// Reads what the child prints until nothing more is there now; false once the pipe is closed at its end.
bool drain(int pipe, std::string& chatter) {
  std::array<char, 4096> buffer;
  for (;;) {
    const ssize_t got = ::read(pipe, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return errno == EAGAIN;
    if (got == 0) return false;
    const std::size_t room = kMaxChatter - std::min(kMaxChatter, chatter.size());
    chatter.append(buffer.data(), std::min(room, static_cast<std::size_t>(got)));
  }
}

struct Ending {
  bool timedOut = false;
  bool known = true;  // false: the host program ignores SIGCHLD and the system told nobody
  int status = 0;
};

// Waits for the end or the deadline; either way nothing of the child lives on afterwards.
Ending await(pid_t child, int pipe, Clock::time_point deadline, std::string& chatter) {
  Ending ending;
  bool open = true;
  for (int idle = 1;; idle = std::min(idle * 2, 20)) {
    const pid_t ended = ::waitpid(child, &ending.status, WNOHANG);
    if (ended == child) break;
    if (ended < 0 && errno != EINTR) {
      ending.known = false;
      break;
    }
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0 && !ending.timedOut) {
      ending.timedOut = true;
      ::kill(-child, SIGKILL);
    }
    pollfd wait{open ? pipe : -1, POLLIN, 0};
    const bool spoke = ::poll(&wait, 1, ending.timedOut ? 1 : static_cast<int>(std::min<long long>(idle, left))) > 0;
    if (spoke) open = drain(pipe, chatter);
    if (spoke) idle = 1;
  }
  ::kill(-child, SIGKILL);  // what the child may have started itself; the group has no other members
  if (open) drain(pipe, chatter);
  return ending;
}

// The last line that says something, with nothing in it that a terminal would obey.
std::string lastWords(const std::string& chatter) {
  std::string line, last;
  const auto keep = [&] {
    if (line.find_first_not_of(' ') != std::string::npos) last = line;
    line.clear();
  };
  for (const char c : chatter) {
    if (c == '\n' || c == '\r')
      keep();
    else if (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f && line.size() < 200)
      line += c;
  }
  keep();
  return last;
}

std::string explain(const Ending& ending, const ReaderJob& job, const std::string& chatter) {
  const std::string words = lastWords(chatter);
  const std::string tail = words.empty() ? "" : ": " + words;
  if (ending.timedOut)
    return "takes too long to read: stopped after " + std::to_string(job.timeLimit.count()) + " ms" + tail;
  if (WIFSIGNALED(ending.status)) {
    const int signal = WTERMSIG(ending.status);
    if (signal == SIGXCPU) return "takes too long to read: stopped by the limit on processor time" + tail;
    if (signal == SIGXFSZ) return "is too large: the scene does not fit into the limit on memory" + tail;
    const char* name = ::sigdescr_np(signal);
    return "is broken in a way that makes the parser crash (signal " + std::to_string(signal) +
           (name != nullptr ? ", " + std::string(name) : "") + ")" + tail;
  }
  return "the reader ended with status " + std::to_string(WEXITSTATUS(ending.status)) + " and no scene" + tail;
}

Result<std::vector<std::byte>> readHandover(int fd, std::size_t limit) {
  struct stat status {};
  if (::fstat(fd, &status) != 0) return fail(ErrorCode::input, "the hand-over cannot be read: " + systemReason(errno));
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size > limit) return fail(ErrorCode::input, "is too large: the scene does not fit into the limit on memory");
  std::vector<std::byte> bytes(size);
  std::size_t done = 0;
  while (done < size) {
    const ssize_t got = ::pread(fd, bytes.data() + done, size - done, static_cast<off_t>(done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    done += static_cast<std::size_t>(got);
  }
  bytes.resize(done);
  return bytes;
}

}  // namespace

Result<std::vector<std::byte>> runReader(const ReaderJob& job) {
  const auto reader = findReader(job.program);
  if (!reader)
    return fail(ErrorCode::unsupported, std::string("the program ") + job.program.name +
                                            " is not installed beside this one; set " + job.program.variable +
                                            " to where it is");
  const Descriptor handover = aboveStandard(::memfd_create("umbrage-handover", MFD_CLOEXEC));
  std::array<int, 2> ends{-1, -1};
  if (handover.get() < 0 || ::pipe2(ends.data(), O_CLOEXEC) != 0)
    return fail(ErrorCode::input, "no descriptors left to read it with: " + systemReason(errno));
  const Descriptor hear = aboveStandard(ends[0]);
  Descriptor speak = aboveStandard(ends[1]);
  ::fcntl(hear.get(), F_SETFL, O_NONBLOCK);

  const auto deadline = Clock::now() + job.timeLimit;
  const auto child = start(*reader, job, handover.get(), speak.get());
  speak.reset();
  if (!child) return tl::unexpected(child.error());
  std::string chatter;
  const Ending ending = await(*child, hear.get(), deadline, chatter);
  if (ending.timedOut || (ending.known && ending.status != 0))
    return fail(ErrorCode::input, explain(ending, job, chatter));
  return readHandover(handover.get(), handoverLimit(job.memoryLimit));
}

}  // namespace umbrage::io::detail

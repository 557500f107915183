#include "umbrage/io/reader/run.hpp"

#include <pthread.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <span>
#include <string>
#include <vector>

#include "umbrage/io/detail/handover.hpp"
#include "umbrage/io/reader/limits.hpp"

namespace umbrage::io::reader {
namespace {

// Parsers recurse with the nesting of the file; a bounded stack makes too deep a file a crash here, not in the caller.
constexpr std::size_t kStackBytes = std::size_t{256} << 20;

struct Job {
  ReadFunction read;
  Request request;
  std::vector<std::byte> handover;
};

std::vector<std::byte> perform(const Job& job) {
  using detail::pack;
  // The one place where the exceptions of all the foreign libraries arrive.
  try {
    const auto scene = job.read(job.request);
    return scene ? pack(*scene) : pack(scene.error());
  } catch (const std::bad_alloc&) {
    return pack(Error{ErrorCode::input, "needs more memory than a scene is allowed", ""});
  } catch (const std::length_error&) {
    return pack(Error{ErrorCode::input, "needs more memory than a scene is allowed", ""});
  } catch (const std::exception& fault) {
    return pack(Error{ErrorCode::input, std::string("cannot be read: ") + fault.what(), ""});
  }
}

void* run(void* argument) {
  auto* job = static_cast<Job*>(argument);
  job->handover = perform(*job);
  return nullptr;
}

bool onLargeStack(Job& job) {
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, kStackBytes);
  pthread_t thread{};
  if (pthread_create(&thread, &attributes, run, &job) != 0) return false;
  pthread_join(thread, nullptr);
  return true;
}

bool writeAll(int fd, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

int runReader(int argc, char** argv, ReadFunction read) {
  if (argc < 6) {
    std::fputs("umbrage-reader is started by the umbrage library, not by hand\n", stderr);
    return 2;
  }
  const int fd = std::atoi(argv[1]);
  confine(
      {std::strtoull(argv[2], nullptr, 10), std::strtoull(argv[3], nullptr, 10), std::strtoull(argv[4], nullptr, 10)});
  Job job{read, {}, {}};
  job.request.file = argv[5];
  const std::vector<std::string> hints(argv + 6, argv + argc);
  job.request.hints = detail::hintsOf(hints);
  const bool done = onLargeStack(job) && writeAll(fd, job.handover);
  // The libraries' own tidying up at exit is one more place to crash in, and the system tidies up anyway.
  std::fflush(nullptr);
  ::_exit(done ? 0 : 1);
}

}  // namespace umbrage::io::reader

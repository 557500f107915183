// What the reader process can still do once it is confined. Each case ends a process of its own.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <thread>

#include "umbrage/io/reader/limits.hpp"
#include "umbrage/io/test_data.hpp"

namespace umbrage::io::reader {
namespace {

constexpr Limits kLimits{std::size_t{1} << 30, 1 << 20, 5};

// Runs `act` confined; its result becomes the exit status.
template <class Act>
void expectConfined(Act act) {
  EXPECT_EXIT(
      {
        confine(kLimits);
        ::_exit(act() ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

TEST(Confinement, filesCanBeReadButNotMade) {
  const test::Folder folder;
  const auto old = folder.write("old", "text");
  const std::string made = (folder.path() / "new").string();
  expectConfined([&] {
    const int readable = ::open(old.c_str(), O_RDONLY);
    return readable >= 0 && ::open(made.c_str(), O_WRONLY | O_CREAT, 0600) < 0 && ::open(old.c_str(), O_RDWR) < 0 &&
           ::creat(made.c_str(), 0600) < 0 && ::truncate(old.c_str(), 0) != 0 &&
           std::fopen(made.c_str(), "w") == nullptr && ::mkdir(made.c_str(), 0700) != 0 &&
           ::symlink("a", made.c_str()) != 0 && ::link(old.c_str(), made.c_str()) != 0 &&
           ::rename(old.c_str(), made.c_str()) != 0 && ::unlink(old.c_str()) != 0 && ::mkfifo(made.c_str(), 0600) != 0;
  });
  EXPECT_TRUE(std::filesystem::exists(old));
  EXPECT_FALSE(std::filesystem::exists(made));
}

TEST(Confinement, noProgramsAndNoConnections) {
  expectConfined([] {
    char name[] = "/bin/true";
    char* const arguments[] = {name, nullptr};
    return ::execv(name, arguments) != 0 && ::socket(AF_INET, SOCK_STREAM, 0) < 0 && ::kill(::getppid(), 0) != 0;
  });
}

TEST(Confinement, threadsButNoProcesses) {
  expectConfined([] {
    bool ran = false;
    std::thread([&ran] { ran = true; }).join();
    return ran && ::fork() < 0;
  });
}

TEST(Confinement, whatIsOpenCanBeWrittenUpToTheLimit) {
  const test::Folder folder;
  const std::string file = folder.write("out", "").string();
  EXPECT_EXIT(
      {
        const int out = ::open(file.c_str(), O_WRONLY);
        confine(kLimits);
        const std::string block(1 << 20, 'x');
        if (::write(out, block.data(), block.size()) != static_cast<ssize_t>(block.size())) ::_exit(1);
        ::write(out, block.data(), 1) < 0 ? ::_exit(2) : ::_exit(3);
      },
      testing::KilledBySignal(SIGXFSZ), "");
  EXPECT_EQ(std::filesystem::file_size(file), 1U << 20);
}

TEST(Confinement, noCoreFiles) {
  expectConfined([] {
    rlimit core{};
    return ::getrlimit(RLIMIT_CORE, &core) == 0 && core.rlim_max == 0;
  });
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(Confinement, memoryEnds) {
  expectConfined([] { return std::malloc(std::size_t{2} << 30) == nullptr; });
}
#endif

}  // namespace
}  // namespace umbrage::io::reader

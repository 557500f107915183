// Every hostile file of the collection, and readers that are hostile themselves.
#include <dirent.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <set>
#include <thread>

#include "umbrage/io/load.hpp"
#include "umbrage/io/test_data.hpp"

namespace umbrage::io {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

std::size_t openDescriptors() {
  std::size_t count = 0;
  DIR* folder = ::opendir("/proc/self/fd");
  while (::readdir(folder) != nullptr) ++count;
  ::closedir(folder);
  return count;
}

std::set<fs::path> filesBelow(const fs::path& folder) {
  std::set<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) files.insert(entry.path());
  return files;
}

bool hasChildren() { return ::waitpid(-1, nullptr, WNOHANG) >= 0; }

TEST(Hostile, everyMalformedFileIsASceneOrAnError) {
  const fs::path data = test::testData();
  if (data.empty()) GTEST_SKIP() << "no test data: set UMBRAGE_TEST_DATA";
  const fs::path folder = data / "malformed";
  const auto before = filesBelow(folder);
  std::ofstream table;
  if (const char* name = std::getenv("UMBRAGE_OUTCOMES")) table.open(name);
  const auto descriptors = openDescriptors();
  for (const fs::path& file : before) {
    if (!fs::is_regular_file(file)) continue;
    const auto start = Clock::now();
    const auto scene = loadScene(file);
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    EXPECT_LT(seconds, 10.0) << file;
    if (!scene) {
      EXPECT_TRUE(exitCode(scene.error().code) == 3) << scene.error().text();
    } else {
      EXPECT_EQ(scene::findFault(*scene), std::nullopt) << file;
    }
    table << fs::relative(file, folder).string() << " | " << seconds << " | "
          << (scene ? std::to_string(scene::triangleCount(*scene)) + " triangles" : "error: " + scene.error().message);
    if (scene)
      for (const std::string& warning : scene->warnings) table << " | " << warning;
    table << "\n";
  }
  EXPECT_EQ(filesBelow(folder), before) << "a stray file was left";
  EXPECT_EQ(openDescriptors(), descriptors);
  EXPECT_FALSE(hasChildren());
}

// A stand-in for umbrage-reader, a shell script, for as long as the object lives.
class FakeReader {
 public:
  explicit FakeReader(const std::string& script) : program_(folder_.write("reader", "#!/bin/sh\n" + script)) {
    ::chmod(program_.c_str(), 0755);
    ::setenv("UMBRAGE_READER", program_.c_str(), 1);
  }
  ~FakeReader() { ::unsetenv("UMBRAGE_READER"); }
  FakeReader(const FakeReader&) = delete;
  FakeReader& operator=(const FakeReader&) = delete;

 private:
  test::Folder folder_;
  fs::path program_;
};

Result<scene::Scene> loadWith(const std::string& script, std::chrono::milliseconds limit = std::chrono::seconds(9)) {
  const FakeReader reader(script);
  const test::Folder folder;
  LoadOptions options;
  options.timeLimit = limit;
  auto scene = loadScene(folder.write("any.obj", "v 0 0 0\n"), options);
  EXPECT_FALSE(hasChildren());
  return scene;
}

void expectInputError(const Result<scene::Scene>& scene, const std::string& part) {
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().code, ErrorCode::input);
  EXPECT_NE(scene.error().message.find(part), std::string::npos) << scene.error().text();
  EXPECT_NE(scene.error().where.find("any.obj"), std::string::npos);
}

TEST(HostileReader, aborts) {
  expectInputError(loadWith("echo 'last words' >&2; kill -ABRT $$"), "signal 6, Aborted): last words");
}
TEST(HostileReader, segfaults) { expectInputError(loadWith("kill -SEGV $$"), "signal 11"); }
TEST(HostileReader, endsWithoutAScene) { expectInputError(loadWith("exit 0"), "not a scene"); }
TEST(HostileReader, failsWithoutASignal) {
  expectInputError(loadWith("echo why; exit 7"), "status 7 and no scene: why");
}
TEST(HostileReader, writesGarbage) { expectInputError(loadWith("head -c 100000 /dev/urandom >&3"), "not a scene"); }
TEST(HostileReader, cannotRun) {
  ::setenv("UMBRAGE_READER", "/nowhere/umbrage-reader", 1);
  const test::Folder folder;
  const auto scene = loadScene(folder.write("any.obj", ""));
  ::unsetenv("UMBRAGE_READER");
  expectInputError(scene, "cannot be started");
}

TEST(HostileReader, hangsWithAHelperOfItsOwn) {
  const auto start = Clock::now();
  const auto scene = loadWith("sleep 60 & sleep 60", std::chrono::milliseconds(600));
  expectInputError(scene, "takes too long");
  EXPECT_LT(Clock::now() - start, std::chrono::seconds(5));
}

TEST(HostileReader, leavesAHelperThatHoldsThePipeOpen) {
  const auto start = Clock::now();
  expectInputError(loadWith("sleep 60 & exit 0"), "not a scene");
  EXPECT_LT(Clock::now() - start, std::chrono::seconds(5));
}

TEST(HostileReader, floodsItsOutput) {
  const auto scene =
      loadWith("while :; do echo 0123456789012345678901234567890123456789; done", std::chrono::milliseconds(600));
  expectInputError(scene, "takes too long");
}

TEST(HostileReader, closesItsOutputAndStays) {
  expectInputError(loadWith("exec >&- 2>&-; sleep 60", std::chrono::milliseconds(600)), "takes too long");
}

// The true beginning of a hand-over, then nothing, or sizes from another world.
TEST(HostileReader, isCutShortOrClaimsTooMuch) {
  const std::string magic = R"(printf '\115\125\102\123\103\116\060\061\001\000\000\000' >&3;)";
  expectInputError(loadWith(magic), "not a scene");
  // up, unit 1.0, north 0, then a name of 2^60 bytes.
  expectInputError(loadWith(magic + R"(printf '\001\000\000\000\000\000\000\000\000\000\360\077' >&3;
    printf '\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\020' >&3)"),
                   "not a scene");
}

TEST(HostileReader, handsOverTooMuch) { expectInputError(loadWith("head -c 700000000 /dev/zero >&3"), "too large"); }

TEST(HostileReader, isWorkedWithFromManyThreads) {
  const test::Folder folder;
  const auto file = folder.write("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const auto descriptors = openDescriptors();
  std::vector<std::thread> threads;
  std::vector<std::size_t> counts(8, 0);
  for (std::size_t& count : counts)
    threads.emplace_back([&count, &file] {
      const auto scene = loadScene(file);
      if (scene) count = scene::triangleCount(*scene);
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(counts, std::vector<std::size_t>(8, 1));
  EXPECT_EQ(openDescriptors(), descriptors);
  EXPECT_FALSE(hasChildren());
}

TEST(HostileReader, servesAHostWithoutStandardStreams) {
  const test::Folder folder;
  const auto file = folder.write("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const auto descriptors = openDescriptors();
  const std::array<int, 2> kept = {::dup(0), ::dup(1)};
  ::close(0);
  ::close(1);
  const auto scene = loadScene(file);
  for (int fd = 0; fd < 2; ++fd) {
    ::dup2(kept[fd], fd);
    ::close(kept[fd]);
  }
  ASSERT_TRUE(scene) << scene.error().text();
  EXPECT_EQ(scene::triangleCount(*scene), 1U);
  EXPECT_EQ(openDescriptors(), descriptors);
}

TEST(HostileReader, servesAHostThatIgnoresItsChildren) {
  const test::Folder folder;
  const auto file = folder.write("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  ::signal(SIGCHLD, SIG_IGN);
  const auto scene = loadScene(file);
  ::signal(SIGCHLD, SIG_DFL);
  ASSERT_TRUE(scene) << scene.error().text();
  EXPECT_EQ(scene::triangleCount(*scene), 1U);
}

}  // namespace
}  // namespace umbrage::io

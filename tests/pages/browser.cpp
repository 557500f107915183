#include "browser.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace umbrage::pages_test {
namespace {

namespace fs = std::filesystem;

std::string readText(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

int shell(const std::string& command) {
  const int status = std::system(command.c_str());  // NOLINT(cert-env33-c): words of our own
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// The page with one more script at its end.
fs::path withScript(const fs::path& page, const std::string& script) {
  if (script.empty()) return page;
  std::string text = readText(page);
  const auto end = text.rfind("</body>");
  EXPECT_NE(end, std::string::npos) << page;
  text.insert(end, "<script>window.addEventListener('load', () => {" + script + "});</script>\n");
  const fs::path copy = page.parent_path() / ("with_script_" + page.filename().string());
  std::ofstream(copy, std::ios::binary) << text;
  return copy;
}

}  // namespace

bool browserIsHere() {
  static const bool here = shell("command -v chromium >/dev/null 2>&1") == 0;
  return here;
}

Opened open(const fs::path& page, const fs::path& scratch, const std::string& script) {
  fs::create_directories(scratch);
  const fs::path dom = scratch / "dom.html", log = scratch / "log.txt";
  const fs::path shown = withScript(page, script);
  // Debian's starter writes where HOME is. A network that resolves nothing is none.
  const std::string command = "HOME='" + scratch.string() +
                              "' timeout 100 chromium --headless --no-sandbox --disable-gpu --disable-dev-shm-usage "
                              "--no-first-run --host-resolver-rules='MAP * ~NOTFOUND' --user-data-dir='" +
                              (scratch / "profile").string() +
                              "' --enable-logging=stderr --v=0 --window-size=1280,1600 --dump-dom 'file://" +
                              shown.string() + "' >'" + dom.string() + "' 2>'" + log.string() + "'";
  EXPECT_EQ(shell(command), 0) << readText(log);
  Opened opened{readText(dom), {}};
  std::istringstream lines(readText(log));
  for (std::string line; std::getline(lines, line);)
    if (line.find("CONSOLE") != std::string::npos || line.find("net::ERR") != std::string::npos)
      opened.complaints.push_back(line);
  return opened;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t times = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + what.size())) ++times;
  return times;
}

void PageTest::SetUp() {
  if (!browserIsHere()) GTEST_SKIP() << "no Chromium here: pages are not opened";
  std::string pattern = (fs::temp_directory_path() / "umbrage_page_XXXXXX").string();
  ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
  folder_ = pattern;
}

void PageTest::TearDown() {
  std::error_code ignored;
  if (!folder_.empty()) fs::remove_all(folder_, ignored);
}

int PageTest::umbrage(const std::string& words) const {
  return shell("cd '" + folder_.string() + "' && '" UMBRAGE_PROGRAM "' " + words + " >said 2>&1");
}

}  // namespace umbrage::pages_test

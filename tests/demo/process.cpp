#include "process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>

namespace umbrage::demo_test {
namespace {

void change(const std::string& variable) {
  const auto sign = variable.find('=');
  const std::string name = variable.substr(0, sign), value = variable.substr(sign + 1);
  value.empty() ? ::unsetenv(name.c_str()) : ::setenv(name.c_str(), value.c_str(), 1);
}

[[noreturn]] void become(const std::vector<std::string>& words, const std::vector<std::string>& environment,
                         const std::filesystem::path& output) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const auto& variable : environment) change(variable);
  const int file = ::open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND, 0600);
  ::dup2(file, STDOUT_FILENO);
  ::dup2(file, STDERR_FILENO);
  std::vector<char*> arguments;
  for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  ::execvp(arguments[0], arguments.data());
  ::_exit(127);
}

}  // namespace

Process::Process(const std::vector<std::string>& words, const std::vector<std::string>& environment,
                 const std::filesystem::path& output)
    : output_(output) {
  id_ = ::fork();
  if (id_ == 0) become(words, environment, output);
}

Process::~Process() {
  if (!runs()) return;
  end(SIGTERM);
  if (!eventually([this] { return !runs(); }, Milliseconds(5000))) {
    end(SIGKILL);
    ::waitpid(id_, &status_, 0);
  }
}

void Process::end(int signal) { ::kill(id_, signal); }

bool Process::runs() {
  if (id_ > 0 && ::waitpid(id_, &status_, WNOHANG) == id_) id_ = -1;
  return id_ > 0;
}

int Process::wait(Milliseconds limit) {
  if (!eventually([this] { return !runs(); }, limit)) return -1;
  return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1;
}

std::string Process::said() const { return textOf(output_); }

bool isInstalled(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (::access((folder + "/" + program).c_str(), X_OK) == 0) return true;
  return false;
}

Folder::Folder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "umbrage-demo-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) std::abort();
  path_ = pattern;
}

Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string textOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace umbrage::demo_test

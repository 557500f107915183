// A program of somebody else's, spoken to through two pipes.
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>

#include "contestant.hpp"

namespace umbrage::benchmarks {
namespace {

// The two ends that stay here of a child's standard input and output.
class Child {
 public:
  explicit Child(const std::string& command) {
    int in[2], out[2];
    // No other child may inherit these ends: its copy would keep this one from seeing the end of its input.
    if (pipe2(in, O_CLOEXEC) != 0 || pipe2(out, O_CLOEXEC) != 0) return;
    id_ = fork();
    if (id_ == 0) {
      dup2(in[0], 0), dup2(out[1], 1);
      execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      _exit(127);
    }
    close(in[0]), close(out[1]);
    to_ = fdopen(in[1], "w"), from_ = fdopen(out[0], "r");
  }
  ~Child() {
    if (to_ != nullptr) std::fclose(to_);
    if (from_ != nullptr) std::fclose(from_);
    if (id_ > 0) waitpid(id_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  [[nodiscard]] bool say(const std::string& line) {
    return to_ != nullptr && std::fputs((line + "\n").c_str(), to_) >= 0 && std::fflush(to_) == 0;
  }
  /// The next line; empty at the end.
  [[nodiscard]] std::string hear() {
    char line[256];
    return from_ != nullptr && std::fgets(line, sizeof line, from_) != nullptr ? line : std::string();
  }

 private:
  pid_t id_ = -1;
  std::FILE* to_ = nullptr;
  std::FILE* from_ = nullptr;
};

class PeerFrame : public Contestant {
 public:
  explicit PeerFrame(const std::string& command) : child_(command) {}

  [[nodiscard]] bool ready() { return child_.hear().starts_with("ready"); }

  Result<double> frame(double shift) override {
    double time = 0.0;
    if (!child_.say("frame " + std::to_string(shift)) || std::sscanf(child_.hear().c_str(), "%lf", &time) != 1)
      return fail(ErrorCode::device, "the peer's program has ended");
    return time;
  }

 private:
  Child child_;
};

void replace(std::string& text, const std::string& what, const std::string& with) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
}

}  // namespace

Entry peerEntry(std::string name, std::string command) {
  return {name, [name, command](const Stage& stage, const Shot& shot) -> Result<std::unique_ptr<Contestant>> {
            std::string line = command;
            replace(line, "{scene}", stage.file.string());
            replace(line, "{shot}", shot.name);
            replace(line, "{picture}", (stage.file.parent_path() / (shot.name + "-" + name + ".ppm")).string());
            auto peer = std::make_unique<PeerFrame>(line);
            if (!peer->ready()) return fail(ErrorCode::device, "does not start", line);
            return peer;
          }};
}

}  // namespace umbrage::benchmarks

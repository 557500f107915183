#include "console.hpp"

#include <unistd.h>

#include <cerrno>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <memory>
#include <mutex>
#include <system_error>
#include <utility>

#include <fmt/format.h>

namespace umbrage::cli {
namespace {

// Best effort: when standard error is gone there is nobody left to tell.
void say(std::string_view text) {
  [[maybe_unused]] const auto written = std::fwrite(text.data(), 1, text.size(), stderr);
}

bool isControl(char c) { return (c >= 0 && c < 0x20) || c == 0x7f; }

/// The line of percentages, wiped when the last copy of the sink is gone.
class ProgressLine {
 public:
  ProgressLine() = default;
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine() {
    if (shown_ >= 0) say("\r\033[K");
  }
  void show(double fraction, std::string_view what) {
    const int percent = static_cast<int>(100.0 * fraction);
    if (percent == shown_ || std::chrono::steady_clock::now() - start_ < std::chrono::seconds(1)) return;
    shown_ = percent;
    say(fmt::format("\r\033[K{} {} %", what, percent));
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  int shown_ = -1;
};

// The one thing a signal handler may touch.
volatile std::sig_atomic_t pendingSignal = 0;
extern "C" void keepSignal(int signal) { pendingSignal = signal; }

std::string quoted(const std::string& word) {
  const bool plain = !word.empty() && std::ranges::all_of(word, [](unsigned char c) {
    return std::isalnum(c) != 0 || std::string_view("_-+=:,./@%#").find(static_cast<char>(c)) != std::string_view::npos;
  });
  if (plain) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace

void Console::warn(std::string_view text) const {
  if (!quiet_) say(fmt::format("warning: {}\n", printable(text)));
}

void Console::detail(std::string_view text) const {
  if (verbose_) say(fmt::format("{}\n", printable(text)));
}

void Console::error(const Error& error) const { say(fmt::format("error: {}\n", printable(error.text()))); }

std::string Console::commandLine() const {
  std::string line = "umbrage";
  for (const auto& word : words_) line += " " + quoted(word);
  return line;
}

ProgressSink Console::progress() const {
  if (!showsProgress()) return {};
  return [line = std::make_shared<ProgressLine>()](double fraction, std::string_view what) {
    line->show(fraction, what);
    return true;
  };
}

bool Console::showsProgress() const { return !quiet_ && ::isatty(STDERR_FILENO) != 0; }

Stage::Stage(const Console& console, std::string what) {
  if (!console.showsProgress()) return;
  teller_ = std::jthread([what = std::move(what)](const std::stop_token& end) {
    std::mutex mutex;
    std::unique_lock lock(mutex);
    std::condition_variable_any waiting;
    int seconds = 0;
    while (!waiting.wait_for(lock, end, std::chrono::seconds(1), [&] { return end.stop_requested(); }))
      say(fmt::format("\r\033[K{} ... {} s", what, ++seconds));
    if (seconds > 0) say("\r\033[K");
  });
}

Result<void> print(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(STDOUT_FILENO, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0 && errno == EPIPE) return {};
    if (written <= 0)
      return fail(ErrorCode::output, "cannot be written: " + std::generic_category().message(errno), "standard output");
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return {};
}

std::string printable(std::string_view text) {
  std::string clean(text);
  for (char& c : clean)
    if (isControl(c) && c != '\n') c = '?';
  return clean;
}

std::string shortName(std::string_view name) {
  constexpr std::size_t longest = 72;
  std::string text = printable(name.size() > longest ? fmt::format("{}...", name.substr(0, longest)) : name);
  for (char& c : text)
    if (c == '\n') c = ' ';
  return text.empty() ? "(no name)" : text;
}

DeferredSignals::DeferredSignals()
    : interrupt_(std::signal(SIGINT, keepSignal)), terminate_(std::signal(SIGTERM, keepSignal)) {
  pendingSignal = 0;
}

DeferredSignals::~DeferredSignals() {
  std::signal(SIGINT, interrupt_);
  std::signal(SIGTERM, terminate_);
  if (pendingSignal != 0) std::raise(pendingSignal);
}

bool DeferredSignals::pending() const { return pendingSignal != 0; }

}  // namespace umbrage::cli

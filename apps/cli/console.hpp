#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "umbrage/base/error.hpp"
#include "umbrage/base/progress.hpp"

namespace umbrage::cli {

/// What a command gives back when nothing went wrong: the text for standard output and the exit code (0, or 1 for a
/// check that failed).
struct Outcome {
  std::string text;
  int code = 0;
};

/// How much is said beside the result, all of it on standard error.
class Console {
 public:
  Console() = default;
  Console(bool quiet, bool verbose, std::vector<std::string> words = {})
      : quiet_(quiet), verbose_(verbose), words_(std::move(words)) {}

  /// Something the user should know: a dropped face, a guessed unit. Silent with --quiet.
  void warn(std::string_view text) const;
  /// What was decided and how long it took. Only with --verbose.
  void detail(std::string_view text) const;
  void error(const Error& error) const;
  /// Shows percentages on one line that is wiped at the end, on a terminal only and after a second only. Empty with
  /// --quiet.
  [[nodiscard]] ProgressSink progress() const;
  /// Is there anybody to show progress to?
  [[nodiscard]] bool showsProgress() const;
  /// What was typed, as a shell takes it, for pages that say how they were made.
  [[nodiscard]] std::string commandLine() const;

 private:
  bool quiet_ = false;
  bool verbose_ = false;
  std::vector<std::string> words_;  ///< after the program's name
};

/// While it lives, standard error names what goes on, where it is a terminal and the work takes more than a second.
class Stage {
 public:
  Stage(const Console& console, std::string what);

 private:
  std::jthread teller_;
};

/// Writes to standard output. A reader that has gone away is no error.
[[nodiscard]] Result<void> print(std::string_view text);

/// Text from a file, harmless on a terminal: control characters but line ends become '?'.
[[nodiscard]] std::string printable(std::string_view text);

/// A name from a file as one short printable piece of a line.
[[nodiscard]] std::string shortName(std::string_view name);

/// Milliseconds since it was made or last asked.
class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double elapsed = std::chrono::duration<double, std::milli>(now - start_).count();
    start_ = now;
    return elapsed;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// While it lives, SIGINT and SIGTERM wait: files are written whole and temporaries removed before the program ends by
/// them. Elsewhere both end the program at once, and nothing is on the disk. One at a time.
class DeferredSignals {
 public:
  DeferredSignals();
  ~DeferredSignals();
  DeferredSignals(const DeferredSignals&) = delete;
  DeferredSignals& operator=(const DeferredSignals&) = delete;
  /// One of them has come: long work had better stop.
  [[nodiscard]] bool pending() const;

 private:
  using Handler = void (*)(int);
  Handler interrupt_;
  Handler terminate_;
};

}  // namespace umbrage::cli

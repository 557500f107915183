#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "console.hpp"
#include "umbrage/base/error.hpp"

namespace CLI {
class App;
}

// A thin layer over CLI11, so that one source file includes it.
namespace umbrage::cli {

/// What a command does once its words are read.
using Run = std::function<Result<Outcome>(const Console&)>;

/// How an option behaves beside its value.
struct Manner {
  const char* group = "Options";
  bool required = false;
  bool repeatable = false;
};

/// An option (or, without dashes, a positional word) with one value. `take` is given the word, once per occurrence, and answers
/// what is wrong with it, or nothing; the answer is shown after the option's name.
void addOption(CLI::App& app, const std::string& name, const std::string& form, const std::string& help,
               std::function<std::string(const std::string&)> take, const Manner& manner);

void addFlag(CLI::App& app, const std::string& name, const std::string& help, bool& target);

/// An option that answers at once, whatever else is wanted of the command: `answer` is given its word (none without a form).
void addAnswer(CLI::App& app, const std::string& name, const std::string& form, const std::string& help,
               std::function<Result<Outcome>(const std::string&)> answer, const Manner& manner = {});

/// An option whose word `parse` (word -> Result) turns into `target`.
template <class T, class Parse>
void addValue(CLI::App& app, const std::string& name, const std::string& form, const std::string& help, T& target,
              Parse parse, const Manner& manner = {}) {
  const auto take = [&target, parse](const std::string& word) -> std::string {
    auto value = parse(word);
    if (!value) return value.error().message;
    target = std::move(*value);
    return {};
  };
  addOption(app, name, form, help, take, manner);
}

/// A repeatable option whose words are collected.
template <class T, class Parse>
void addValues(CLI::App& app, const std::string& name, const std::string& form, const std::string& help,
               std::vector<T>& target, Parse parse, Manner manner = {}) {
  manner.repeatable = true;
  const auto take = [&target, parse](const std::string& word) -> std::string {
    auto value = parse(word);
    if (!value) return value.error().message;
    target.push_back(std::move(*value));
    return {};
  };
  addOption(app, name, form, help, take, manner);
}

/// A plain word, for example a path; never empty.
void addWord(CLI::App& app, const std::string& name, const std::string& form, const std::string& help,
             std::string& target, const Manner& manner = {});

}  // namespace umbrage::cli

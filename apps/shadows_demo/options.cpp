#include "options.hpp"

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <cstdio>
#include <map>
#include <sstream>

#include "umbrage/base/error.hpp"

namespace umbrage::demo {
namespace {

constexpr int kSmallest = 100, kLargest = 8192;

const std::map<std::string, coin::Method>& methods() {
  static const std::map<std::string, coin::Method> all = {{"automatic", coin::Method::automatic},
                                                          {"zpass", coin::Method::zPass},
                                                          {"zfail", coin::Method::zFail},
                                                          {"ray_traced", coin::Method::rayTraced}};
  return all;
}

// What is wrong with the word, or nothing: CLI11's way.
std::string takeSize(const std::string& word, Options& options) {
  int width = 0, height = 0, end = 0;
  const bool read = std::sscanf(word.c_str(), "%5dx%5d%n", &width, &height, &end) == 2;
  const bool whole = read && static_cast<std::size_t>(end) == word.size();
  if (!whole || std::min(width, height) < kSmallest || std::max(width, height) > kLargest)
    return fmt::format("'{}' is no size; it is WIDTHxHEIGHT, each {} to {}", word, kSmallest, kLargest);
  options.width = width;
  options.height = height;
  return {};
}

std::string takeMethod(const std::string& word, Options& options) {
  const auto known = methods().find(word);
  if (known == methods().end())
    return fmt::format("there is no method '{}'; there are automatic, zpass, zfail, ray_traced", word);
  options.method = known->second;
  return {};
}

std::string takeKeys(const std::string& word, Options& options) {
  std::istringstream names(word);
  for (std::string name; std::getline(names, name, ',');) {
    options.keys.push_back(keyNamed(name));
    if (options.keys.back() == nullptr) return fmt::format("there is no key '{}'", name);
  }
  return {};
}

void addWord(CLI::App& app, const char* name, const char* form, const char* help,
             std::function<std::string(std::string&)> take) {
  app.add_option(
         name, [](const CLI::results_t&) { return true; }, help)
      ->type_name(form)
      ->expected(1)
      ->allow_extra_args(false)
      ->check(CLI::Validator(std::move(take), ""));
}

void declare(CLI::App& app, Options& options) {
  app.add_option("-f,--file", options.file,
                 "Model to show: Open Inventor (.iv) or VRML (.wrl); its own cameras and lights are left out")
      ->type_name("FILE");
  addWord(app, "--size", "WxH", "Size of the window, 900x700 unless said otherwise",
          [&](std::string& word) { return takeSize(word, options); });
  addWord(app, "--method", "NAME", "Who computes the shadows: automatic, zpass, zfail, ray_traced",
          [&](std::string& word) { return takeMethod(word, options); });
  app.add_option("--windows", options.windows, "So many viewers, each in a window, on the one scene (1 to 4)")
      ->type_name("N")
      ->check(CLI::Range(1, 4));
  app.add_option("--folder", options.folder,
                 "Where the keys V and X write their files; the current folder unless said otherwise")
      ->type_name("FOLDER");
  app.add_option("--picture", options.picture, "Writes a picture of the window there (.png) and ends")
      ->type_name("FILE");
  addWord(app, "--press", "KEYS", "Keys to press at the beginning, by the names below: 2,O,F2",
          [&](std::string& word) { return takeKeys(word, options); });
  app.add_flag("--verbose", options.verbose, "Tells on standard error what each key did and what each picture took");
}

int explain(const CLI::App& app, const CLI::ParseError& problem) {
  if (problem.get_name() == "CallForVersion" || problem.get_name() == "CallForHelp") {
    fmt::print("{}\n", problem.get_name() == "CallForHelp" ? app.help() : problem.what());
    return 0;
  }
  fmt::print(stderr, "error: {}\nSee: shadows_demo --help\n", problem.what());
  return exitCode(ErrorCode::usage);
}

}  // namespace

Request parse(std::vector<std::string> words) {
  CLI::App app("Shows a model in a room, with exact shadows of every light, and keys to try them out.", "shadows_demo");
  app.set_version_flag("--version", "shadows_demo " UMBRAGE_VERSION);
  app.footer(keyHelp());
  Options options;
  declare(app, options);
  std::reverse(words.begin(), words.end());
  try {
    app.parse(std::move(words));
  } catch (const CLI::ParseError& problem) {
    return {std::nullopt, explain(app, problem)};
  }
  return {options, 0};
}

}  // namespace umbrage::demo

#include <algorithm>
#include <csignal>
#include <exception>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "arguments.hpp"
#include "commands.hpp"

namespace umbrage::cli {
namespace {

struct Command {
  const char* name;
  const char* help;
  Run (*add)(CLI::App&);
};
constexpr Command kCommands[] = {
    {"info", "Triangles, edges, parts, bounds, materials, lights and warnings of a scene", addInfo},
    {"techniques", "Every technique, its traits, and whether it runs on this machine", addTechniques},
    {"sun", "Where the sun stands at a place and time", addSun},
    {"render", "A picture of a scene with exact shadows", addRender},
    {"radiosity", "Light between surfaces: their light as a picture, or as colours at the vertices of a model",
     addRadiosity},
    {"compare", "Two techniques on one picture: which pixels differ", addCompare},
    {"gallery", "Every technique on one scene: a page of pictures, errors and costs", addGallery},
    {"profile", "The shadows of a day: every step over the scene, and the time in shadow", addProfile},
    {"outline", "Shadows on a horizontal plane as exact outlines (GeoJSON, DXF, SVG)", addOutline},
    {"envelope", "The ground that is in shadow at some moment of a period, as exact outlines", addEnvelope},
    {"hours", "Exact hours of sun at points, on a grid or on faces, as table, heat map, GeoTIFF or model", addHours},
    {"isochrones", "Where a plane has at least so many hours of sun or shadow, as outlines", addIsochrones},
    {"verify", "Whether a scene meets a regulation of sunlight, with evidence; exit code 1 where it does not",
     addVerify},
    {"terrain", "Hours of sun on a height raster of any size, tile by tile", addTerrain},
    {"cut", "Surfaces cut into lit and shadowed polygons, as model, and their areas", addCut},
    {"sample", "Writes one of the scenes that come with the program", addSample},
};

int fail(const Console& console, const Error& error) {
  console.error(error);
  return exitCode(error.code);
}

int run(const Run& command, const Console& console) {
  const auto outcome = command(console);
  if (!outcome) return fail(console, outcome.error());
  if (const auto printed = print(outcome->text); !printed) return fail(console, printed.error());
  return outcome->code;
}

std::string commandNames() {
  std::string names;
  for (const auto& command : kCommands) names += (names.empty() ? "" : ", ") + std::string(command.name);
  return names;
}

// What CLI11 calls a missing subcommand is mostly a mistyped one.
std::string describe(const CLI::ParseError& problem, const std::string& command,
                     const std::vector<std::string>& words) {
  const auto word = std::find_if(words.begin(), words.end(), [](const auto& w) { return !w.starts_with('-'); });
  if (!command.empty()) return problem.what();
  if (word == words.end()) return fmt::format("a command is missing; there are {}", commandNames());
  return fmt::format("there is no command '{}'; there are {}", *word, commandNames());
}

// CLI11's many exit codes become ours: help and version are no errors, all else is usage.
int explain(const CLI::App& app, const CLI::ParseError& problem, const std::vector<std::string>& words) {
  if (problem.get_name() == "CallForVersion")
    return print(fmt::format("{}\n", problem.what())) ? problem.get_exit_code() : 3;
  if (problem.get_name() == "CallForHelp") return print(app.help()) ? 0 : 3;
  const auto given = app.get_subcommands();
  const auto command = given.empty() ? std::string() : given.front()->get_name();
  const auto help = command.empty() ? std::string("umbrage --help") : fmt::format("umbrage {} --help", command);
  Console().error({ErrorCode::usage, fmt::format("{}\nSee: {}", describe(problem, command, words), help), {}});
  return exitCode(ErrorCode::usage);
}

int main(const std::vector<std::string>& words) {
  CLI::App app("Exact shadows of 3D scenes.", "umbrage");
  app.set_version_flag("--version", "umbrage " UMBRAGE_VERSION);
  bool quiet = false, verbose = false;
  app.add_flag("--quiet", quiet, "No warnings and no progress");
  app.add_flag("--verbose", verbose, "Say what is decided and how long it takes");
  app.require_subcommand(1);
  app.fallthrough();

  std::vector<std::pair<CLI::App*, Run>> commands;
  for (const auto& command : kCommands) {
    CLI::App* sub = app.add_subcommand(command.name, command.help);
    sub->footer("--quiet and --verbose may be given to every command.");
    commands.emplace_back(sub, command.add(*sub));
  }
  const auto named = [&]() -> const Run* {
    for (const auto& [sub, action] : commands)
      if (sub->parsed()) return &action;
    return nullptr;
  };

  try {
    auto reversed = completeGround(words);
    std::reverse(reversed.begin(), reversed.end());
    app.parse(std::move(reversed));
  } catch (const CLI::ParseError& problem) {
    return explain(app, problem, words);
  }
  return run(*named(), Console(quiet, verbose, words));
}

// What makes a command's work smaller.
std::string memoryRemedy(const std::vector<std::string>& words) {
  const auto is = [&](std::initializer_list<std::string_view> names) {
    return std::any_of(words.begin(), words.end(),
                       [&](const auto& word) { return std::find(names.begin(), names.end(), word) != names.end(); });
  };
  if (is({"verify", "envelope", "hours"})) return "a larger --grid or a smaller scene";
  if (is({"terrain"})) return "a smaller --tile";
  if (is({"isochrones"})) return "a larger --tolerance or a smaller scene";
  if (is({"render", "radiosity", "compare", "gallery", "profile"})) return "a smaller --size or a smaller scene";
  return "a smaller scene";
}

}  // namespace
}  // namespace umbrage::cli

int main(int count, char** words) {
  // A reader of our output that goes away is no reason to be killed; writes report it.
  std::signal(SIGPIPE, SIG_IGN);
  // Neither is a limit on the size of files.
  std::signal(SIGXFSZ, SIG_IGN);
  using namespace umbrage;
  const std::vector<std::string> all(words + 1, words + count);
  try {
    return cli::main(all);
  } catch (const std::bad_alloc&) {
    cli::Console().error({ErrorCode::input, "memory is exhausted; try " + cli::memoryRemedy(all), {}});
  } catch (const std::exception& problem) {
    cli::Console().error({ErrorCode::input, std::string("unexpected: ") + problem.what(), {}});
  }
  return exitCode(ErrorCode::input);
}

#include "house_plan.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <optional>
#include <sstream>

namespace umbrage::layering {
namespace {

/// A foreign library's headers and the only rooms that may name them; "apps", "tests", "examples" and "benchmarks" are the
/// folders of those names, "*" is everywhere. `inInterface`: installed headers may name it too.
struct ForeignRule {
  std::string_view prefix;
  std::set<std::string_view> rooms;
  bool inInterface = false;
};

const std::vector<ForeignRule>& foreignRules() {
  static const std::vector<ForeignRule> rules = {
      {"glm/", {"*"}, true},
      {"tl/", {"*"}, true},
      {"fmt/", {"*"}},
      {"epoxy/", {"gl", "examples", "tests"}, true},
      {"EGL/", {"gl", "examples"}},
      {"embree3/", {"trace", "benchmarks"}},
      {"tbb/", {"parallel", "trace", "techniques_cpu", "study", "benchmarks"}},
      {"assimp/", {"io"}},
      {"tiny_gltf.h", {"io"}},
      {"Inventor/", {"inventor", "io", "coin", "apps", "tests", "examples", "benchmarks"}, true},
      {"Q", {"apps", "examples"}},
      {"geos", {"io"}},
      {"proj.h", {"geo"}},
      {"gdal", {"io", "report"}},
      {"cpl_", {"io", "report"}},
      {"ogr_", {"io", "report"}},
      {"polyclipping/", {"outline"}},
      {"nlohmann/", {"io", "report", "rules", "apps", "tests", "benchmarks"}},
      {"cairo/", {"report"}},
      {"cairo", {"report"}},
      {"gif_lib.h", {"report"}},
      {"png.h", {"png"}},
      {"erfa", {"sun"}},
      {"date/", {"sun"}},
      {"CLI/", {"apps"}},
      {"gtest/", {"tests"}},
      {"gmock/", {"tests"}},
      {"rapidcheck", {"tests"}},
      {"benchmark/", {"benchmarks"}},
      {"Ogre", {"benchmarks"}},
      {"sys/", {"base", "io", "apps", "tests", "benchmarks"}},
      {"unistd.h", {"base", "io", "apps", "tests", "benchmarks"}},
      {"fcntl.h", {"base", "io", "apps", "tests", "benchmarks"}},
      {"signal.h", {"io", "apps", "tests"}},
      {"poll.h", {"io", "apps", "tests"}},
      {"spawn.h", {"io", "tests"}},
      {"dirent.h", {"io"}},
      {"linux/", {"io"}},
      {"pthread.h", {"io"}},
      {"fnmatch.h", {"scene"}},
      {"immintrin.h", {"*"}},
      {"umbrage_presets/", {"rules"}},
      {"umbrage_shaders/", {"gl", "render", "techniques_gl", "coin", "tests"}},
      {"umbrage_texts/", {"report"}},
  };
  return rules;
}

bool isStandardHeader(std::string_view name) {
  return std::ranges::all_of(name, [](char c) { return std::islower(static_cast<unsigned char>(c)) || c == '_'; });
}

/// The same text with comments blanked out; strings stay (shader texts live in files of their own).
std::string withoutComments(std::string_view text) {
  std::string code(text);
  bool line = false, block = false, quoted = false;
  for (std::size_t i = 0; i < code.size(); ++i) {
    const char c = code[i];
    const char next = i + 1 < code.size() ? code[i + 1] : '\0';
    if (c == '\n') {
      line = quoted = false;
    } else if (line) {
      code[i] = ' ';
    } else if (block) {
      block = !(c == '*' && next == '/');
      code[i] = ' ';
      if (!block) code[++i] = ' ';
    } else if (quoted) {
      if (c == '\\') ++i;
      quoted = c != '"';
    } else if (c == '"') {
      quoted = true;
    } else if (c == '/' && (next == '/' || next == '*')) {
      line = next == '/';
      block = !line;
      code[i] = code[i + 1] = ' ';
      ++i;
    }
  }
  return code;
}

struct Include {
  std::string name;
  bool angled = false;
};

std::optional<Include> includeIn(std::string_view line) {
  const auto skip = [&](std::string_view token) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    const bool found = line.starts_with(token);
    if (found) line.remove_prefix(token.size());
    return found;
  };
  if (!skip("#") || !skip("include")) return std::nullopt;
  const bool angled = skip("<");
  if (!angled && !skip("\"")) return std::nullopt;
  return Include{std::string(line.substr(0, line.find(angled ? '>' : '"'))), angled};
}

bool isNameCharacter(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

/// The first gl[A-Z]..( of a line, or nothing.
std::optional<std::string> glCallIn(std::string_view line) {
  for (std::size_t at = line.find("gl"); at != line.npos; at = line.find("gl", at + 2)) {
    if (at > 0 && isNameCharacter(line[at - 1])) continue;
    std::size_t end = at;
    while (end < line.size() && isNameCharacter(line[end])) ++end;
    const std::string_view name = line.substr(at, end - at);
    const bool capital = name.size() > 2 && std::isupper(static_cast<unsigned char>(name[2]));
    if (capital && end < line.size() && line[end] == '(') return std::string(name);
  }
  return std::nullopt;
}

/// "src/umbrage/techniques/gl/zfail/x.cpp" -> "techniques/gl/zfail"; empty where the path is no technique's own folder.
std::string techniqueFolder(std::string_view path) {
  const auto start = path.find("techniques/");
  if (start == path.npos) return {};
  std::string_view rest = path.substr(start);
  std::size_t end = std::string_view("techniques").size();
  for (int level = 0; level < 2; ++level) {
    end = rest.find('/', end + 1);
    if (end == rest.npos) return {};
  }
  return std::string(rest.substr(0, end));
}

/// Checks one file line by line.
class FileCheck {
 public:
  FileCheck(const HousePlan& plan, const std::string& path) : plan_(plan), path_(path) {
    constexpr std::string_view sources = "src/umbrage/";
    if (path.starts_with(sources)) {
      room_ = plan.roomOf(path.substr(sources.size()));
      isTest_ = path.ends_with("_test.cpp");
      if (!room_) add(0, "is in no room that CMake knows");
      if (room_) isPublic_ = room_->headers.contains(path.substr(sources.size() + room_->folder.size() + 1));
    } else {
      place_ = path.substr(0, path.find('/'));
      isTest_ = place_ == "tests" || path.ends_with("_test.cpp");
    }
  }

  std::vector<Violation> run(std::string_view text) {
    std::istringstream lines(withoutComments(text));
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
      if (const auto include = includeIn(line)) {
        checkInclude(number, *include);
      } else if (const auto call = glCallIn(line); call && !mayCallGl()) {
        add(number, "calls OpenGL (" + *call + ") outside gl/");
      }
    }
    return std::move(violations_);
  }

 private:
  [[nodiscard]] bool mayCallGl() const {
    return room_ ? room_->name == "gl" : place_ == "examples" || place_ == "tests";
  }

  void checkInclude(int line, const Include& include) {
    if (include.name.find("..") != include.name.npos) add(line, "includes through \"..\": " + include.name);
    if (include.name.starts_with("umbrage/")) return checkRoom(line, include.name.substr(8));
    if (include.angled) checkForeign(line, include.name);
  }

  void checkRoom(int line, const std::string& name) {
    const Room* target = plan_.roomOf(name);
    if (!target) return add(line, "includes " + name + ", which is in no room");
    if (room_ && !(isTest_ ? room_->testUses : room_->uses).contains(target->name)) {
      add(line, room_->name + " includes " + target->name + " without depending on it");
    }
    const bool detail = name.find("/detail/") != name.npos;
    if (detail && target != room_) add(line, "includes the detail of " + target->name);
    if (detail && isPublic_) add(line, "is installed, but includes a detail");
    const std::string own = techniqueFolder(path_), other = techniqueFolder("src/umbrage/" + name);
    if (!own.empty() && !other.empty() && own != other) add(line, "a technique includes another: " + other);
  }

  void checkForeign(int line, const std::string& name) {
    if (isStandardHeader(name)) return;
    const auto rule = std::ranges::find_if(foreignRules(), [&](const auto& r) { return name.starts_with(r.prefix); });
    if (rule == foreignRules().end()) return add(line, "includes <" + name + ">, which has no room");
    const std::string_view here = room_ ? std::string_view(room_->name) : std::string_view(place_);
    const bool allowed =
        rule->rooms.contains("*") || rule->rooms.contains(here) || (isTest_ && rule->rooms.contains("tests"));
    if (!allowed) add(line, "includes <" + name + "> outside its room");
    if (isPublic_ && !rule->inInterface) add(line, "is installed, but includes <" + name + ">");
  }

  void add(int line, std::string what) { violations_.push_back({path_, line, std::move(what)}); }

  const HousePlan& plan_;
  std::string path_;
  const Room* room_ = nullptr;
  std::string place_;
  bool isTest_ = false, isPublic_ = false;
  std::vector<Violation> violations_;
};

}  // namespace

const Room* HousePlan::roomOf(std::string_view path) const {
  const Room* best = nullptr;
  for (const Room& room : rooms) {
    const bool inside = path.starts_with(room.folder + "/");
    if (inside && (!best || room.folder.size() > best->folder.size())) best = &room;
  }
  return best;
}

HousePlan readHousePlan(const std::filesystem::path& table) {
  HousePlan plan;
  std::ifstream file(table);
  std::string line;
  const auto find = [&](const std::string& name) { return std::ranges::find(plan.rooms, name, &Room::name); };
  while (std::getline(file, line)) {
    std::istringstream words(line);
    std::string kind, name, word;
    words >> kind >> name;
    if (kind == "room") {
      words >> word;
      plan.rooms.push_back({name, word, {name}, {name}, {}});
      continue;
    }
    Room& room = *find(name);
    while (words >> word) {
      if (kind == "headers") {
        room.headers.insert(word);
      } else if (const auto lower = find(word); lower != plan.rooms.end()) {
        if (kind == "depends") room.uses.insert(lower->uses.begin(), lower->uses.end());
        room.testUses.insert(lower->uses.begin(), lower->uses.end());
      }
    }
  }
  return plan;
}

std::vector<Violation> findViolations(const HousePlan& plan, const std::string& path, std::string_view text) {
  return FileCheck(plan, path).run(text);
}

}  // namespace umbrage::layering

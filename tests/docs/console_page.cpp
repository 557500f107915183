#include "console_page.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace umbrage::docs_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBlock = "```console";
constexpr const char* kCommand = "$ umbrage ";

std::string textOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

bool holdsCommand(const fs::path& file) {
  return file.extension() == ".md" && textOf(file).find(std::string(kBlock) + "\n" + kCommand) != std::string::npos;
}

}  // namespace

std::vector<std::string> wordsOf(const std::string& line) {
  std::vector<std::string> words;
  bool quoted = false, open = false;
  for (const char c : line) {
    if (c == ' ' && !quoted) {
      open = false;
      continue;
    }
    if (!open) words.emplace_back();
    open = true;
    if (c == '\'')
      quoted = !quoted;
    else
      words.back() += c;
  }
  return words;
}

std::string withCommandsRun(const fs::path& page, const RunCommand& run) {
  std::istringstream lines(textOf(page));
  std::string result, line;
  bool inBlock = false, afterCommand = false;
  while (std::getline(lines, line)) {
    if (line.starts_with("```")) {
      inBlock = !inBlock && line == kBlock;
      afterCommand = false;
    }
    const bool isCommand = inBlock && line.starts_with(kCommand);
    if (afterCommand && !isCommand) continue;
    if (afterCommand) result += '\n';
    result += line + '\n';
    if (!isCommand) continue;
    afterCommand = true;
    auto words = wordsOf(line.substr(std::string(kCommand).size()));
    result += run(words, page.parent_path());
  }
  return result;
}

std::vector<fs::path> pagesWithCommands(const fs::path& folder) {
  std::vector<fs::path> pages;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && holdsCommand(entry.path())) pages.push_back(entry.path());
  std::sort(pages.begin(), pages.end());
  return pages;
}

}  // namespace umbrage::docs_test

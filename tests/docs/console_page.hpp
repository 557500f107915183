#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace umbrage::docs_test {

/// How a command ended: what it printed, with "(exit code N)" as a last line where N is not 0.
using RunCommand =
    std::function<std::string(const std::vector<std::string>& words, const std::filesystem::path& folder)>;

/// A page of the documentation with every command in its ```console blocks run anew. A command is a line "$ umbrage WORDS"; what follows,
/// to the next command or the block's end, is what it prints. Commands run in the page's folder.
[[nodiscard]] std::string withCommandsRun(const std::filesystem::path& page, const RunCommand& run);

/// All pages below a folder that hold a command, sorted.
[[nodiscard]] std::vector<std::filesystem::path> pagesWithCommands(const std::filesystem::path& folder);

/// The words of a line as a shell parts them, where it holds no more than blanks and single quotes.
[[nodiscard]] std::vector<std::string> wordsOf(const std::string& line);

}  // namespace umbrage::docs_test

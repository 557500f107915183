#pragma once

#include <filesystem>
#include <string_view>

#include "umbrage/base/error.hpp"
#include "umbrage/rules/rule.hpp"

namespace umbrage::rules {

/// A rule as JSON; docs/verify.md names all members. Nothing is guessed: members that are not known are errors, so that a slip of the pen
/// does not change a rule.
/// Errors: input, with the member that is missing, of a wrong kind, or contradicts another.
[[nodiscard]] Result<Rule> parseRule(std::string_view json, const std::string& where);

/// A rule of one's own. Errors: input.
[[nodiscard]] Result<Rule> readRule(const std::filesystem::path& path);

/// The rules that come with the library, by name.
[[nodiscard]] const std::vector<Rule>& presets();

/// The text of a preset's file, to make a rule of one's own of. Errors: usage.
[[nodiscard]] Result<std::string> presetText(const std::string& name);

/// A preset by its name, or the rule of a file where the name ends in ".json". Errors: usage (no such preset, with the names that come
/// near), input (the file).
[[nodiscard]] Result<Rule> findRule(const std::string& name);

}  // namespace umbrage::rules

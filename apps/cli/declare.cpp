#include "declare.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "parse.hpp"

namespace umbrage::cli {

void addOption(CLI::App& app, const std::string& name, const std::string& form, const std::string& help,
               std::function<std::string(const std::string&)> take, const Manner& manner) {
  CLI::Option* option = app.add_option(
      name, [](const CLI::results_t&) { return true; }, help);
  option->type_name(form)->expected(1)->allow_extra_args(false)->required(manner.required)->group(manner.group);
  if (manner.repeatable) option->take_all();
  option->check(CLI::Validator([take = std::move(take)](std::string& word) { return take(word); }, ""));
}

void addFlag(CLI::App& app, const std::string& name, const std::string& help, bool& target) {
  app.add_flag(name, target, help);
}

void addAnswer(CLI::App& app, const std::string& name, const std::string& form, const std::string& help,
               std::function<Result<Outcome>(const std::string&)> answer, const Manner& manner) {
  const auto tell = [answer = std::move(answer)](const std::string& word) -> std::string {
    const auto outcome = answer(word);
    // What the version does: its text is printed, and nothing that is required is missed.
    if (outcome) throw CLI::CallForVersion(outcome->text, outcome->code);
    return outcome.error().message;
  };
  if (!form.empty()) return addOption(app, name, form, help, tell, manner);
  app.add_flag_callback(
         name,
         [name, tell] {
           if (const auto problem = tell({}); !problem.empty()) throw CLI::ValidationError(name, problem);
         },
         help)
      ->group(manner.group);
}

void addWord(CLI::App& app, const std::string& name, const std::string& form, const std::string& help,
             std::string& target, const Manner& manner) {
  addValue(app, name, form, help, target, parseWord, manner);
}

}  // namespace umbrage::cli

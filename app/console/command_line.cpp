#include "app/console/command_line.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "io/input_error.h"
#include "io/nearest_word.h"

namespace app {
namespace {

bool IsUtf8(const std::string& text) {
  try {
    static_cast<void>(nlohmann::json(text).dump());
    return true;
  } catch (const nlohmann::json::type_error&) {
    return false;
  }
}

std::vector<const CLI::App*> CommandsOf(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

const CLI::App* Find(const std::vector<const CLI::App*>& commands, const std::string& name) {
  for (const CLI::App* command : commands) {
    if (command->get_name() == name) return command;
  }
  return nullptr;
}

/// Whether a command that has commands of its own can do without them.
bool TakesArguments(const CLI::App& app) {
  const std::vector<const CLI::Option*> options = app.get_options();
  return std::any_of(options.begin(), options.end(),
                     [](const CLI::Option* option) { return option->get_positional(); });
}

/// Otherwise it would be said that a command is missing, which is not what is wrong.
void RequireKnownOption(const CLI::App& app, const std::string& word) {
  if (!word.starts_with("--") || word == "--") return;
  const std::string name = word.substr(0, word.find('='));
  std::string command;  // as it is called
  for (const CLI::App* at = &app; at != nullptr; at = at->get_parent()) {
    if (at->get_option_no_throw(name) != nullptr) return;
    command = at->get_name() + " " + command;
  }
  throw io::InputError("unknown option " + io::Quoted(word) + "; see " + command + "--help");
}

}  // namespace

std::vector<std::string> ArgumentsOf(int argc, const char* const* argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  for (const std::string& argument : arguments) {
    if (IsUtf8(argument)) continue;
    throw io::InputError("the argument " + io::Quoted(argument),
                         "is not valid UTF-8; give files and folders other names");
  }
  std::error_code ignored;
  const std::string here = std::filesystem::current_path(ignored).string();
  if (!IsUtf8(here)) {
    throw io::InputError("the current folder " + io::Quoted(here),
                         "has a name that is not valid UTF-8; rename it");
  }
  const auto command = std::find_if(arguments.begin(), arguments.end(),
                                    [](const std::string& a) { return !a.starts_with('-'); });
  if (command != arguments.end() && *command == "help") {
    arguments.erase(command);
    arguments.emplace_back("--help");
  }
  return arguments;
}

void RequireKnownCommands(const CLI::App& app, const std::vector<std::string>& arguments) {
  const CLI::App* at = &app;
  for (const std::string& word : arguments) {
    const std::vector<const CLI::App*> commands = CommandsOf(*at);
    if (commands.empty()) return;
    if (word.starts_with('-')) {  // flags; none of them has a value
      if (!TakesArguments(*at)) RequireKnownOption(*at, word);
      continue;
    }
    const CLI::App* command = Find(commands, word);
    if (command != nullptr) {
      at = command;
      continue;
    }
    if (TakesArguments(*at)) return;
    std::vector<std::string> names;
    std::string known;
    for (const CLI::App* one : commands) {
      names.push_back(one->get_name());
      known += (known.empty() ? "" : ", ") + one->get_name();
    }
    const std::string nearest = io::NearestWord(word, names);
    throw io::InputError("unknown command " + io::Quoted(word) +
                         (nearest.empty() ? "; " : "; did you mean `" + nearest + "`? ") +
                         "commands here: " + known);
  }
}

std::string CommandName(const CLI::App& app) {
  const std::vector<CLI::App*> parsed = app.get_subcommands();
  return app.get_name() + (parsed.empty() ? "" : " " + CommandName(*parsed.front()));
}

}  // namespace app

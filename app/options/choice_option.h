#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

namespace app {

/// Lets an option take one of these words alone, and names them when it is another one.
CLI::Validator Choice(const std::vector<std::string>& words);

/// The same for an option of an enumeration, for `transform`: each word stands for a value.
/// (CLI11's own transformer takes the number of a value too.)
template <typename Enum>
CLI::Validator ChoiceOf(const std::vector<std::pair<std::string, Enum>>& choices) {
  std::vector<std::string> words;
  for (const auto& choice : choices) words.push_back(choice.first);
  CLI::Validator known = Choice(words);
  const std::string description = known.get_description();
  return {[choices, known](std::string& text) {
            const std::string wrong = known(text);
            for (const auto& [word, value] : choices) {
              if (text != word) continue;
              text = std::to_string(static_cast<int>(value));
              break;
            }
            return wrong;
          },
          description};
}

/// The same for an enumeration whose values are named in their order.
template <typename Enum>
CLI::Validator ChoiceByIndex(const std::vector<std::string>& names) {
  std::vector<std::pair<std::string, Enum>> choices;
  for (const std::string& name : names) {
    choices.emplace_back(name, static_cast<Enum>(choices.size()));
  }
  return ChoiceOf(choices);
}

}  // namespace app

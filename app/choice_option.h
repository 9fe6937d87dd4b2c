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

}  // namespace app

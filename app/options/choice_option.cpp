#include "app/options/choice_option.h"

#include <algorithm>

#include "io/input_error.h"
#include "io/nearest_word.h"

namespace app {
namespace {

/// "coco, bop or tum"
std::string Alternatives(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    text += (i == 0 ? "" : i + 1 < words.size() ? ", " : " or ") + words[i];
  }
  return text;
}

}  // namespace

CLI::Validator Choice(const std::vector<std::string>& words) {
  const auto check = [words](std::string& text) -> std::string {
    if (std::find(words.begin(), words.end(), text) != words.end()) return "";
    const std::string nearest = io::NearestWord(text, words);
    return "expected " + Alternatives(words) + ", found " + io::Quoted(text) +
           (nearest.empty() ? "" : "; did you mean `" + nearest + "`?");
  };
  return {check, Alternatives(words)};
}

}  // namespace app

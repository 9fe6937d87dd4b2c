#pragma once

#include <CLI/CLI.hpp>
#include <sstream>
#include <string>

namespace app {

/// Help whose descriptions of options are folded at a hundred columns, between words.
class WrappedHelp : public CLI::Formatter {
 public:
  std::string make_option_desc(const CLI::Option* option) const override {
    const std::size_t width = 100 - get_column_width();
    std::istringstream lines(CLI::Formatter::make_option_desc(option));
    std::string folded, line;
    while (std::getline(lines, line)) {
      for (; line.size() > width; folded += '\n') {
        const std::size_t gap = line.rfind(' ', width);
        if (gap == std::string::npos || gap == 0) break;
        folded += line.substr(0, gap);
        line.erase(0, gap + 1);
      }
      folded += line + '\n';
    }
    if (!folded.empty()) folded.pop_back();
    return folded;
  }
};

}  // namespace app

// Help that can be read in a terminal.
#include "app/console/wrapped_help.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace app {
namespace {

using ::testing::HasSubstr;

/// Longest line of the help for one option with this description.
std::size_t LongestLine(const std::string& description, std::string& help) {
  CLI::App pas("Does it", "pas");
  pas.formatter(std::make_shared<WrappedHelp>());
  std::string value;
  pas.add_subcommand("sub", "A part")->add_option("--way", value, description);
  help = pas.get_subcommand("sub")->help();
  std::istringstream lines(help);
  std::size_t longest = 0;
  for (std::string line; std::getline(lines, line);) longest = std::max(longest, line.size());
  return longest;
}

TEST(WrappedHelp, FoldsDescriptionsBetweenWordsAndLosesNone) {
  std::string description, help;
  for (int k = 0; k < 60; ++k) description += "word" + std::to_string(k) + " ";
  EXPECT_LE(LongestLine(description, help), 100u);
  for (int k = 0; k < 60; ++k) EXPECT_THAT(help, HasSubstr("word" + std::to_string(k)));
}

TEST(WrappedHelp, KeepsLinesThatAreThere) {
  std::string help;
  LongestLine("first line\nsecond line", help);
  EXPECT_THAT(help, HasSubstr("first line\n"));
  EXPECT_THAT(help, HasSubstr(" second line"));
}

TEST(WrappedHelp, LeavesAWordWholeThatIsLongerThanALine) {
  const std::string word(200, 'x');
  std::string help;
  LongestLine(word + " and more", help);
  EXPECT_THAT(help, HasSubstr(word));
}

}  // namespace
}  // namespace app

#include "app/suite/run_case.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <memory>

namespace app {
namespace {

std::string OutputOf(const std::string& line) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(line.c_str(), "r"), &pclose);
  std::string output;
  std::array<char, 256> part{};
  while (pipe && std::fgets(part.data(), part.size(), pipe.get()) != nullptr)
    output += part.data();
  return output;
}

TEST(CommandLines, AreReadByAShellAsTheWordsTheyAreMadeOf) {
  const std::vector<std::string> words{"plain/a-b_c.d", "it's", "a|b",   "a b", "$HOME", "`ls`",
                                       "back\\slash",   "<in>", "#none", "~",   "",      "*",
                                       "\"quoted\"",    "a;b",  "x=1"};
  std::vector<std::string> command{"printf", "%s\\n"};
  std::string expected;
  for (const std::string& word : words) {
    command.push_back(word);
    expected += word + "\n";
  }
  EXPECT_EQ(OutputOf(CommandLines({command})), expected);
  EXPECT_EQ(CommandLines({{"cd", "a/b"}, {"pas", "--rate=2,5"}}), "cd a/b && pas --rate=2,5");
}

}  // namespace
}  // namespace app

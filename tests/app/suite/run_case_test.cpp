#include "app/suite/run_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <memory>

#include "io/input_error.h"
#include "tests/support/program.h"

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

// The estimator needs most of it, and is not what runs last.
TEST(RunCase, TellsTheMemoryOfTheCommandThatNeededMost) {
  const program::TemporaryFolder folder;
  std::ofstream(folder / "fake") << "#!/bin/sh\nset -e\nif [ \"$2\" = slam ]; then\n"
                                    "  run=${*##*-o }; mkdir -p ${run%% *}\n"
                                    "  exec dd if=/dev/zero of=/dev/null bs=200M count=1\nfi\n"
                                    "echo '{}' > $3/metrics.json\n";
  program::fs::permissions(folder / "fake", program::fs::perms::owner_all);
  SuiteCase one;
  one.key = "desk-1/kinect1/own/full/default";
  const CaseResult result =
      RunCase(one, ProgramOf(folder / "fake"), {}, folder.path(), [] { return false; });
  ASSERT_EQ(result.status, CaseStatus::kFinished) << result.message;
  EXPECT_GE(result.times.at(kPeakMemory), 200.0);
}

TEST(RunCase, NamesAProgramThatIsNoPas) {
  const program::TemporaryFolder folder;
  SuiteCase one;
  one.key = "desk-1/kinect1/own/full/default";
  try {
    RunCase(one, ProgramOf("/bin/true"), {}, folder.path(), [] { return false; });
    FAIL() << "it wrote no figures";
  } catch (const io::InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("true: ended without an error, but wrote no "
                                                 "metrics.json of a case"));
  }
}

}  // namespace
}  // namespace app

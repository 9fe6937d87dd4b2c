// `pas plot` as a process: a folder of plots, whole or not at all.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/program/small_run_test.h"

namespace program {
namespace {

using ::testing::HasSubstr;

class PlotProgram : public SmallRunTest {
 protected:
  PlotProgram() {
    for (const char* place : {"other", "a/run", "b/run"}) {
      fs::create_directories(folder_ / place);
      fs::copy(folder_ / "run", folder_ / place, fs::copy_options::recursive);
    }
  }
  Outcome Plot(std::vector<std::string> more) const {
    std::vector<std::string> arguments = {"plot", folder_ / "run", folder_ / "other"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Do(arguments);
  }
};

TEST_F(PlotProgram, WritesEachPlotInThreeFormsWithACaption) {
  const Outcome outcome = Plot({"-o", folder_ / "plots", "--name", "ours", "--name", "theirs"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  const auto files = Contents(folder_ / "plots");
  for (const char* name : {"trajectories", "position_error", "module_times"}) {
    for (const char* form : {".svg", ".pdf", ".png"}) {
      EXPECT_EQ(files.count(std::string(name) + form), 1u) << name << form;
    }
    EXPECT_THAT(files.at("captions.txt"), HasSubstr(std::string(name) + ": "));
  }
}

TEST_F(PlotProgram, WantsANameForEachRunOrNone) {
  const Outcome outcome = Plot({"-o", folder_ / "plots", "--name", "ours"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("--name: is given 1 times for 2 runs"));
  EXPECT_EQ(
      Plot({"-o", folder_ / "plots", "--name", "a", "--name", "b", "--name", "c"}).exit_code,
      2);
  EXPECT_FALSE(fs::exists(folder_ / "plots"));
}

TEST_F(PlotProgram, GivesNoTwoRunsOneName) {
  const Outcome outcome = Plot({"-o", folder_ / "plots", "--name", "x", "--name", "x"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("--name: gives two runs one name"));
  EXPECT_FALSE(fs::exists(folder_ / "plots"));
}

TEST_F(PlotProgram, CallsRunsInFoldersOfOneNameByAsMuchOfTheirPathsAsTellsThemApart) {
  const std::vector<std::string> runs{"plot", folder_ / "a/run/", folder_ / "b/run",
                                      folder_ / "other"};
  const auto plots = [&](const std::string& place, std::vector<std::string> more) {
    more.insert(more.begin(), runs.begin(), runs.end());
    more.insert(more.end(), {"-o", folder_ / place});
    EXPECT_EQ(Do(more).exit_code, 0);
    return Contents(folder_ / place);
  };
  // Text is in outlines: equal bytes are equal names.
  const auto named = plots("named", {"--name", "a/run", "--name", "b/run", "--name", "other"});
  EXPECT_EQ(plots("unnamed", {}), named);
  EXPECT_NE(plots("same", {"--name", "run", "--name", "x", "--name", "other"}), named);
}

TEST_F(PlotProgram, RefusesARunThatIsGivenTwiceWithoutNames) {
  const Outcome outcome =
      Do({"plot", folder_ / "run", folder_ / "a/../run/", "-o", folder_ / "plots"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("run/: is given twice"));
  EXPECT_FALSE(fs::exists(folder_ / "plots"));
}

TEST_F(PlotProgram, ReplacesOnlyPlotsAndNeverARun) {
  ASSERT_EQ(Plot({"-o", folder_ / "plots"}).exit_code, 0);
  EXPECT_EQ(Plot({"-o", folder_ / "plots"}).exit_code, 2);
  EXPECT_EQ(Plot({"-o", folder_ / "plots", "--force"}).exit_code, 0);
  const auto before = Contents(folder_ / "run");
  EXPECT_EQ(Plot({"-o", folder_ / "run", "--force"}).exit_code, 2);
  EXPECT_EQ(Contents(folder_ / "run"), before);
}

TEST_F(PlotProgram, ReplacesNoFolderThatHoldsTheTruth) {
  ASSERT_EQ(Plot({"-o", folder_ / "plots"}).exit_code, 0);
  fs::copy(folder_ / "seq", folder_ / "plots/seq", fs::copy_options::recursive);
  const Outcome outcome =
      Plot({"-o", folder_ / "plots", "--force", "--truth", folder_ / "plots/seq"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(fs::exists(folder_ / "plots/seq/gt/scene.json"));
}

}  // namespace
}  // namespace program

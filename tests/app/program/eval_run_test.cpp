// `pas eval` of a run as a process: the tables beside the figures, label images alone, and a run of
// another program without run.json.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/program/small_run_test.h"

namespace program {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class EvalRunProgram : public SmallRunTest {
 protected:
  Outcome Eval(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "eval");
    return Do(arguments);
  }
};

TEST_F(EvalRunProgram, WritesEventsAndFramesBesideTheFigures) {
  const Outcome outcome = Eval({folder_ / "run", "--events", folder_ / "events.csv",
                                "--per-frame", folder_ / "frames.csv"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_THAT(ReadText(folder_ / "events.csv"), StartsWith("kind,frame,time_s"));
  EXPECT_THAT(ReadText(folder_ / "frames.csv"), StartsWith("frame,time_s,tracked"));
  EXPECT_TRUE(fs::exists(folder_ / "run/metrics.json"));
}

TEST_F(EvalRunProgram, ReplacesNoTableWithoutForceAndWritesNothingThen) {
  std::ofstream(folder_ / "events.csv") << "mine";
  const Outcome outcome = Eval({folder_ / "run", "--events", folder_ / "events.csv"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("events.csv: exists already"));
  EXPECT_EQ(ReadText(folder_ / "events.csv"), "mine");
  EXPECT_FALSE(fs::exists(folder_ / "run/metrics.json"));
}

TEST_F(EvalRunProgram, RefusesTwoOutputsInOneFileBeforeTheWork) {
  const Outcome outcome = Eval(
      {folder_ / "run", "-o", folder_ / "one", "--events", folder_ / "seq/../one", "--force"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("would hold two outputs"));
  EXPECT_FALSE(fs::exists(folder_ / "one"));
  EXPECT_EQ(Eval({folder_ / "run", "-o", "/dev/null", "--events", "/dev/null"}).exit_code, 0);
}

TEST_F(EvalRunProgram, ScoresATrajectoryOfAnotherProgramByTheSequenceThatIsNamed) {
  fs::create_directory(folder_ / "other");
  fs::copy(folder_ / "run/trajectory.txt", folder_ / "other/trajectory.txt");
  const Outcome unnamed = Eval({folder_ / "other"});
  EXPECT_EQ(unnamed.exit_code, 2);
  EXPECT_THAT(unnamed.errors, HasSubstr("name it with --truth"));
  const Outcome outcome = Eval({folder_ / "other", "--truth", folder_ / "seq"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_EQ(outcome.errors, "");
}

TEST_F(EvalRunProgram, ScoresLabelImagesAlone) {
  const std::vector<std::string> labels = {"--segmentation", folder_ / "run/segmentation"};
  EXPECT_EQ(Eval(labels).exit_code, 2);
  const Outcome outcome =
      Eval({labels[0], labels[1], "--truth", folder_ / "seq", "-o", folder_ / "labels.json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_THAT(ReadText(folder_ / "labels.json"), HasSubstr("\"pixel_recall\""));
}

TEST_F(EvalRunProgram, WantsOneThingToScore) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{},
        {folder_ / "run", "--segmentation", folder_ / "run/segmentation"}}) {
    const Outcome outcome = Eval(arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.errors, HasSubstr("expected one of a RUN folder"));
  }
}

}  // namespace
}  // namespace program

#include "app/suite/child_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>

#include "tests/support/program.h"

namespace app {
namespace {

using End = ChildOutcome::End;

class ChildProcess : public testing::Test {
 protected:
  ChildOutcome Shell(
      const std::string& script, const SuiteLimits& limits = {},
      const std::function<bool()>& stop = [] { return false; }) const {
    return RunChild({"/bin/sh", "-c", script}, folder_ / ".", folder_ / "errors", limits, stop);
  }
  program::TemporaryFolder folder_;
};

TEST_F(ChildProcess, TellsItsExitCodeAndItsErrors) {
  const ChildOutcome outcome = Shell("echo no; echo bad >&2; exit 3");
  EXPECT_EQ(outcome.end, End::kExited);
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(outcome.errors, "bad\n");
  EXPECT_GT(outcome.peak_mb, 0.0);
}

TEST_F(ChildProcess, RunsInItsFolder) {
  Shell("echo x > here");
  EXPECT_EQ(program::ReadText(folder_ / "here"), "x\n");
}

TEST_F(ChildProcess, TellsTheSignalThatEndedIt) {
  const ChildOutcome outcome = Shell("kill -SEGV $$");
  EXPECT_EQ(outcome.end, End::kSignalled);
  EXPECT_EQ(outcome.code, SIGSEGV);
}

TEST_F(ChildProcess, IsEndedWithAllThatItStartedWhenItsTimeIsOver) {
  const ChildOutcome outcome =
      Shell("(sleep 60; echo late > late) & sleep 60", {.seconds = 0.2});
  EXPECT_EQ(outcome.end, End::kTimedOut);
  EXPECT_LT(outcome.seconds, 30.0);
}

TEST_F(ChildProcess, IsEndedWhenAStopIsAskedFor) {
  const ChildOutcome outcome = Shell("sleep 60", {}, [] { return true; });
  EXPECT_EQ(outcome.end, End::kStopped);
  EXPECT_LT(outcome.seconds, 30.0);
}

TEST_F(ChildProcess, GetsNoMoreMemoryThanItMay) {
  const std::string hungry = "exec python3 -c 'a = bytearray(400 << 20)'";
  EXPECT_EQ(Shell(hungry, {.memory_mb = 1000}).code, 0);
  EXPECT_NE(Shell(hungry, {.memory_mb = 100}).code, 0);
}

TEST_F(ChildProcess, ThatCannotBeStartedSaysSoAsAShellDoes) {
  const ChildOutcome outcome = RunChild({"/no/such/program"}, folder_ / ".", folder_ / "errors",
                                        {}, [] { return false; });
  EXPECT_EQ(outcome.code, 127);
}

}  // namespace
}  // namespace app

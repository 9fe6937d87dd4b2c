// What the gate of `pas suite` says, and how often it measures before it does.
#include "tests/app/program/fake_suite.h"

namespace {

using namespace program;
using testing::HasSubstr;

class SuiteGate : public SuiteProgram {
 protected:
  void SetUp() override {
    SuiteProgram::SetUp();
    EXPECT_EQ(Gate("before", {"--accept", "first"}).exit_code, 0);
  }
  Outcome Gate(const std::string& results, std::vector<std::string> more = {}) const {
    more.insert(more.end(), {"--baseline", folder_ / "baseline.json"});
    return Suite(results, more);
  }
  std::size_t Cases(const std::string& results) const {
    return Query(folder_ / results, "SELECT key FROM cases").size();
  }
};

TEST_F(SuiteGate, AnUnchangedProgramIsGreenWithTheFirstSeeds) {
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(Gate("now" + std::to_string(i)).exit_code, 0);
    EXPECT_EQ(Cases("now" + std::to_string(i)), 10u);
  }
}

TEST_F(SuiteGate, AnErrorThatGrewByATenthIsRed) {
  WriteProgram("factor=1.10");
  EXPECT_EQ(Gate("now").exit_code, 1);
}

TEST_F(SuiteGate, AddsSeedsUntilItCanTell) {
  // Worse by a tenth in the mean, by anything between -20 % and +40 % in each case.
  WriteProgram("factor=$(awk \"BEGIN { print 1.1 + 0.3 * ((${seed:-0} % 2) * 2 - 1) }\")");
  Gate("now");
  EXPECT_EQ(Cases("now"), 36u);  // 5, 10 and, as no more are wanted, 18 seeds
}

TEST_F(SuiteGate, WhatIsAcceptedIsGreen) {
  WriteProgram("factor=1.10");
  EXPECT_EQ(Gate("now", {"--accept", "a better reason"}).exit_code, 0);
  EXPECT_THAT(ReadText(folder_ / "baseline.json"),
              HasSubstr("\"reason\": \"a better reason\""));
  EXPECT_EQ(Gate("now").exit_code, 0);
}

TEST_F(SuiteGate, StepsThatAreEachTooSmallAreToldTogether) {
  for (const std::string factor : {"1.03", "1.061"}) {
    WriteProgram("factor=" + factor);
    EXPECT_EQ(Gate("at" + factor).exit_code, 0);
    EXPECT_EQ(Gate("at" + factor, {"--accept", "another reason"}).exit_code, 0);
  }
  WriteProgram("factor=1.093");
  EXPECT_EQ(Gate("now").exit_code, 1);  // by 3 % more than the last, 6 % more than most
  // Whoever accepts it was told.
  EXPECT_EQ(Gate("now", {"--accept", "worth it"}).exit_code, 0);
  EXPECT_EQ(Gate("now").exit_code, 0);
}

TEST_F(SuiteGate, WhatIsNoBaselineIsNotReplacedByOne) {
  std::ofstream(folder_ / "baseline.json") << "{\"my\": \"own file\"}";
  const Outcome outcome = Gate("now", {"--accept", "why"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("baseline.json"));
  EXPECT_EQ(ReadText(folder_ / "baseline.json"), "{\"my\": \"own file\"}");
}

/// A module that takes `da_ms`, a word of the shell, beside one millisecond of ORB features.
std::string WithTimes(const std::string& da_ms) {
  return "if [ \"$2\" = slam ]; then\n"
         "  run=${*##*-o }; run=${run%% *}; mkdir -p $run\n"
         "  echo timestamp,orb,od,mdc,epi,pp,da,po,upm,mt > $run/timing.csv\n"
         "  echo 1.0,1,1,1,1,1," +
         da_ms + ",1,1,9 >> $run/timing.csv\nfi\n";
}

TEST_F(SuiteGate, ATimeIsWorseOnlyIfItIsSoAgain) {
  WriteSuite("seeds: {first: 1, count: 8}\n");
  WriteProgram(WithTimes("1.0"));
  EXPECT_EQ(Gate("before-times", {"--accept", "with times"}).exit_code, 0);
  // Slow in the first run of the sixteen cases, as where the machine has other work for a minute.
  WriteProgram(
      WithTimes("$([ $(cat log 2>/dev/null | wc -l) -lt 16 ] && echo 1.1 || echo 1.0)"));
  EXPECT_EQ(Gate("held-up").exit_code, 0);
  EXPECT_EQ(Runs("held-up"), 16u * 5u);
  WriteProgram(WithTimes("1.1"));
  EXPECT_EQ(Gate("slow").exit_code, 1);
}

TEST_F(SuiteGate, ASlowDownIsFoundThatTheFirstRunHalfHides) {
  WriteSuite("seeds: {first: 1, count: 8}\n");
  WriteProgram(WithTimes("1.0"));
  EXPECT_EQ(Gate("before-times", {"--accept", "with times"}).exit_code, 0);
  WriteProgram(
      WithTimes("$([ $(cat log 2>/dev/null | wc -l) -lt 16 ] && echo 1.02 || echo 1.05)"));
  EXPECT_EQ(Gate("half-hidden").exit_code, 1);
  EXPECT_EQ(Runs("half-hidden"), 16u * 5u);
}

TEST_F(SuiteGate, MoreFailuresAreRed) {
  WriteProgram("case \"$*\" in *wall-2*) exit 1;; esac");
  EXPECT_EQ(Gate("now").exit_code, 1);
}

TEST_F(SuiteGate, CasesThatFailAreAcceptedAsSuch) {
  WriteProgram("case \"$*\" in *wall-2*) exit 1;; esac");
  const Outcome outcome = Gate("now", {"--accept", "why"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.errors, HasSubstr("failed"));
  EXPECT_EQ(Gate("now").exit_code, 0);
}

TEST_F(SuiteGate, FailuresOfVariantsThatAreNotGatedAreRed) {
  WriteSuite(
      "seeds: {first: 1, count: 5}\nvariants: [full, points]\ngate: {variants: [full]}\n");
  EXPECT_EQ(Gate("before-two", {"--accept", "two variants"}).exit_code, 0);
  EXPECT_EQ(Gate("same").exit_code, 0);
  WriteProgram("case \"$*\" in *points*) exit 1;; esac");
  EXPECT_EQ(Gate("now").exit_code, 1);
}

TEST_F(SuiteGate, ABaselineOfOtherScenesOrSettingsIsRefused) {
  bool lost = false;
  const auto refused = [&](const char* results, const std::string& suite) {
    std::ofstream(folder_ / "suite.yaml")
        << "format: pas-suite/1\nname: fake\nframes: 10\nseeds: {first: 1, count: 5, "
           "max_count: 18}\n"
        << suite;
    const Outcome outcome = Gate(results);
    EXPECT_THAT(outcome.errors, HasSubstr(outcome.exit_code == 0 ? "" : "other scenes"));
    lost = outcome.errors.find("18 of 36 cases") != std::string::npos;
    return outcome.exit_code;
  };
  const std::string wall = "{family: wall}";
  EXPECT_EQ(refused("as before", "scenes: [{family: plates}, " + wall + "]\n"), 0);
  EXPECT_FALSE(lost);
  EXPECT_EQ(refused("fewer scenes", "scenes: [" + wall + "]\n"), 0);
  EXPECT_TRUE(lost);
  EXPECT_EQ(refused("frames", "scenes: [{family: plates, frames: 3}, " + wall + "]\n"), 2);
  EXPECT_EQ(refused("another", "scenes: [{family: board, name: plates}, " + wall + "]\n"), 2);
  std::ofstream(folder_ / "kinect1.yaml") << "base: d435\n";
  EXPECT_EQ(
      refused("sensor",
              "scenes: [{family: plates}, " + wall +
                  "]\nsensors: [{name: kinect1, file: kinect1.yaml, estimator: kinect1}]\n"),
      2);
}

TEST_F(SuiteGate, ABaselineThatCannotBeWrittenIsRefusedBeforeAnythingRuns) {
  const Outcome outcome =
      Suite("now", {"--accept", "why", "--baseline", folder_ / "nodir/baseline.json"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("there is no folder"));
  EXPECT_EQ(Cases("now"), 0u);
}

TEST_F(SuiteGate, ABaselineOfAnotherSuiteIsRefused) {
  WriteSuite("size_px: [160, 120]\n");
  const Outcome outcome = Gate("now");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("10 frames, own x own"));
}

}  // namespace

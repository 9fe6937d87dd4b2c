// `pas eval --trajectory` as a process: one table for many files, the JSON beside it, and refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/program.h"

namespace program {
namespace {

using ::testing::HasSubstr;

class EvalTrajectoryProgram : public ::testing::Test {
 protected:
  EvalTrajectoryProgram() {
    std::string truth, near, turned;
    for (int i = 0; i < 20; ++i) {
      const std::string t = std::to_string(i), x = std::to_string(i % 7);
      truth += t + " " + x + " " + t + " 0 0 0 0 1\n";
      near += t + ".005 " + x + " " + t + " 0 0 0 0 1\n";
      turned += t + " -" + t + " " + x + " 0 0 0 0.7071068 0.7071068\n";
    }
    Write("truth.txt", truth);
    Write("near.txt", near);
    Write("turned.txt", turned);
  }
  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  Outcome Eval(std::vector<std::string> files, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {Pas(), "eval", "--trajectory"};
    for (const std::string& file : files) arguments.push_back(folder_ / file);
    arguments.insert(arguments.end(), {"--truth", folder_ / "truth.txt"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Process(arguments, {}, folder_ / "errors").Wait();
  }
  TemporaryFolder folder_;
};

TEST_F(EvalTrajectoryProgram, ScoresManyFilesAndWritesThemAsJson) {
  const std::string output = folder_ / "out.json";
  ASSERT_EQ(Eval({"near.txt", "turned.txt"}, {"-o", output}).exit_code, 0);
  const auto json = nlohmann::json::parse(ReadText(output));
  EXPECT_EQ(json["format"], "pas-trajectories/1");
  ASSERT_EQ(json["trajectories"].size(), 2u);
  for (const auto& one : json["trajectories"]) {
    EXPECT_EQ(one["matched"], 20);
    EXPECT_LT(one["ape"]["trans_m"]["rmse"].get<double>(), 1e-6);
    EXPECT_EQ(one["rpe"]["pairs"], 19);
  }
}

TEST_F(EvalTrajectoryProgram, WritesNullWithAReasonWhereNoAlignmentIsDefined) {
  std::string line;
  for (int i = 0; i < 20; ++i)
    line += std::to_string(i) + " " + std::to_string(i) + " 0 0 0 0 0 1\n";
  Write("line.txt", line);
  const std::string output = folder_ / "out.json";
  ASSERT_EQ(Eval({"line.txt"}, {"-o", output}).exit_code, 0);
  const auto one = nlohmann::json::parse(ReadText(output))["trajectories"][0];
  EXPECT_TRUE(one["ape"]["trans_m"].is_null());
  EXPECT_THAT(one["reasons"]["ape/trans_m"].get<std::string>(), HasSubstr("line"));
  EXPECT_FALSE(one["rpe"]["trans_m"].is_null());
}

TEST_F(EvalTrajectoryProgram, RefusesWhatCannotBeScoredWithExitCodeTwo) {
  Write("empty.txt", "");
  Write("nan.txt", "0 0 0 0 0 0 0 1\n1 nan 0 0 0 0 0 1\n");
  Write("back.txt", "1 0 0 0 0 0 0 1\n0 0 0 0 0 0 0 1\n");
  Write("one.txt", "0 0 0 0 0 0 0 1\n");
  Write("late.txt", "100 0 0 0 0 0 0 1\n101 0 0 0 0 0 0 1\n");
  const std::map<std::string, std::string> refusals = {
      {"empty.txt", "holds no pose"},         {"nan.txt", "nan.txt:2: expected"},
      {"back.txt", "back.txt:2: time stamp"}, {"one.txt", "holds a single pose"},
      {"late.txt", "none of its 2 poses"},    {"absent.txt", "absent.txt"}};
  for (const auto& [file, why] : refusals) {
    const Outcome outcome = Eval({"near.txt", file}, {"-o", folder_ / "out.json"});
    EXPECT_EQ(outcome.exit_code, 2) << file;
    EXPECT_THAT(outcome.errors, HasSubstr(why));
    EXPECT_FALSE(fs::exists(folder_ / "out.json")) << file;
  }
  for (const char* delta : {"1x", "-1m", "0.5f", "m", "0s", "1e300f"}) {
    EXPECT_EQ(Eval({"near.txt"}, {"--delta", delta}).exit_code, 2) << delta;
  }
}

TEST_F(EvalTrajectoryProgram, NeverReplacesAFileOfPoses) {
  const Outcome outcome = Eval({"near.txt"}, {"--force", "-o", folder_ / "near.txt"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("near.txt"));
}

}  // namespace
}  // namespace program

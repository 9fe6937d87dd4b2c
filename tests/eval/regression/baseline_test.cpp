#include "eval/regression/baseline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace eval {
namespace {

namespace fs = std::filesystem;

class BaselineFile : public ::testing::Test {
 protected:
  void Write(const std::string& text) const { std::ofstream(file_) << text; }
  std::string Refusal() const {
    return test_support::RefusalOf([&] { ReadBaseline(file_); });
  }

  test_support::TemporaryFolder temporary_;
  const fs::path file_ = temporary_ / "baseline.json";
};

TEST_F(BaselineFile, ReadsWhatItWrote) {
  Baseline baseline{"quick", "60 frames", "pas 1", "a \"fast\" one", "first", {}};
  baseline.cases["desk-1/kinect1"] = {true, {{"/a", 0.1}, {"/b", std::nullopt}}, "5ce"};
  baseline.cases["desk-2/kinect1"] = {false, {}};
  baseline.history = {{"pas 0", "the \"first\" one", {{"kinect1", {{"/a", 0.02}}}}},
                      {"pas 0.1", "second", {}}};
  Write(BaselineText(baseline));
  const Baseline read = ReadBaseline(file_);
  EXPECT_EQ(BaselineText(read), BaselineText(baseline));
  EXPECT_EQ(read.cases.at("desk-1/kinect1").figures.at("/a"), 0.1);
  EXPECT_EQ(read.cases.at("desk-1/kinect1").inputs, "5ce");
  EXPECT_FALSE(read.cases.at("desk-2/kinect1").done);
  ASSERT_EQ(read.history.size(), 2u);
  EXPECT_EQ(read.history[0].harm.at("kinect1").at("/a"), 0.02);
}

TEST_F(BaselineFile, ThatIsNoneIsRefused) {
  Write("{}");
  EXPECT_THAT(Refusal(), ::testing::HasSubstr("format"));
  Write(R"({"format": "pas-baseline/1"})");
  EXPECT_THAT(Refusal(), ::testing::HasSubstr("pas-baseline/3"));
  Write(R"({"format": "pas-baseline/3", "suite": "q", "plan": "p", "program": "p",
            "processor": "c", "reason": "r", "cases": {"desk-1/x": {"done": 1}}})");
  EXPECT_THAT(Refusal(), ::testing::HasSubstr("desk-1/x"));
  const auto with_history = [](const std::string& history) {
    return R"({"format": "pas-baseline/3", "suite": "q", "plan": "p", "program": "p", "processor": "c",
               "reason": "r", "cases": {}, "history": )" +
           history + "}";
  };
  Write(with_history("7"));
  EXPECT_THAT(Refusal(), ::testing::HasSubstr("history"));
  Write(with_history(R"([{"program": "p", "reason": "r", "harm": {"arm": {"/a": "much"}}}])"));
  EXPECT_THAT(Refusal(), ::testing::HasSubstr("/a"));
}

TEST_F(BaselineFile, ThatIsMissingSaysHowToMakeOne) {
  EXPECT_THAT(Refusal(), ::testing::HasSubstr("--accept"));
}

TEST(BaselineKeys, AreAsSceneAndArm) {
  EXPECT_EQ(ArmOfKey("desk-1/kinect1/own/full/default"), "kinect1/own/full/default");
}

}  // namespace
}  // namespace eval

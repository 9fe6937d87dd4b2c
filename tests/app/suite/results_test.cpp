#include "app/suite/results.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "io/input_error.h"
#include "tests/support/program.h"
#include "tests/support/refusal.h"

namespace app {
namespace {

SuiteCase Case(const std::string& key, const std::string& inputs = "i") {
  return {key, "desk-1", 1, "full", {}, "s", inputs};
}

class SuiteResults : public testing::Test {
 protected:
  SuiteResults() {
    for (const char* name : {"a", "b", "c"}) program::fs::create_directory(folder_ / name);
  }
  program::TemporaryFolder folder_;
};

TEST_F(SuiteResults, GiveBackWhatWasPut) {
  {
    Results results(folder_ / "a");
    results.Put(Case("k"),
                {CaseStatus::kFinished, "", {{"/x", 0.1}, {"/y", std::nullopt}}, {{"t", 2.0}}},
                "pas 1", "run it");
    results.Put(Case("f"), {CaseStatus::kTimedOut, "too slow", {}, {}}, "pas 1", "run it");
  }
  std::map<std::string, ResultRow> rows = Results(folder_ / "a").Rows();
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows["k"].result.figures, (eval::Figures{{"/x", 0.1}, {"/y", std::nullopt}}));
  EXPECT_EQ(rows["k"].result.times, (eval::Figures{{"t", 2.0}}));
  EXPECT_EQ(rows["f"].result.status, CaseStatus::kTimedOut);
  EXPECT_EQ(rows["f"].result.message, "too slow");
  EXPECT_FALSE(program::fs::exists(folder_ / "a/results.sqlite-wal"));
}

TEST_F(SuiteResults, ANewResultReplacesAllOfTheOldOne) {
  Results results(folder_ / "a");
  results.Put(Case("k"), {CaseStatus::kFinished, "", {{"/x", 0.1}}, {}}, "p", "c");
  results.Put(Case("k", "j"), {CaseStatus::kFinished, "", {{"/y", 0.2}}, {}}, "p", "c");
  EXPECT_EQ(results.Rows()["k"].result.figures, (eval::Figures{{"/y", 0.2}}));
  EXPECT_EQ(results.Rows()["k"].inputs_sha256, "j");
}

TEST_F(SuiteResults, OfTwoFoldersAreMergedWithEachCaseOnce) {
  {
    Results a(folder_ / "a"), b(folder_ / "b");
    a.Put(Case("1"), {CaseStatus::kFinished, "", {{"/x", 1.0}}, {}}, "p", "c");
    b.Put(Case("2"), {CaseStatus::kFinished, "", {{"/x", 2.0}}, {}}, "p", "c");
    b.Put(Case("1"), {CaseStatus::kFinished, "", {{"/x", 1.0}}, {}}, "p", "c");
  }
  Results merged(folder_ / "c");
  merged.Merge(folder_ / "a");
  merged.Merge(folder_ / "b");
  std::map<std::string, ResultRow> rows = merged.Rows();
  EXPECT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows["2"].result.figures.at("/x"), 2.0);
}

TEST_F(SuiteResults, OfOtherInputsAreNotMerged) {
  {
    Results a(folder_ / "a"), b(folder_ / "b");
    a.Put(Case("1", "i"), {}, "p", "c");
    b.Put(Case("1", "j"), {}, "p", "c");
  }
  Results merged(folder_ / "c");
  merged.Merge(folder_ / "a");
  EXPECT_THAT(test_support::RefusalOf([&] { merged.Merge(folder_ / "b"); }),
              testing::HasSubstr("has the case 1 of other inputs"));
}

TEST_F(SuiteResults, ThatAreNoneAreRefused) {
  std::ofstream(folder_ / "a/results.sqlite") << std::string(5000, 'x');
  EXPECT_THROW(Results(folder_ / "a"), io::InputError);
  Results merged(folder_ / "c");
  EXPECT_THROW(merged.Merge(folder_ / "b"), io::InputError);
}

}  // namespace
}  // namespace app

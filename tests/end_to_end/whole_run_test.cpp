// The promises about whole runs: the estimator never sees the truth, and the same input gives
// the same bytes whatever the number of threads.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/families/families.h"
#include "tests/support/pipeline.h"

namespace {

namespace fs = std::filesystem;
using pipeline::Contents;
using pipeline::TemporaryFolder;

const pipeline::Recording kShort{.frames = 20};

/// run.json without what may differ: times, memory, and where the sequence lies.
nlohmann::json ComparableRunJson(const std::string& text) {
  nlohmann::json run = nlohmann::json::parse(text);
  for (const char* key : {"wall_time_s", "peak_memory_mb", "sequence", "sequence_absolute"})
    run.erase(key);
  return run;
}

/// Names of the files whose bytes differ between two run folders; timing.csv is not compared.
std::vector<std::string> Differences(const fs::path& run_1, const fs::path& run_2) {
  std::map<std::string, std::string> a = Contents(run_1), b = Contents(run_2);
  std::vector<std::string> different;
  for (const auto& [name, bytes] : a) {
    if (name == "timing.csv") continue;
    const auto other = b.find(name);
    const bool same =
        other != b.end() &&
        (name == "run.json" ? ComparableRunJson(bytes) == ComparableRunJson(other->second)
                            : bytes == other->second);
    if (!same) different.push_back(name);
  }
  if (a.size() != b.size()) different.push_back("(number of files)");
  return different;
}

TEST(WholeRun, ChangesNoByteWhenTheTruthIsDeleted) {
  const TemporaryFolder folder;
  pipeline::Record(sim::MakeScene("desk", 3), kShort, folder / "seq");
  pipeline::Run(folder / "seq", folder / "with");

  fs::copy(folder / "seq", folder / "blind", fs::copy_options::recursive);
  ASSERT_GT(fs::remove_all(folder / "blind/gt"), 0u);
  ASSERT_TRUE(fs::remove(folder / "blind/groundtruth.txt"));
  pipeline::Run(folder / "blind", folder / "without");

  EXPECT_THAT(Differences(folder / "with", folder / "without"), testing::IsEmpty());
}

TEST(WholeRun, GivesTheSameBytesWithOneThreadAndTwoAndASecondTime) {
  const TemporaryFolder folder;
  pipeline::Record(sim::MakeScene("desk", 4), kShort, folder / "seq");
  pipeline::Run(folder / "seq", folder / "one", slam::Variant::kFull, 1);
  pipeline::Run(folder / "seq", folder / "two", slam::Variant::kFull, 2);
  pipeline::Run(folder / "seq", folder / "again", slam::Variant::kFull, 2);

  EXPECT_THAT(Differences(folder / "one", folder / "two"), testing::IsEmpty());
  EXPECT_THAT(Differences(folder / "two", folder / "again"), testing::IsEmpty());
}

TEST(WholeRun, SequencesHaveTheSameBytesWithOneThreadAndTwo) {
  const TemporaryFolder folder;
  pipeline::Recording one = kShort, two = kShort;
  one.threads = 1;
  two.threads = 2;
  pipeline::Record(sim::MakeScene("desk", 5), one, folder / "one");
  pipeline::Record(sim::MakeScene("desk", 5), two, folder / "two");
  EXPECT_EQ(Contents(folder / "one"), Contents(folder / "two"));
}

TEST(WholeRun, TheSeedOfTheEstimatorIsNotTheSensors) {
  // Positive control of the comparison above: another sensor seed must be seen.
  const TemporaryFolder folder;
  pipeline::Recording other = kShort;
  other.seed = 2;
  pipeline::Record(sim::MakeScene("desk", 4), kShort, folder / "seq");
  pipeline::Record(sim::MakeScene("desk", 4), other, folder / "other");
  pipeline::Run(folder / "seq", folder / "run");
  pipeline::Run(folder / "other", folder / "run_other");
  EXPECT_THAT(Differences(folder / "run", folder / "run_other"),
              testing::Contains("trajectory.txt"));
}

TEST(WholeRun, EveryVariantRunsAndSaysWhatItIs) {
  const TemporaryFolder folder;
  pipeline::Record(sim::MakeScene("desk", 6), kShort, folder / "seq");
  for (const char* name :
       {"full", "no-association", "no-processing-no-association", "points"}) {
    const slam::RunOutcome outcome =
        pipeline::Run(folder / "seq", folder / name, slam::VariantOf(name));
    EXPECT_EQ(outcome.tracked, outcome.frames) << name;
    const auto contents = Contents(folder / name);
    EXPECT_EQ(nlohmann::json::parse(contents.at("run.json")).at("variant"), name);
    EXPECT_EQ(outcome.map_planes > 0, std::string(name) != "points") << name;
  }
}

}  // namespace

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "sim/families/families.h"
#include "tests/support/pipeline.h"

namespace {

/// A recording by a camera that reads its rows one after the other.
void RecordByRows(const std::filesystem::path& folder) {
  pipeline::Recording recording;
  recording.sensor.exposure.rolling_s = 0.03;
  pipeline::Record(sim::MakeScene("revisit", 32), recording, folder);
}

struct Looked {
  slam::RunOutcome outcome;
  double ate_m = 0.0;
  std::map<std::string, int> done;  ///< frames of each pass, as the last progress said
};

Looked RunWith(int first_look, const std::filesystem::path& sequence,
               const std::filesystem::path& run) {
  Looked looked;
  slam::RunOptions options;
  options.sequence = sequence;
  options.run = run;
  options.threads = 2;
  options.config.first_look.frames = first_look;
  options.progress = [&](const char* pass, int done, int total) {
    EXPECT_EQ(done, ++looked.done[pass]);
    EXPECT_LE(done, total);
  };
  looked.outcome = slam::RunSequence(options);
  looked.ate_m = pipeline::Score(run, sequence)["trajectory"]["ate_se3"]["rmse_m"];
  return looked;
}

TEST(FirstLook, BeginsTheMapWithWhatTheDeviceTurnsOutToBe) {
  const pipeline::TemporaryFolder folder;
  RecordByRows(folder / "seq");
  const Looked without = RunWith(0, folder / "seq", folder / "without");
  const Looked with = RunWith(300, folder / "seq", folder / "with");
  EXPECT_LT(with.ate_m, 0.7 * without.ate_m);
  // Frames that are looked at are no frames of the run.
  EXPECT_EQ(with.outcome.frames, without.outcome.frames);
  EXPECT_EQ(with.outcome.tracked, without.outcome.tracked);
  const int frames = with.outcome.frames;
  EXPECT_EQ(without.done, (std::map<std::string, int>{{"slam", frames}}));
  EXPECT_EQ(with.done, (std::map<std::string, int>{{"first look", frames}, {"slam", frames}}));
}

TEST(FirstLook, CountsNoFrameTwiceForWhatItDoesNotKnowInTheEnd) {
  // So short looks are not sure of the shutter: the run learns it from its own frames alone.
  const pipeline::TemporaryFolder folder;
  RecordByRows(folder / "seq");
  std::vector<double> learnt_s;
  for (const int look : {4, 12}) {
    const auto run = folder / std::to_string(look);
    RunWith(look, folder / "seq", run);
    const auto json = nlohmann::json::parse(std::ifstream(run / "run.json"));
    learnt_s.push_back(json.at("rolling_shutter").at("learnt").at("read_s"));
  }
  EXPECT_EQ(learnt_s[0], learnt_s[1]);
}

TEST(FirstLook, EndsWhereTheRunIsStopped) {
  const pipeline::TemporaryFolder folder;
  RecordByRows(folder / "seq");
  slam::RunOptions options;
  options.sequence = folder / "seq";
  options.run = folder / "run";
  int asked = 0;
  options.stop = [&] { return ++asked > 5; };
  const slam::RunOutcome outcome = slam::RunSequence(options);
  EXPECT_TRUE(outcome.stopped);
  EXPECT_EQ(outcome.frames, 2);
}

}  // namespace

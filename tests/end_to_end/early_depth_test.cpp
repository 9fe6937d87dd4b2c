#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <string>

#include "sim/families/families.h"
#include "tests/support/pipeline.h"

namespace {

namespace fs = std::filesystem;

/// A room by a camera whose depth is taken 15 ms after colour.
void RecordLate(const fs::path& folder) {
  pipeline::Recording recording;
  recording.sensor.timing.depth_offset_s = 0.015;
  pipeline::Record(sim::MakeScene("room", 33), recording, folder);
}

/// Each colour image with the depth of the one before: 18 ms too early now.
void PairWithTheDepthBefore(const fs::path& from, const fs::path& to) {
  fs::create_directories(to);
  for (const char* name : {"rgb", "depth", "camera.yaml", "groundtruth.txt"}) {
    fs::create_symlink(from / name, to / name);
  }
  std::ifstream pairs(from / "associations.txt");
  std::ofstream early(to / "associations.txt");
  std::string colour_s, colour, depth_s, depth, depth_before;
  while (pairs >> colour_s >> colour >> depth_s >> depth) {
    if (!depth_before.empty())
      early << colour_s << ' ' << colour << ' ' << depth_before << '\n';
    depth_before = depth_s + ' ' + depth;
  }
}

double AteOf(const fs::path& sequence, const fs::path& run, slam::Variant variant) {
  slam::RunOptions options;
  options.sequence = sequence;
  options.run = run;
  options.threads = 2;
  options.variant = variant;
  slam::RunSequence(options);
  return pipeline::Score(run, sequence)["trajectory"]["ate_se3"]["rmse_m"];
}

TEST(DepthOfAnotherTime, LetsPlanesMakeThePoseBetter) {
  // Half a frame late or early, as in TUM's recordings.
  const pipeline::TemporaryFolder folder;
  RecordLate(folder / "late");
  PairWithTheDepthBefore(folder / "late", folder / "early");
  // Where the speed was taken as known: 0.6 and 3.2.
  const std::map<std::string, double> most{{"late", 0.3}, {"early", 0.6}};
  for (const auto& [when, share] : most) {
    const double full_m = AteOf(folder / when, folder / (when + "-full"), slam::Variant::kFull);
    const double points_m =
        AteOf(folder / when, folder / (when + "-points"), slam::Variant::kPoints);
    EXPECT_LT(full_m, share * points_m) << when;
  }
}

}  // namespace

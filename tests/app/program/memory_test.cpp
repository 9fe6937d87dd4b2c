// A long recording needs no more memory than a short one.
#include <gtest/gtest.h>

#include "tests/support/program.h"

namespace {

using namespace program;

class MemoryOfSim : public testing::Test {
 protected:
  double PeakOf(int frames, const std::string& width, const std::string& height) const {
    const std::string count = std::to_string(frames);
    const Outcome outcome =
        Process({Pas(), "-q", "sim", fs::path(PAS_SOURCE_DIR) / "scenes/ambiguous/desk.yaml",
                 "-o", folder_ / ("seq_" + count), "--frames", count, "--width", width,
                 "--height", height, "--threads", "2"},
                // Sanitizers keep what is freed for a while.
                {{"ASAN_OPTIONS", "quarantine_size_mb=1:thread_local_quarantine_size_kb=64"}},
                folder_ / "errors")
            .Wait();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    return outcome.peak_mb;
  }

  TemporaryFolder folder_;
};

TEST_F(MemoryOfSim, DoesNotGrowWithTheNumberOfFrames) {
  // A leak of one depth image a frame, 38 kB, would be 6.9 MB; peaks scatter by 3 MB on a busy machine.
  constexpr double kMostGrowth_mb = 5;
  const double few = PeakOf(20, "160", "120"), many = PeakOf(200, "160", "120");
  EXPECT_GT(few, 1);
  EXPECT_LT(many - few, kMostGrowth_mb) << few << " MB, " << many << " MB";
}

#ifndef __SANITIZE_ADDRESS__  // which takes more
TEST_F(MemoryOfSim, StaysBelowThreeHundredMegabytesAtFullSize) {
  EXPECT_LT(PeakOf(12, "640", "480"), 300);
}
#endif

}  // namespace

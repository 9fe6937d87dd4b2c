#include "slam/structure/structure.h"

#include <gtest/gtest.h>

#include "app/bench/bench_sequences.h"
#include "sim/families/families.h"
#include "tests/support/pipeline.h"

namespace {

app::BenchErrors ErrorsOf(const std::filesystem::path& sequence, slam::StructureMode mode) {
  slam::Config config;
  config.structure.mode = mode;
  const app::ScoredRun run = app::RunAndScore({"structure", sequence}, config);
  EXPECT_EQ(run.evaluation.trajectory.tracked, run.frames.size());
  return app::ErrorsOf(run);
}

/// Panels in zigzag: whatever is assumed of them, hardly any two stand at right angles.
TEST(Structure, ThatTheWorldDoesNotHaveHarmsNoPathNorMap) {
  const pipeline::TemporaryFolder folder;
  pipeline::Recording recording;
  recording.frames = 30;
  recording.width = 640, recording.height = 480;
  pipeline::Record(sim::MakeScene("wall", 3, {{"structure", 1}}), recording, folder / "seq");
  const app::BenchErrors none = ErrorsOf(folder / "seq", slam::StructureMode::kFree);
  ASSERT_TRUE(none.ate_m && none.plane_normal_deg);
  for (std::size_t mode = 1; mode < slam::StructureModeNames().size(); ++mode) {
    const app::BenchErrors with =
        ErrorsOf(folder / "seq", static_cast<slam::StructureMode>(mode));
    EXPECT_LT(with.ate_m.value_or(1.0), 1.1 * *none.ate_m) << slam::StructureModeNames()[mode];
    EXPECT_LT(with.plane_normal_deg.value_or(90.0), 1.1 * *none.plane_normal_deg)
        << slam::StructureModeNames()[mode];
  }
}

}  // namespace

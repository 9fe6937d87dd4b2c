#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "io/read_file.h"
#include "slam/run/run_writer.h"
#include "tests/support/temporary_folder.h"

namespace slam {
namespace {

using nlohmann::json;

/// run.json of a run without frames that ended so.
json SaidOf(const RunEnd& end) {
  const test_support::TemporaryFolder folder;
  RunInfo info;
  info.sequence = folder / "seq";
  RunWriter(folder / "run", info, {}).Finish(Map{}, end, {});
  return json::parse(io::ReadFile(folder / "run" / "run.json"));
}

TEST(RunJsonOfTheDevice, SaysWhereNothingWasLearnt) {
  const json said = SaidOf({});
  EXPECT_EQ(said["depth_warp"], json({{"applied", false}}));
  EXPECT_EQ(said["depth_registration"], json({{"applied", false}}));
  EXPECT_EQ(said["rolling_shutter"], json({{"applied_s", 0.0}}));
}

TEST(RunJsonOfTheDevice, SaysHowFarDepthLiesBesideItsColour) {
  RunEnd end;
  end.registration = RegistrationEstimate{.shift_px = {1.5, -0.25},
                                          .sigma_px = {0.2, 0.1},
                                          .clear = true,
                                          .grown_px = 0.75,
                                          .epochs = 7,
                                          .applied_px = {1.4, 0.0}};
  EXPECT_EQ(SaidOf(end)["depth_registration"],
            json::parse(R"({"applied": true, "applied_px": [1.4, 0.0],
                "learnt": {"epochs": 7, "shift_px": [1.5, -0.25], "sigma_px": [0.2, 0.1],
                           "grown_px": 0.75, "clear": true}})"));
  end.registration->applied_px = {0.0, 0.0};
  EXPECT_EQ(SaidOf(end)["depth_registration"]["applied"], false);
}

TEST(RunJsonOfTheDevice, SaysHowLongTheColourCameraReads) {
  RunEnd end;
  end.rolling_shutter =
      RollingEstimate{.read_s = 0.027, .sigma_s = 0.002, .applied_s = 0.026, .epochs = 9};
  EXPECT_EQ(SaidOf(end)["rolling_shutter"], json::parse(R"({"applied_s": 0.026,
      "learnt": {"epochs": 9, "read_s": 0.027, "sigma_s": 0.002}})"));
}

TEST(RunJsonOfTheDevice, SaysWhetherDepthWasStraightenedAndWhatIsDoubtful) {
  for (const bool worth_it : {true, false}) {
    RunEnd end;
    end.straightening.evidence = WarpEvidence{.law = BendLaw::kDisparity,
                                              .epochs = 9,
                                              .gain = 0.25,
                                              .student_t = 4.5,
                                              .min_student_t = 3.5,
                                              .largest_surface = 0.625,
                                              .worth_it = worth_it};
    if (worth_it) end.straightening.from_frame = 4, end.straightening.rms = 0.0125;
    json said = SaidOf(end)["depth_warp"];
    EXPECT_EQ(said["learnt"], json::parse(R"({"law": "disparity", "epochs": 9, "gain": 0.25,
        "student_t": 4.5, "min_student_t": 3.5, "largest_surface": 0.625})"));
    said.erase("learnt");
    const std::string doubt = end.straightening.evidence->Doubt();
    EXPECT_EQ(said, worth_it ? json({{"applied", true}, {"from_frame", 4}, {"rms", 0.0125}})
                             : json({{"applied", false}, {"doubt", doubt}}));
  }
}

}  // namespace
}  // namespace slam

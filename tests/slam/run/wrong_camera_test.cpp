#include <gmock/gmock.h>

#include <limits>

#include "io/input_error.h"
#include "tests/support/fault_stream.h"
#include "tests/support/stream_run.h"

// Fault F8 of the matrix: a camera that is not the one that the user says.
namespace slam {
namespace {

RunOptions TrackPointsAlone() {
  RunOptions options;
  options.variant = Variant::kPoints;
  return options;
}

TEST(FaultStreamF8, ACameraThatCannotBeIsRefused) {
  const double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const double fx : {0.0, -300.0, kNan}) {
    Camera camera = CameraOfSize(320, 240);
    camera.fx = fx;
    EXPECT_THROW(RunStream(CleanStream(3), TrackPointsAlone(), camera), io::InputError);
  }
}

/// What the user may say of a camera that is none of these.
struct Said {
  double fx_factor, fy_factor, cx_shift_px, cy_shift_px;
  std::vector<std::string> wrong;  ///< what has to be named
};

Camera SaidCamera(const Said& said) {
  Camera camera = CameraOfSize(640, 480);
  camera.fx *= said.fx_factor;
  camera.fy *= said.fy_factor;
  camera.cx += said.cx_shift_px;
  camera.cy += said.cy_shift_px;
  return camera;
}

/// A camera that is panned by 1.5 degrees a frame to the right and down.
std::vector<RecordedFrame> PannedStream(int frames) {
  return SeenStream(
      frames, TexturedCorner(),
      [](int i) {
        const Eigen::Matrix3d R_wc = ExpSo3({-0.016 * i, 0.03 * i, 0.01 * i});
        return Inverse(Pose{R_wc, {0.008 * i, 0.0, 0.004 * i}});
      },
      CameraOfSize(640, 480));
}

TEST(FaultStreamF8, AWrongCameraIsNoticedWithinTenFramesOfTurning) {
  const auto stream = PannedStream(10);
  EXPECT_TRUE(
      RunStream(stream, TrackPointsAlone(), CameraOfSize(640, 480)).outcome.warnings.empty());
  for (const Said& said : {Said{1.05, 1.0, 0, 0, {"fx"}}, Said{1.3, 1.0, 0, 0, {"fx"}},
                           Said{0.9, 0.9, 0, 0, {"fx", "fy"}}, Said{1, 1, 20, 0, {"cx"}}}) {
    SCOPED_TRACE(testing::Message() << said.fx_factor << " " << said.cx_shift_px);
    RunOptions options = TrackPointsAlone();
    std::vector<std::string> told;
    options.warn = [&](const std::string& warning) { told.push_back(warning); };
    const Ran ran = RunStream(stream, options, SaidCamera(said));
    ASSERT_EQ(ran.outcome.warnings.size(), 1u);
    EXPECT_EQ(told.size(), 1u);
    for (const std::string& name : said.wrong) {
      EXPECT_THAT(ran.outcome.warnings[0], testing::HasSubstr(name + " is about"));
    }
    EXPECT_THAT(ran.outcome.warnings[0], testing::HasSubstr("camera.yaml"));
  }
}

}  // namespace
}  // namespace slam

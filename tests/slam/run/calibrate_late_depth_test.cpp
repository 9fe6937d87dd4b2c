#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "slam/run/calibrate_sequence.h"
#include "tests/support/fault_stream.h"
#include "tests/support/temporary_folder.h"

namespace slam {
namespace {

/// To and fro before the front wall of the corner, which alone is in view, up to 2.4 m/s; at first
/// half as fast.
Pose RushingAtAWall(double s) {
  const double there_m = 0.4 * std::sin(M_PI / 3 + 6 * s);
  return Inverse(Pose{Eigen::Matrix3d::Identity(), {-0.9, -0.8, there_m}});
}

/// Depth is measured so much later than the colour that it is paired with.
/// @param repeated  the frame whose images come again in the place of the next; 0: none
void RecordRushWithLateDepth(const Camera& camera, int frames, double late_s, int repeated,
                             const std::filesystem::path& folder) {
  constexpr double kWall_m = 2.0;
  std::filesystem::create_directories(folder / "rgb");
  std::filesystem::create_directories(folder / "depth");
  std::ofstream(folder / "camera.yaml")
      << "width: " << camera.width << "\nheight: " << camera.height << "\nfx: " << camera.fx
      << "\nfy: " << camera.fy << "\ncx: " << camera.cx << "\ncy: " << camera.cy
      << "\ndepth_factor: " << camera.depth_factor << "\nfps: 30\n";
  std::ofstream list(folder / "associations.txt");
  const auto stream = SeenStream(
      frames, TexturedCorner(), [](int i) { return RushingAtAWall(i / 30.0); }, camera);
  for (int i = 0; i < frames; ++i) {
    const int seen = repeated > 0 && i == repeated + 1 ? repeated : i;
    const double wall_m = kWall_m + RushingAtAWall(seen / 30.0 + late_s).t.z();
    const cv::Mat1w raw(camera.height, camera.width,
                        static_cast<std::uint16_t>(std::lround(camera.depth_factor * wall_m)));
    const std::string name = std::to_string(i) + ".png";
    const double s = 100 + i / 30.0;
    cv::imwrite((folder / "rgb" / name).string(), stream[static_cast<std::size_t>(seen)].bgr);
    cv::imwrite((folder / "depth" / name).string(), raw);
    list << std::to_string(s) << " rgb/" << name << ' ' << std::to_string(s + late_s)
         << " depth/" << name << '\n';
  }
}

CalibrateOptions RushWithLateDepth(const std::filesystem::path& folder, int repeated) {
  constexpr int kThereAndBack = 15;
  RecordRushWithLateDepth(CameraOfSize(), kThereAndBack, 0.032, repeated, folder);
  CalibrateOptions options;
  options.sequence = folder;
  return options;
}

TEST(CalibrateSequence, TakesOneWallForOneThoughItsDepthIsLaterThanItsColour) {
  const test_support::TemporaryFolder folder;
  const Calibration calibration = CalibrateSequence(RushWithLateDepth(folder.path(), 0));
  EXPECT_EQ(calibration.evidence.largest_surface, 1.0);
}

TEST(CalibrateSequence, LeavesOutImagesThatADriverRepeats) {
  const test_support::TemporaryFolder once, again;
  constexpr int kAtRest = 3;  // where the rush turns back
  const Calibration whole = CalibrateSequence(RushWithLateDepth(once.path(), 0));
  const Calibration repeated = CalibrateSequence(RushWithLateDepth(again.path(), kAtRest));
  EXPECT_EQ(repeated.tracked, whole.tracked - 1);
}

}  // namespace
}  // namespace slam

#include "slam/run/calibrate_sequence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "tests/support/temporary_folder.h"
#include "tests/support/textured_world.h"

namespace slam {
namespace {

/// p of a device that bends thrice as much as a Kinect, 0.95 % rms, over a view of 160 x 120.
double BentBy(double u, double v) {
  const double turn = 2 * std::numbers::pi;
  return 0.0095 * (std::sin(turn * u / 45 + 1) + std::cos(turn * (v / 60 - u / 160)));
}

/// What it records while a hand swings before the corner of a room, five frames a second.
void RecordBent(const Camera& camera, int frames, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / "rgb");
  std::filesystem::create_directories(folder / "depth");
  std::ofstream(folder / "camera.yaml")
      << "width: " << camera.width << "\nheight: " << camera.height << "\nfx: " << camera.fx
      << "\nfy: " << camera.fy << "\ncx: " << camera.cx << "\ncy: " << camera.cy
      << "\ndepth_factor: " << camera.depth_factor << "\nfps: 5\n";
  std::ofstream list(folder / "associations.txt");
  const TexturedCorner corner;
  for (int i = 0; i < frames; ++i) {
    const Frame seen = corner.See(camera, SwingingPose(6 * i), i);
    cv::Mat1w raw(seen.depth_m.size());
    for (int v = 0; v < raw.rows; ++v) {
      for (int u = 0; u < raw.cols; ++u) {
        const double bent_m = static_cast<double>(seen.depth_m(v, u)) * (1 + BentBy(u, v));
        raw(v, u) = static_cast<std::uint16_t>(std::lround(camera.depth_factor * bent_m));
      }
    }
    cv::Mat3b bgr;
    cv::cvtColor(seen.gray, bgr, cv::COLOR_GRAY2BGR);
    const std::string name = std::to_string(i) + ".png", s = std::to_string(1 + 0.2 * i);
    cv::imwrite((folder / "rgb" / name).string(), bgr);
    cv::imwrite((folder / "depth" / name).string(), raw);
    list << s << " rgb/" << name << ' ' << s << " depth/" << name << '\n';
  }
}

// Segments that allow for no bend break where the device bends, and the planes of the pieces take
// up what is to be learnt.
TEST(CalibrateSequence, LearnsFromWallsThatItsFirstPassMadeWhole) {
  constexpr int kTwoEpochs = 10;
  const Camera camera = SmallCamera();
  const test_support::TemporaryFolder folder;
  RecordBent(camera, kTwoEpochs, folder.path());
  CalibrateOptions options;
  options.sequence = folder.path();
  options.config.plane_extraction.segmentation = Segmentation::kAhc;
  const Calibration calibration = CalibrateSequence(options);
  EXPECT_EQ(calibration.tracked, kTwoEpochs);
  const DepthWarp& warp = calibration.warp;
  Eigen::VectorXd truth(warp.cells.count());
  for (int cell = 0; cell < warp.cells.count(); ++cell) {
    truth[cell] = BentBy(warp.cells.CentreU(cell % warp.cells.cols),
                         warp.cells.CentreV(cell / warp.cells.cols));
  }
  truth = WithoutLinearPart(warp.cells, truth);
  EXPECT_LT((warp.pattern - truth).norm(), truth.norm() / 3);
}

}  // namespace
}  // namespace slam

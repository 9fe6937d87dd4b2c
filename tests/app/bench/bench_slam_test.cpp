#include "app/bench/bench_slam.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/fault_stream.h"
#include "tests/support/image_files.h"
#include "tests/support/temporary_folder.h"

namespace app {
namespace {

namespace fs = std::filesystem;

constexpr int kThere = 10;            // frames of one way
constexpr double kRate_Hz = 16;       // all times are exact as binary and as printed numbers
constexpr double kLate_s = 1.0 / 64;  // of depth after colour, a quarter of a frame

slam::Pose Hand(double frame) {
  return slam::Inverse(
      {slam::ExpSo3({0.01 * frame, 0.02 * frame, 0}), {0.03 * frame, 0.01 * frame, 0}});
}

/// Writes a camera's way of ten frames, and where asked for also its way back: what it saw, in the
/// opposite order, so that depth that came after its colour is before it.
void WriteWay(const fs::path& folder, bool and_back) {
  slam::Camera camera = slam::HalfCamera();
  camera.fps = kRate_Hz;
  fs::create_directories(folder / "rgb");
  fs::create_directories(folder / "depth");
  std::ofstream(folder / "camera.yaml") << fmt::format(
      "model: pinhole\nwidth: {}\nheight: {}\nfx: {}\nfy: {}\ncx: {}\ncy: {}\nfps: {}\n"
      "depth_factor: 5000\n",
      camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy, camera.fps);
  const slam::TexturedCorner corner;
  const auto colour = slam::SeenStream(kThere, corner, Hand, camera);
  const auto depth = slam::SeenStream(
      kThere, corner, [](int i) { return Hand(i + kLate_s * kRate_Hz); }, camera);
  std::ofstream rgb_list(folder / "rgb.txt"), depth_list(folder / "depth.txt"),
      pairs(folder / "associations.txt");
  for (int i = 0; i < (and_back ? 2 : 1) * kThere; ++i) {
    const bool back = i >= kThere;
    const auto at = static_cast<std::size_t>(back ? 2 * kThere - 1 - i : i);
    cv::Mat1w units;
    depth[at].depth_m.convertTo(units, CV_16U, camera.depth_factor);
    const std::string name = fmt::format("{:02}.png", i);
    test_support::WriteImageFile(folder / "rgb" / name, colour[at].bgr);
    test_support::WriteImageFile(folder / "depth" / name, units);
    const double seen_s = i / kRate_Hz, measured_s = seen_s + (back ? -kLate_s : kLate_s);
    const std::string of_rgb = fmt::format("{:.6f} rgb/{}", seen_s, name),
                      of_depth = fmt::format("{:.6f} depth/{}", measured_s, name);
    rgb_list << of_rgb << "\n";
    depth_list << of_depth << "\n";
    pairs << of_rgb << " " << of_depth << "\n";
  }
}

TEST(BenchSlam, PlaysALapBackwardsAsTheFramesWouldHaveBeenRecordedThen) {
  const test_support::TemporaryFolder folder;
  WriteWay(folder / "there", false);
  WriteWay(folder / "there and back", true);
  BenchOptions laps;
  laps.laps = 2;
  const BenchRow played = MeasureSlam(folder / "there", laps),
                 recorded = MeasureSlam(folder / "there and back", {});
  EXPECT_EQ(recorded.frames, 2 * kThere);
  EXPECT_EQ(recorded.tracked, 2 * kThere);
  EXPECT_EQ(played.frames, recorded.frames);
  EXPECT_EQ(played.tracked, recorded.tracked);
  EXPECT_EQ(played.keyframes, recorded.keyframes);
  EXPECT_EQ(played.points, recorded.points);
}

}  // namespace
}  // namespace app

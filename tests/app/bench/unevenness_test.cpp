#include "app/bench/unevenness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace app {
namespace {

constexpr int kCols = 20, kRows = 15, kBlock_px = 16;
constexpr double kStepsTimesMetres = 351.3;

/// A slanted plane whose blocks are off it by this many steps each.
std::vector<BlockResidual> ResidualsOf(const std::vector<double>& off_steps) {
  const cv::Size size(kCols * kBlock_px, kRows * kBlock_px);
  cv::Mat1f depth_m(size);
  cv::Mat2d rays(size);
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const double x = (u - 159.5) / 290, y = (v - 119.5) / 290;
      rays(v, u) = {x, y};
      const auto block = static_cast<std::size_t>(v / kBlock_px * kCols + u / kBlock_px);
      const double q = 0.8 + 0.2 * x - 0.3 * y + off_steps[block] / kStepsTimesMetres;
      depth_m(v, u) = static_cast<float>(1 / q);
    }
  }
  return BlockResiduals(depth_m, cv::Mat1w(size, std::uint16_t{1}), rays);
}

TEST(BlockResiduals, KeepWhatVariesAsTheOthersDoAndLeaveOutOtherThings) {
  std::mt19937_64 random{11};
  std::normal_distribution<double> usual{0.0, 0.5};
  std::vector<double> off_steps(static_cast<std::size_t>(kCols) * kRows);
  for (double& steps : off_steps) steps = usual(random);
  const std::vector<std::size_t> things{37, 120, 121, 250};
  for (const std::size_t block : things) off_steps[block] = 9.0;
  const std::vector<BlockResidual> residuals = ResidualsOf(off_steps);
  ASSERT_EQ(residuals.size(), off_steps.size());
  int off_plane = 0;
  double squares = 0;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    off_plane += residuals[i].on_plane ? 0 : 1;
    if (off_steps[i] == 9.0) continue;
    squares += residuals[i].steps * residuals[i].steps;
  }
  for (const std::size_t block : things) {
    EXPECT_FALSE(residuals[block].on_plane);
    EXPECT_NEAR(residuals[block].steps, 9.0, 0.2);
  }
  EXPECT_LE(off_plane, 8);  // 1 of 370 beyond three sigmas, and the four
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(residuals.size())), 0.5, 0.05);
}

}  // namespace
}  // namespace app

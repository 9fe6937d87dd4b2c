#include "app/calibrate/warp_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace app {
namespace {

constexpr int kPanel_px = 640;  // width of a panel
constexpr int kTitle_px = 34, kScale_px = 40;

/// Blue, white, red for -1, 0, 1.
cv::Vec3b ColourOf(double value) {
  const auto fade = cv::saturate_cast<uchar>(255 * (1 - std::min(1.0, std::abs(value))));
  return value < 0 ? cv::Vec3b(255, fade, fade) : cv::Vec3b(fade, fade, 255);
}

void Write(cv::Mat3b& page, const std::string& text, cv::Point at) {
  cv::putText(page, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.5, {0, 0, 0}, 1, cv::LINE_AA);
}

/// One panel: values of cells in units of `full`.
cv::Mat3b DrawCells(const slam::WarpCells& cells, const Eigen::VectorXd& values, double full,
                    const std::string& title) {
  const int height = kPanel_px * cells.height / cells.width;
  cv::Mat3b page(kTitle_px + height + kScale_px, kPanel_px, cv::Vec3b(255, 255, 255));
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < kPanel_px; ++u) {
      const int cell = v * cells.rows / height * cells.cols + u * cells.cols / kPanel_px;
      page(kTitle_px + v, u) = ColourOf(values[cell] / full);
    }
  }
  Write(page, title, {8, kTitle_px - 12});
  const int left = kPanel_px / 4, right = 3 * kPanel_px / 4, top = kTitle_px + height + 10;
  for (int u = left; u < right; ++u) {
    const double value = 2.0 * (u - left) / (right - left) - 1;
    page(cv::Rect(u, top, 1, 14)).setTo(ColourOf(value));
  }
  Write(page, fmt::format("{:.1f} mm/m", -1e3 * full), {left - 110, top + 12});
  Write(page, fmt::format("{:.1f} mm/m", 1e3 * full), {right + 10, top + 12});
  return page;
}

}  // namespace

cv::Mat3b DrawWarp(const slam::DepthWarp& warp) {
  constexpr double kUnit = 1e-3;  // the scale ends at a whole millimetre a metre
  const double full =
      kUnit * std::max(1.0, std::ceil(warp.pattern.cwiseAbs().maxCoeff() / kUnit));
  cv::Mat3b page;
  cv::hconcat(DrawCells(warp.cells, warp.pattern, full,
                        fmt::format("measured too far (red) or too near: {:.2f} mm/m rms",
                                    1e3 * warp.Rms())),
              DrawCells(warp.cells, warp.sigma, full, "standard deviation of it"), page);
  return page;
}

}  // namespace app

#include "slam/segment/elected_region.h"

#include <algorithm>
#include <cmath>

namespace slam {
namespace {

constexpr std::uint8_t kOutside = 2;  // of the region and its holes

}  // namespace

int ElectedRegion::Reach(double window_px) {
  return std::max(1, static_cast<int>(std::ceil(0.5 * (std::sqrt(window_px) - 1.0))));
}

void ElectedRegion::Elect(const DepthGrid& grid, const cv::Mat1b& labels,
                          const HeightElection& election, const cv::Rect& votes,
                          const cv::Rect& eligible) {
  const int reach = Reach(election.window_px);
  bounds_ = votes;
  const int width = bounds_.width, stride = width + 1;
  integral_sum_.assign(static_cast<std::size_t>(stride * (bounds_.height + 1)), 0.0);
  integral_count_.assign(integral_sum_.size(), 0);
  for (int v = 0; v < bounds_.height; ++v) {
    double sum = 0.0;
    int count = 0;
    for (int u = 0; u < width; ++u) {
      const cv::Point at(bounds_.x + u, bounds_.y + v);
      if (labels(at) == election.host) {
        const auto i = static_cast<std::size_t>(grid.Index(at.x, at.y));
        sum += static_cast<double>(ResidualSigmas(grid, i, election.plane)), ++count;
      }
      const auto k = static_cast<std::size_t>((v + 1) * stride + u + 1);
      integral_sum_[k] = integral_sum_[k - static_cast<std::size_t>(stride)] + sum;
      integral_count_[k] = integral_count_[k - static_cast<std::size_t>(stride)] + count;
    }
  }
  const auto window = [&](const auto& integral, int u, int v) {
    const int l = std::max(u - reach, 0), r = std::min(u + reach + 1, width);
    const int t = std::max(v - reach, 0), b = std::min(v + reach + 1, bounds_.height);
    const auto at = [&](int x, int y) {
      return integral[static_cast<std::size_t>(y * stride + x)];
    };
    return at(r, b) - at(l, b) - at(r, t) + at(l, t);
  };
  const double middle = 0.5 * (election.low + election.high);
  mask_.assign(static_cast<std::size_t>(width * bounds_.height), 0);
  for (int v = 0; v < bounds_.height; ++v) {
    for (int u = 0; u < width; ++u) {
      const cv::Point at(bounds_.x + u, bounds_.y + v);
      if (labels(at) != election.host || !eligible.contains(at)) continue;
      const double vote = window(integral_sum_, u, v) / window(integral_count_, u, v);
      if (vote > middle) mask_[static_cast<std::size_t>(v * width + u)] = 1;
    }
  }
  FillHoles(width, bounds_.height);
  pixels_.clear();
  for (int k = 0; k < width * bounds_.height; ++k) {
    if (mask_[static_cast<std::size_t>(k)] == kOutside) continue;
    const cv::Point at(bounds_.x + k % width, bounds_.y + k / width);
    if (labels(at) == election.host) pixels_.push_back(grid.Index(at.x, at.y));
  }
}

/// Leaves the largest part in the mask, and marks what the border reaches around it.
void ElectedRegion::FillHoles(int width, int height) {
  const std::vector<int>& largest = parts_.Of(mask_, width);
  mask_.assign(mask_.size(), 0);
  for (const int k : largest) mask_[static_cast<std::size_t>(k)] = 1;
  stack_.clear();
  const auto visit = [&](int k) {
    std::uint8_t& at = mask_[static_cast<std::size_t>(k)];
    if (at == 0) at = kOutside, stack_.push_back(k);
  };
  for (int u = 0; u < width; ++u) visit(u), visit((height - 1) * width + u);
  for (int v = 0; v < height; ++v) visit(v * width), visit(v * width + width - 1);
  while (!stack_.empty()) {
    const int k = stack_.back();
    stack_.pop_back();
    if (k % width > 0) visit(k - 1);
    if (k % width + 1 < width) visit(k + 1);
    if (k >= width) visit(k - width);
    if (k + width < width * height) visit(k + width);
  }
}

PlaneSums ElectedRegion::Sum(const DepthGrid& grid) const {
  PlaneSums sums;
  for (const int i : pixels_) {
    const auto k = static_cast<std::size_t>(i);
    const double g = static_cast<double>(grid.g[k]);
    sums.Add(static_cast<double>(grid.x[k]), static_cast<double>(grid.y[k]),
             static_cast<double>(grid.q[k]), g * g);
  }
  return sums;
}

double ElectedRegion::MeanHeight(const DepthGrid& grid, const LabelPlane& plane) const {
  double sum = 0.0;
  for (const int i : pixels_)
    sum += static_cast<double>(ResidualSigmas(grid, static_cast<std::size_t>(i), plane));
  return sum / static_cast<double>(std::max<std::size_t>(pixels_.size(), 1));
}

}  // namespace slam

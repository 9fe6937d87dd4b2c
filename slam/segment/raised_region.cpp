#include "slam/segment/raised_region.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "slam/segment/largest_component.h"

namespace slam {
namespace {

/// Sums over windows of an image of the heights of a segment's pixels.
class HeightWindows {
 public:
  HeightWindows(const DepthGrid& grid, const cv::Mat1b& own, const RaisedRegionSearch& search)
      : size_(own.size()), reach_(VoteReach(search.window_px)) {
    cv::Mat1f heights(size_, 0.0f);
    for (int v = 0; v < size_.height; ++v) {
      for (int u = 0; u < size_.width; ++u) {
        if (own(v, u) == 0) continue;
        const int i = grid.Index(search.voters.x + u, search.voters.y + v);
        heights(v, u) = ResidualSigmas(grid, static_cast<std::size_t>(i), search.plane);
      }
    }
    cv::integral(heights, sums_, CV_64F);
    cv::integral(own & 1, counts_, CV_32S);
  }

  /// Mean height of the segment's pixels around one of them.
  double MeanAround(int u, int v) const {
    const int left = std::max(u - reach_, 0), right = std::min(u + reach_ + 1, size_.width);
    const int top = std::max(v - reach_, 0), bottom = std::min(v + reach_ + 1, size_.height);
    const auto sum = [&](const auto& integral) {
      return integral(bottom, right) - integral(bottom, left) - integral(top, right) +
             integral(top, left);
    };
    return sum(sums_) / sum(counts_);
  }

 private:
  cv::Size size_;
  int reach_;
  cv::Mat1d sums_;
  cv::Mat1i counts_;
};

/// 255 in the region and its holes, which nothing 4-connected joins to the border.
cv::Mat1b WithHolesFilled(const cv::Mat1b& region) {
  cv::Mat1b framed;
  cv::copyMakeBorder(region, framed, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
  constexpr int kOutside = 1;
  cv::floodFill(framed, {0, 0}, kOutside);
  return cv::Mat(framed(cv::Rect({1, 1}, region.size())) != kOutside);
}

}  // namespace

int VoteReach(double window_px) {
  return std::max(1, static_cast<int>(std::ceil(0.5 * (std::sqrt(window_px) - 1.0))));
}

PixelRegion FindRaisedRegion(const DepthGrid& grid, const cv::Mat1b& labels,
                             const RaisedRegionSearch& search) {
  PixelRegion region{search.voters, {}};
  if (search.voters.empty()) return region;

  // Pixels that are high by the vote of what is around them.
  const cv::Mat1b own = cv::Mat(labels(search.voters) == search.label);
  const HeightWindows windows(grid, own, search);
  const cv::Rect eligible = (search.eligible & search.voters) - search.voters.tl();
  cv::Mat1b high(own.size(), 0);
  for (int v = eligible.y; v < eligible.y + eligible.height; ++v) {
    for (int u = eligible.x; u < eligible.x + eligible.width; ++u) {
      if (own(v, u) != 0 && windows.MeanAround(u, v) > search.middle_sigmas) high(v, u) = 255;
    }
  }

  // The largest of the regions that they make, and what of the segment it surrounds.
  const cv::Mat1b filled = cv::Mat(WithHolesFilled(LargestComponent(high)) & own);
  for (int v = 0; v < filled.rows; ++v) {
    for (int u = 0; u < filled.cols; ++u) {
      if (filled(v, u) != 0)
        region.pixels.push_back(grid.Index(search.voters.x + u, search.voters.y + v));
    }
  }
  return region;
}

PlaneSums SumOf(const DepthGrid& grid, const PixelRegion& region) {
  PlaneSums sums;
  for (const int i : region.pixels) AddPixel(grid, static_cast<std::size_t>(i), sums);
  return sums;
}

double MeanHeight(const DepthGrid& grid, const PixelRegion& region, const LabelPlane& plane) {
  double sum = 0.0;
  for (const int i : region.pixels)
    sum += static_cast<double>(ResidualSigmas(grid, static_cast<std::size_t>(i), plane));
  return sum / static_cast<double>(std::max<std::size_t>(region.pixels.size(), 1));
}

}  // namespace slam

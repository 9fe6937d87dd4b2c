#include <array>
#include <cstddef>

#include "slam/segment/plane_workspace.h"

namespace slam {
namespace {

constexpr double kMine = 0.8;  // of a segment's bounds, in those of what is expected

}  // namespace

/// Splits every segment that holds an expected plane and another one.
bool PlaneExtractor::Workspace::SplitBy(const std::vector<ExpectedPlane>& all,
                                        std::size_t expected, Frame& frame) {
  const ExpectedPlane& sought = all[expected];
  SetConvex(sought.outline_px, -sought.margin_px, frame.plane_labels.size(), expected_area);
  const std::array<int, 256> pixels = CountLabels(frame.plane_labels, expected_area);
  const cv::Rect bounds = expected_area.Bounds();
  own_segments.clear();
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const cv::Rect own(kept[k].low, kept[k].high + cv::Point(1, 1));
    if ((own & bounds).area() > kMine * own.area()) own_segments.push_back(k);
  }
  bool split = false;
  const std::size_t count = kept.size();
  for (std::size_t k = 0; k < count; ++k) {
    // Where it is most of the segment, the other plane is sought instead.
    if (2 * pixels[k + 1] < config.min_pixels || 2 * pixels[k + 1] > kept[k].sums.n) continue;
    if (Angle(kept[k].plane.plane.Hessian().n, sought.pi_c.n) > config.map_split.max_angle_rad)
      continue;
    if (!map_split.Find(grid, frame.plane_labels, static_cast<int>(k), kept[k], all, expected,
                        config))
      continue;
    split = TakeRegion(k, map_split.region(), frame.plane_labels) || split;
  }
  return split;
}

bool PlaneExtractor::SplitByMap(Frame& frame, const std::vector<ExpectedPlane>& expected) {
  // A bend that was once taken for a step would go on as one.
  if (!work_->config.map_split.enabled || work_->sensor_bends) return false;
  bool split = false;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    if (!expected[k].outline_px.empty()) split = work_->SplitBy(expected, k, frame) || split;
  }
  if (!split) return false;
  work_->Renumber(frame.plane_labels);
  work_->Describe(frame);
  return true;
}

}  // namespace slam

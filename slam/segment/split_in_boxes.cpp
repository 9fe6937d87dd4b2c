#include <algorithm>
#include <array>
#include <optional>

#include "slam/segment/plane_workspace.h"

namespace slam {
namespace {

/// Places of the boxes that may hold thin things, the smallest first whatever their order.
void SortBoxes(const std::vector<Detection>& detections, double min_score,
               std::vector<Box>& boxes_px) {
  boxes_px.clear();
  for (const Detection& detection : detections) {
    if (detection.kind == ClassKind::kRegular && detection.score > min_score)
      boxes_px.push_back(detection.box_px);
  }
  const auto rank = [](const Box& b) {
    return std::array<double, 4>{b.area(), b.min.y(), b.min.x(), b.max.x()};
  };
  std::sort(boxes_px.begin(), boxes_px.end(),
            [&](const Box& a, const Box& b) { return rank(a) < rank(b); });
}

// A box that its own segments fill by this share misses nothing; balances thin things beside
// others against false ones.
constexpr double kFullShare = 0.7;

bool LiesIn(const Box& segment_px, const Box& box_px) {
  constexpr double kInBox = 0.8;  // share of its bounds: boxes are several pixels inexact
  return Intersection(segment_px, box_px).area() > kInBox * segment_px.area();
}

/// About how many pixels of each label a box holds, from every fourth pixel of every fourth
/// row.
std::array<int, 256> CountLabels(const cv::Mat1b& labels, const Box& box_px) {
  constexpr int kStep_px = 4;
  std::array<int, 256> pixels{};
  const cv::Point low(std::max(0, static_cast<int>(box_px.min.x())),
                      std::max(0, static_cast<int>(box_px.min.y())));
  const int right = std::min(labels.cols - 1, static_cast<int>(box_px.max.x()));
  const int bottom = std::min(labels.rows - 1, static_cast<int>(box_px.max.y()));
  for (int v = low.y; v <= bottom; v += kStep_px) {
    for (int u = low.x; u <= right; u += kStep_px) pixels[labels(v, u)] += kStep_px * kStep_px;
  }
  return pixels;
}

}  // namespace

/// Gives the region that was found in a segment to one of the box's own that it agrees with, or
/// makes it a new one, if what it is and what is left can be measured.
bool PlaneExtractor::Workspace::TakeRegion(std::size_t host, const PixelRegion& found,
                                           cv::Mat1b& drawn) {
  const PlaneSums region = SumOf(grid, found);
  const std::optional<Segment> rest =
      Measure(Without(kept[host].sums, region), kept[host].id, sensor.noise, config);
  const std::optional<Segment> top = Measure(region, 0, sensor.noise, config);
  if (!rest || !top) return false;
  std::size_t into = kept.size();

  // It is part of the box's own segment whose plane is nearest, if one agrees within noise.
  double min_gap = 1.0;
  for (const std::size_t own : own_segments) {
    const double gap = SurfaceGap({kept[own].sums, kept[own].plane}, {region, top->plane},
                                  sensor.noise, config.joining);
    if (gap < min_gap) min_gap = gap, into = own;
  }

  // Otherwise it makes a segment of its own; the host keeps the rest.
  const cv::Point low = found.bounds.tl();
  const cv::Point high = found.bounds.br() - cv::Point(1, 1);
  if (into == kept.size()) {
    if (kept.size() == static_cast<std::size_t>(kMaxSegments)) return false;
    kept.push_back(*top);
    kept[into].low = low, kept[into].high = high;
  } else {
    Extend(region, low, high, sensor.noise, config, kept[into]);
  }
  kept[host].sums = rest->sums, kept[host].plane = rest->plane;
  kept[host].sigmas = rest->sigmas;
  for (const int i : found.pixels)
    drawn(i / grid.width, i % grid.width) = static_cast<std::uint8_t>(into + 1);
  return true;
}

bool PlaneExtractor::Workspace::SplitInBox(const Box& box_px, Frame& frame) {
  // Segments that lie in the box are its own: what it shows may be there already.
  Box own_px;
  own_segments.clear();
  for (std::size_t k = 0; k < frame.planes.size(); ++k) {
    const Box& bounds_px = frame.planes[k].box_px;
    if (!LiesIn(bounds_px, box_px)) continue;
    own_segments.push_back(k);
    own_px.Include(bounds_px.min), own_px.Include(bounds_px.max);
  }
  const std::array<int, 256> pixels = CountLabels(frame.plane_labels, box_px);
  double own_pixels = 0.0;
  for (const std::size_t own : own_segments) own_pixels += pixels[own + 1];
  if (own_pixels > kFullShare * box_px.area()) return false;

  // The others may hold a thin thing in the box that became part of them.
  const double min_px = std::max(1.0 * config.min_pixels, kMinFilledShare * box_px.area());
  bool split = false;
  for (std::size_t k = 0; k < frame.planes.size(); ++k) {
    if (pixels[k + 1] < min_px || LiesIn(frame.planes[k].box_px, box_px)) continue;
    const std::optional<PixelRegion> top =
        FindThinTop(grid, frame.plane_labels, static_cast<std::uint8_t>(k + 1), kept[k].plane,
                    box_px, own_px, sensor.noise, config);
    if (top) split = TakeRegion(k, *top, frame.plane_labels) || split;
  }
  return split;
}

/// Sorts the segments by size again, and their values in the label image with them.
void PlaneExtractor::Workspace::Renumber(cv::Mat1b& drawn) {
  for (std::size_t k = 0; k < kept.size(); ++k) kept[k].id = static_cast<int>(k);
  SortBySize(kept);
  std::array<std::uint8_t, 256> value{};
  for (std::size_t k = 0; k < kept.size(); ++k)
    value[static_cast<std::size_t>(kept[k].id + 1)] = static_cast<std::uint8_t>(k + 1);
  for (int v = 0; v < drawn.rows; ++v) {
    for (int u = 0; u < drawn.cols; ++u) drawn(v, u) = value[drawn(v, u)];
  }
}

void PlaneExtractor::SplitInBoxes(Frame& frame) {
  if (!work_->config.box_split.enabled) return;
  SortBoxes(frame.detections, work_->config.box_split.min_score, work_->boxes_px);
  bool split = false;
  for (const Box& box_px : work_->boxes_px) split = work_->SplitInBox(box_px, frame) || split;
  if (!split) return;
  work_->Renumber(frame.plane_labels);
  work_->Describe(frame);
}

}  // namespace slam

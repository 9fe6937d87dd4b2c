#include "slam/segment/box_split.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "slam/segment/largest_component.h"

namespace slam {
namespace {

// All of these were chosen on simulated desks, seeds 21 to 27 (docs/planes.md).
constexpr int kCell_px = 4, kLargeCell_px = 8;  // smaller: finer outlines, noisier votes
constexpr double kLargeBox_px = 160.0;          // from here on cells are large, to save time
constexpr int kStep_px = 4;      // only such pixels and rows count: nearer ones share errors
constexpr int kReach_cells = 1;  // so far around a cell others vote on it: 3 x 3
constexpr float kMinOwnShare = 0.5f;  // a cell with less of the segment has no vote
constexpr float kNoVote = std::numeric_limits<float>::quiet_NaN();
constexpr int kBins = 128;  // for votes from -kMaxVote_sigmas to kMaxVote_sigmas
// Twice what a pixel may be off its plane (GrowthConfig).
constexpr double kMaxVote_sigmas = 6.0;
constexpr int kRefinements = 3;          // passes for both heights after the first threshold
constexpr double kMargins_around = 3.0;  // so many margins around the box are compared with it
constexpr int kNear_cells = 1, kFar_cells = 2;  // the step is looked for so near its edge
constexpr double kMinSuddenShare = 0.9;         // part of the step within them; a bend has less
constexpr double kMinCoreShare = 0.25;  // part of a region inside its edge; a line has none

cv::Rect Widened(const Box& box, double by_px, const cv::Size& size) {
  const int left = static_cast<int>(std::floor(box.min.x() - by_px));
  const int top = static_cast<int>(std::floor(box.min.y() - by_px));
  const int right = static_cast<int>(std::ceil(box.max.x() + by_px));
  const int bottom = static_cast<int>(std::ceil(box.max.y() + by_px));
  return cv::Rect(left, top, right - left + 1, bottom - top + 1) &
         cv::Rect(0, 0, size.width, size.height);
}

/// The pixels of a segment in and around a box, in cells that vote on each other's height.
class HeightCells {
 public:
  /// @param area    what is looked at: the box, its margin, and what is around
  /// @param inside  the box and its margin
  HeightCells(const DepthGrid& grid, const cv::Mat1b& labels, std::uint8_t label,
              const LabelPlane& plane, const cv::Rect& area, const cv::Rect& inside,
              int cell_px)
      : area_(area),
        cell_px_(cell_px),
        cols_(area.width / cell_px),
        rows_(area.height / cell_px) {
    cells_.resize(static_cast<std::size_t>(cols_ * rows_));
    SumCells(grid, labels, label, plane);
    for (int y = 0; y < rows_; ++y) {
      for (int x = 0; x < cols_; ++x) {
        const cv::Point middle(x * cell_px + cell_px / 2, y * cell_px + cell_px / 2);
        At(x, y).inside = inside.contains(area.tl() + middle);
      }
    }
    Vote();
  }

  /// Parts the votes in two. @returns whether there are two kinds
  bool FindHeights();
  double low() const { return low_; }
  double high() const { return high_; }

  /// Whether more than `max_share` of the cells around the box are high, or there are none.
  bool IsHighAround(double max_share) const;
  /// The largest connected region of high cells in the box: 255 where it is.
  cv::Mat1b LargestHighRegion() const;
  /// Whether the step to a region is there within some cells of its boundary.
  bool StepsAtOnce(const cv::Mat1b& region) const;
  /// The bounds of a region, pixels.
  Box BoundsOf(const cv::Mat1b& region) const;

 private:
  struct Cell {
    float sum = 0.0f;  ///< the residuals of its pixels, sigmas
    float count = 0.0f;
    float vote = 0.0f;  ///< the mean of the residuals around; kNoVote if too few
    bool inside = false;
  };

  void SumCells(const DepthGrid& grid, const cv::Mat1b& labels, std::uint8_t label,
                const LabelPlane& plane);
  void Vote();
  bool IsHigh(const Cell& cell) const {
    return static_cast<double>(cell.vote) > 0.5 * (low_ + high_);  // false for kNoVote
  }
  Cell& At(int x, int y) { return cells_[static_cast<std::size_t>(y * cols_ + x)]; }
  const Cell& At(int x, int y) const { return cells_[static_cast<std::size_t>(y * cols_ + x)]; }

  cv::Rect area_;
  int cell_px_, cols_, rows_;
  std::vector<Cell> cells_;
  double low_ = 0.0, high_ = 0.0;  ///< mean heights of the two kinds of cells, sigmas
};

void HeightCells::SumCells(const DepthGrid& grid, const cv::Mat1b& labels, std::uint8_t label,
                           const LabelPlane& plane) {
  for (int v = 0; v < rows_ * cell_px_; v += kStep_px) {
    const std::uint8_t* row = labels[area_.y + v] + area_.x;
    const auto start = static_cast<std::size_t>(grid.Index(area_.x, area_.y + v));
    for (int u = 0; u < cols_ * cell_px_; u += kStep_px) {
      if (row[u] != label) continue;
      Cell& cell = At(u / cell_px_, v / cell_px_);
      cell.sum += ResidualSigmas(grid, start + static_cast<std::size_t>(u), plane);
      cell.count += 1.0f;
    }
  }
}

void HeightCells::Vote() {
  const int samples = cell_px_ / kStep_px;
  const float min_count = kMinOwnShare * static_cast<float>(samples * samples);
  for (int y = 0; y < rows_; ++y) {
    for (int x = 0; x < cols_; ++x) {
      Cell& cell = At(x, y);
      cell.vote = kNoVote;
      if (cell.count < min_count) continue;
      float sum = 0.0f, count = 0.0f;
      for (int b = std::max(y - kReach_cells, 0); b <= std::min(y + kReach_cells, rows_ - 1);
           ++b) {
        for (int a = std::max(x - kReach_cells, 0); a <= std::min(x + kReach_cells, cols_ - 1);
             ++a)
          sum += At(a, b).sum, count += At(a, b).count;
      }
      cell.vote = sum / count;
    }
  }
}

bool HeightCells::FindHeights() {
  // The first threshold is Otsu's, of the votes in bins.
  cv::Mat1b bins(1, static_cast<int>(cells_.size()));
  int voters = 0;
  for (const Cell& cell : cells_) {
    if (std::isnan(cell.vote)) continue;
    const double bin =
        (static_cast<double>(cell.vote) + kMaxVote_sigmas) * kBins / (2.0 * kMaxVote_sigmas);
    bins(voters++) = static_cast<std::uint8_t>(std::clamp(static_cast<int>(bin), 0, kBins - 1));
  }
  if (voters == 0) return false;
  cv::Mat1b is_high;
  const double last_low_bin =
      cv::threshold(bins.colRange(0, voters), is_high, 0.0, 1.0, cv::THRESH_OTSU);
  double threshold = (last_low_bin + 1.0) * 2.0 * kMaxVote_sigmas / kBins - kMaxVote_sigmas;

  // Then the middle between the means of both kinds, a few times.
  for (int pass = 0; pass < kRefinements; ++pass) {
    std::array<double, 2> sums{}, counts{};
    for (const Cell& cell : cells_) {
      if (std::isnan(cell.vote)) continue;
      const std::size_t kind = static_cast<double>(cell.vote) > threshold ? 1 : 0;
      sums[kind] += static_cast<double>(cell.vote), counts[kind] += 1.0;
    }
    if (counts[0] == 0.0 || counts[1] == 0.0) return false;
    low_ = sums[0] / counts[0], high_ = sums[1] / counts[1];
    threshold = 0.5 * (low_ + high_);
  }
  return true;
}

bool HeightCells::IsHighAround(double max_share) const {
  int around = 0, high = 0;
  for (const Cell& cell : cells_) {
    if (cell.inside || std::isnan(cell.vote)) continue;
    ++around;
    if (IsHigh(cell)) ++high;
  }
  return around == 0 || high > max_share * around;
}

cv::Mat1b HeightCells::LargestHighRegion() const {
  cv::Mat1b mask(rows_, cols_);
  for (int y = 0; y < rows_; ++y) {
    for (int x = 0; x < cols_; ++x) mask(y, x) = At(x, y).inside && IsHigh(At(x, y)) ? 255 : 0;
  }
  return LargestComponent(mask);
}

bool HeightCells::StepsAtOnce(const cv::Mat1b& region) const {
  const auto is_region = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < cols_ && y < rows_ && region(y, x) != 0;
  };
  const auto all_around = [&](int x, int y, int reach, bool in_region) {
    for (int b = y - reach; b <= y + reach; ++b) {
      for (int a = x - reach; a <= x + reach; ++a)
        if (is_region(a, b) != in_region) return false;
    }
    return true;
  };
  struct Mean {
    double sum = 0.0, count = 0.0;
    double Value(double otherwise) const { return count > 0.0 ? sum / count : otherwise; }
  };

  // Heights near the boundary and far from it, beside the region and in it; what touches the
  // boundary is smoothed and does not count.
  std::array<Mean, 2> near, far;  // off the region, and of it
  int core = 0;
  for (int y = 0; y < rows_; ++y) {
    for (int x = 0; x < cols_; ++x) {
      const bool in_region = is_region(x, y);
      if (std::isnan(At(x, y).vote) || !all_around(x, y, kNear_cells, in_region)) continue;
      if (in_region) ++core;
      Mean& mean = (all_around(x, y, kFar_cells, in_region) ? far : near)[in_region ? 1 : 0];
      mean.sum += static_cast<double>(At(x, y).sum);
      mean.count += static_cast<double>(At(x, y).count);
    }
  }
  if (near[0].count == 0.0 || near[1].count == 0.0) return false;
  if (core < kMinCoreShare * cv::countNonZero(region)) return false;

  // A bend's step grows with the distance from the boundary.
  const double step = near[1].Value(high_) - near[0].Value(low_);
  return step > kMinSuddenShare * (far[1].Value(high_) - far[0].Value(low_));
}

Box HeightCells::BoundsOf(const cv::Mat1b& region) const {
  const cv::Rect cells = cv::boundingRect(region);
  if (cells.empty()) return {};
  const Eigen::Vector2d low(area_.x + cells.x * cell_px_, area_.y + cells.y * cell_px_);
  return {low, low + Eigen::Vector2d(cells.width * cell_px_ - 1, cells.height * cell_px_ - 1)};
}

}  // namespace

std::optional<PixelRegion> FindThinTop(const DepthGrid& grid, const cv::Mat1b& labels,
                                       std::uint8_t label, const LabelPlane& plane,
                                       const Box& box_px, const Box& own_px,
                                       const DepthNoise& noise,
                                       const PlaneExtractionConfig& config) {
  const BoxSplitConfig& rules = config.box_split;
  const double side_px = std::max(box_px.width(), box_px.height());
  const double margin_px = rules.margin_px + rules.margin_fraction * side_px;
  const cv::Rect inside = Widened(box_px, margin_px, labels.size());
  const cv::Rect area = Widened(box_px, kMargins_around * margin_px, labels.size());
  const int cell_px = side_px < kLargeBox_px ? kCell_px : kLargeCell_px;
  HeightCells cells(grid, labels, label, plane, area, inside, cell_px);

  // Cells of two heights, farther apart than votes of noise are, and none as high around.
  const double window_px = (2 * kReach_cells + 1) * cell_px;
  const double vote_sigma = std::sqrt(noise.correlated_px) / window_px;
  if (!cells.FindHeights() || !(cells.high() - cells.low() > rules.min_step_votes * vote_sigma))
    return std::nullopt;
  if (cells.IsHighAround(rules.max_high_around)) return std::nullopt;

  // A region of them that fills the box and ends in a step.
  const cv::Mat1b high = cells.LargestHighRegion();
  const double high_px2 = static_cast<double>(cv::countNonZero(high)) * cell_px * cell_px;
  if (!(high_px2 > 0.5 * config.min_pixels)) return std::nullopt;
  const Box high_px = cells.BoundsOf(high);
  if (!(high_px.area() > kMinFilledShare * box_px.area())) return std::nullopt;
  Box filled_px = high_px;
  if (!own_px.empty()) filled_px.Include(own_px.min), filled_px.Include(own_px.max);
  if (!(Iou(filled_px, box_px) > rules.min_box_iou) || !cells.StepsAtOnce(high))
    return std::nullopt;

  // Its pixels, if they are enough and surely higher.
  const double votes_px = rules.vote_errors * noise.correlated_px;
  const cv::Rect voters = Widened(high_px, cell_px + VoteReach(votes_px), labels.size()) & area;
  PixelRegion region = FindRaisedRegion(
      grid, labels,
      {label, plane, 0.5 * (cells.low() + cells.high()), votes_px, voters, inside});
  const auto pixels = static_cast<double>(region.pixels.size());
  const double errors = pixels / noise.correlated_px;
  const double height = MeanHeight(grid, region, plane) - cells.low();
  if (!(pixels >= config.min_pixels) ||
      !(height * std::sqrt(errors) > rules.min_evidence_sigmas))
    return std::nullopt;
  return region;
}

}  // namespace slam

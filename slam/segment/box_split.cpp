#include "slam/segment/box_split.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace slam {
namespace {

constexpr int kCell_px = 4, kLargeCell_px = 8;
constexpr double kLargeBox_px = 160.0;  // from here on cells are large
// Only every such pixel of every such row counts: errors are shared.
constexpr int kStep_px = 4;
constexpr int kReach = 1;            // cells around a cell that vote on it
constexpr float kLeastShare = 0.5f;  // of a cell that must be the segment's
constexpr float kNoVote = std::numeric_limits<float>::quiet_NaN();
constexpr int kBins = 128;  // of votes, from -kMostVote to kMostVote sigmas
constexpr double kMostVote = 6.0;
constexpr int kNear = 1, kFar = 2;   // cells from the boundary between which a step is measured
constexpr double kStepAtOnce = 0.9;  // part of the height that is there within that distance
constexpr double kLeastCore = 0.25;  // part of a region that is not its boundary

cv::Rect Widened(const Box& box, double by_px, const cv::Size& size) {
  const int left = static_cast<int>(std::floor(box.min.x() - by_px));
  const int top = static_cast<int>(std::floor(box.min.y() - by_px));
  const int right = static_cast<int>(std::ceil(box.max.x() + by_px));
  const int bottom = static_cast<int>(std::ceil(box.max.y() + by_px));
  return cv::Rect(left, top, right - left + 1, bottom - top + 1) &
         cv::Rect(0, 0, size.width, size.height);
}

/// The threshold between two kinds of votes that differ most (Otsu), from their histogram.
double Divide(const std::array<int, kBins>& histogram) {
  double all = 0.0, sum = 0.0;
  for (int k = 0; k < kBins; ++k) {
    all += histogram[static_cast<std::size_t>(k)];
    sum += k * histogram[static_cast<std::size_t>(k)];
  }
  double below = 0.0, below_sum = 0.0, best = -1.0;
  int best_bin = kBins / 2;
  for (int k = 0; k + 1 < kBins; ++k) {
    below += histogram[static_cast<std::size_t>(k)];
    below_sum += k * histogram[static_cast<std::size_t>(k)];
    const double above = all - below;
    if (below == 0.0 || above == 0.0) continue;
    const double apart = below_sum / below - (sum - below_sum) / above;
    const double between = below * above * apart * apart;
    if (between > best) best = between, best_bin = k;
  }
  return (best_bin + 1) * 2.0 * kMostVote / kBins - kMostVote;
}

}  // namespace

void BoxSplit::SumCells(const DepthGrid& grid, const cv::Mat1b& labels, std::uint8_t host,
                        const LabelPlane& plane) {
  cols_ = area_.width / cell_px_, rows_ = area_.height / cell_px_;
  cells_.assign(static_cast<std::size_t>(cols_ * rows_), {});
  for (int v = 0; v < rows_ * cell_px_; v += kStep_px) {
    const std::uint8_t* label = labels[area_.y + v] + area_.x;
    const auto start = static_cast<std::size_t>(grid.Index(area_.x, area_.y + v));
    Cell* row = cells_.data() + v / cell_px_ * cols_;
    for (int u = 0; u < cols_ * cell_px_; u += kStep_px) {
      if (label[u] != host) continue;
      Cell& cell = row[u / cell_px_];
      cell.sum += ResidualSigmas(grid, start + static_cast<std::size_t>(u), plane);
      cell.count += 1.0f;
    }
  }
  for (int y = 0; y < rows_; ++y) {
    for (int x = 0; x < cols_; ++x) {
      const cv::Point middle(area_.x + x * cell_px_ + cell_px_ / 2,
                             area_.y + y * cell_px_ + cell_px_ / 2);
      cells_[static_cast<std::size_t>(y * cols_ + x)].inside = search_.contains(middle);
    }
  }
}

void BoxSplit::Vote() {
  const int samples = cell_px_ / kStep_px;
  const float least = kLeastShare * static_cast<float>(samples * samples);
  for (int y = 0; y < rows_; ++y) {
    for (int x = 0; x < cols_; ++x) {
      Cell& cell = cells_[static_cast<std::size_t>(y * cols_ + x)];
      cell.vote = kNoVote;
      if (cell.count < least) continue;
      float sum = 0.0f, count = 0.0f;
      for (int b = std::max(y - kReach, 0); b <= std::min(y + kReach, rows_ - 1); ++b) {
        for (int a = std::max(x - kReach, 0); a <= std::min(x + kReach, cols_ - 1); ++a)
          sum += At(a, b).sum, count += At(a, b).count;
      }
      cell.vote = sum / count;
    }
  }
}

bool BoxSplit::FindHeights() {
  std::array<int, kBins> histogram{};
  for (const Cell& cell : cells_) {
    if (std::isnan(cell.vote)) continue;
    const double at = (static_cast<double>(cell.vote) + kMostVote) * kBins / (2.0 * kMostVote);
    ++histogram[static_cast<std::size_t>(std::clamp(static_cast<int>(at), 0, kBins - 1))];
  }
  double threshold = Divide(histogram);
  for (int pass = 0; pass < 3; ++pass) {
    double sums[2] = {0.0, 0.0}, counts[2] = {0.0, 0.0};
    for (const Cell& cell : cells_) {
      if (std::isnan(cell.vote)) continue;
      const int kind = static_cast<double>(cell.vote) > threshold ? 1 : 0;
      sums[kind] += static_cast<double>(cell.vote), counts[kind] += 1.0;
    }
    if (counts[0] == 0.0 || counts[1] == 0.0) return false;
    low_ = sums[0] / counts[0], high_ = sums[1] / counts[1];
    threshold = 0.5 * (low_ + high_);
  }
  return true;
}

bool BoxSplit::HighAround(double most) const {
  int around = 0, high = 0;
  for (const Cell& cell : cells_) {
    if (cell.inside || std::isnan(cell.vote)) continue;
    ++around;
    if (static_cast<double>(cell.vote) > 0.5 * (low_ + high_)) ++high;
  }
  return around == 0 || high > most * around;
}

void BoxSplit::FindLargestRegion() {
  mask_.assign(cells_.size(), 0);
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    const bool high = static_cast<double>(cells_[k].vote) > 0.5 * (low_ + high_);
    mask_[k] = cells_[k].inside && high ? 1 : 0;
  }
  best_ = parts_.Of(mask_, cols_);
  chosen_.assign(cells_.size(), 0);
  for (const int k : best_) chosen_[static_cast<std::size_t>(k)] = 1;
}

bool BoxSplit::StepsAtOnce() const {
  const auto all_around = [&](int x, int y, int reach, bool chosen) {
    for (int b = y - reach; b <= y + reach; ++b) {
      for (int a = x - reach; a <= x + reach; ++a)
        if (Chosen(a, b) != chosen) return false;
    }
    return true;
  };
  struct Mean {
    double sum = 0.0, count = 0.0;
    double Value(double otherwise) const { return count > 0.0 ? sum / count : otherwise; }
  };
  std::array<Mean, 2> near, far;  // off the region, and of it
  int core = 0;
  for (int y = 0; y < rows_; ++y) {
    for (int x = 0; x < cols_; ++x) {
      const bool chosen = Chosen(x, y);
      if (std::isnan(At(x, y).vote) || !all_around(x, y, kNear, chosen)) continue;
      if (chosen) ++core;
      Mean& mean = (all_around(x, y, kFar, chosen) ? far : near)[chosen ? 1 : 0];
      mean.sum += static_cast<double>(At(x, y).sum);
      mean.count += static_cast<double>(At(x, y).count);
    }
  }
  if (near[0].count == 0.0 || near[1].count == 0.0) return false;
  if (core < kLeastCore * static_cast<double>(best_.size())) return false;
  const double step = near[1].Value(high_) - near[0].Value(low_);
  return step > kStepAtOnce * (far[1].Value(high_) - far[0].Value(low_));
}

Box BoxSplit::RegionBounds() const {
  Box bounds;
  for (const int k : best_) {
    const Eigen::Vector2d corner(area_.x + k % cols_ * cell_px_,
                                 area_.y + k / cols_ * cell_px_);
    bounds.Include(corner);
    bounds.Include(corner + Eigen::Vector2d::Constant(cell_px_ - 1));
  }
  return bounds;
}

bool BoxSplit::Find(const DepthGrid& grid, const cv::Mat1b& labels, std::uint8_t host,
                    const LabelPlane& plane, const Box& box_px, const Box& own_px,
                    const PlaneExtractionConfig& config) {
  const BoxSplitConfig& rules = config.box_split;
  const double margin_px =
      rules.margin_px + rules.margin_fraction * std::max(box_px.width(), box_px.height());
  search_ = Widened(box_px, margin_px, labels.size());
  area_ = Widened(box_px, 3.0 * margin_px, labels.size());
  cell_px_ =
      std::max(box_px.width(), box_px.height()) < kLargeBox_px ? kCell_px : kLargeCell_px;
  SumCells(grid, labels, host, plane);
  Vote();
  const double window_px = (2 * kReach + 1) * cell_px_;
  const double vote_sigma = std::sqrt(config.noise.correlated_px) / window_px;
  if (!FindHeights() || !(high_ - low_ > rules.min_step_votes * vote_sigma)) return false;
  if (HighAround(rules.max_high_around)) return false;
  FindLargestRegion();
  if (!(static_cast<double>(best_.size()) * cell_px_ * cell_px_ > 0.5 * config.min_pixels))
    return false;
  const Box region_px = RegionBounds();
  if (!(region_px.area() > BoxSplit::kLeastFilled * box_px.area())) return false;
  Box filled_px = region_px;
  if (!own_px.empty()) filled_px.Include(own_px.min), filled_px.Include(own_px.max);
  if (!(Iou(filled_px, box_px) > rules.min_box_iou) || !StepsAtOnce()) return false;

  const double votes_px = rules.vote_errors * config.noise.correlated_px;
  const cv::Rect votes =
      Widened(region_px, cell_px_ + ElectedRegion::Reach(votes_px), labels.size()) & area_;
  region_.Elect(grid, labels, {host, plane, low_, high_, votes_px}, votes, search_);
  const double errors =
      static_cast<double>(region_.pixels().size()) / config.noise.correlated_px;
  return static_cast<double>(region_.pixels().size()) >= config.min_pixels &&
         (region_.MeanHeight(grid, plane) - low_) * std::sqrt(errors) >
             rules.min_evidence_sigmas;
}

std::array<int, 256> CountLabels(const cv::Mat1b& labels, const Box& box_px) {
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

}  // namespace slam

#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core/types.hpp>
#include <utility>
#include <vector>

#include "slam/geometry/plane_sums.h"
#include "slam/segment/block_pixels.h"
#include "slam/segment/block_rivals.h"
#include "slam/segment/depth_grid.h"
#include "slam/segment/growth_config.h"
#include "slam/segment/pixel_labels.h"
#include "slam/segment/pixel_set.h"

namespace slam {

/// Planes growing over the pixels of an image, from block to block.
///
/// A pixel goes to the nearest plane, in sigmas, among those that have reached its block, if it
/// is nearer than max_pixel_sigmas. A plane that owns pixels of a block reaches the block's 8
/// neighbours, all planes a block further at a time. The memory of one image serves the next.
class PixelGrowth {
 public:
  /// Forgets everything and begins with an image. `grid` must outlive what is done with it.
  /// @throws std::invalid_argument for a block or a reach outside its domain
  void Begin(const DepthGrid& grid, const GrowthConfig& config);

  /// Adds a plane. @returns its label.
  int AddPlane(const LabelPlane& plane);
  /// Lets a plane claim pixels in a block.
  void Seed(int block, int label) {
    if (Reach(block, label)) Activate(block);
  }
  int BlockAt(int u, int v) const {
    return v / config_.block_px * cols_ + u / config_.block_px;
  }
  /// Spreads the planes added or changed since the last call.
  void Grow();
  /// Takes out the planes that gain less than min_gain, smallest first, and gives their pixels
  /// to the others.
  void DropUseless();
  /// Goes on with other planes for the labels: `planes` in place of the old ones and the pixels
  /// of label k counted as those of into[k]; everything is grown anew from there.
  void Replace(const std::vector<LabelPlane>& planes, const std::vector<int>& into);

  /// Marks the pixels whose label's plane has a mean residual in their block of less than
  /// `bias` + `standard_errors` / sqrt(its pixels there).
  /// @param settled  1 or 0 for each pixel; 1 where nothing is measured
  void MarkSettled(double bias, double standard_errors, std::vector<std::uint8_t>& settled);

  /// Sums of the pixels of each label. @param whole  those of the measured pixels of each
  /// block; empty: not known
  const std::vector<PlaneSums>& SumLabels(const std::vector<PlaneSums>& whole);

  /// Of every pixel. The call draws what has changed since the last one.
  const LabelImage& labels() const;
  const std::vector<LabelPlane>& planes() const { return planes_; }

 private:
  static constexpr int kNoClaim = -1;

  /// What is known of a plane in a block that it has reached. Neither what is near it nor its
  /// bids depend on the other planes there, so they are computed once.
  struct Claim {
    int label = 0;
    int next = kNoClaim;      ///< in its block, by label
    int near = 0;             ///< pixels within max_pixel_sigmas
    int pixels = 0;           ///< that it owns
    int bid = -1;             ///< place of its bids; -1 = it has not bid yet
    bool measured = false;    ///< its sets are
    bool spread = false;      ///< to the neighbours
    double least_gain = 0.0;  ///< BoundGains
  };
  /// Sets of a block's pixels that each claim has: those within max_pixel_sigmas, those within
  /// a sigma more, and those that it owns.
  enum Set { kNear, kWide, kOwned, kSetCount };

  Claim& At(int claim) { return claims_[static_cast<std::size_t>(claim)]; }
  const Claim& At(int claim) const { return claims_[static_cast<std::size_t>(claim)]; }
  int& First(int block) { return first_[static_cast<std::size_t>(block)]; }
  int First(int block) const { return first_[static_cast<std::size_t>(block)]; }
  PixelSet SetOf(int claim, Set set) {
    return sets_.data() + (static_cast<std::size_t>(claim) * kSetCount + set) * set_words_;
  }
  ConstPixelSet SetOf(int claim, Set set) const {
    return sets_.data() + (static_cast<std::size_t>(claim) * kSetCount + set) * set_words_;
  }
  ConstPixelSet MeasuredOf(int block) const {
    return measured_.data() + static_cast<std::size_t>(block) * set_words_;
  }
  float* BidsOf(int claim) {
    return bids_.data() + static_cast<std::size_t>(At(claim).bid) * slot_size_;
  }
  float NearSigmas() const { return static_cast<float>(config_.max_pixel_sigmas); }
  float WideSigmas() const { return static_cast<float>(config_.max_pixel_sigmas + 1.0); }
  cv::Point PlaceOf(int block) const { return place_[static_cast<std::size_t>(block)]; }
  const PixelPlane& PlaneOf(int claim) const {
    return pixel_planes_[static_cast<std::size_t>(At(claim).label)];
  }

  // Which blocks a label has reached: a bit each, row by row, with a margin that counts as
  // reached.
  std::size_t ReachedRow(int row, int label) const {
    return static_cast<std::size_t>(label) * label_bytes_ +
           static_cast<std::size_t>(row + 1) * row_bytes_;
  }
  struct Rows {
    int first, last;
  };
  void BeginReached();
  bool Reach(int block, int label);
  unsigned NotReachedAround(cv::Point place, int label) const;
  template <typename Visit>
  void VisitReached(int label, const Visit& visit) const;

  void Activate(int block);
  const BlockPixels& PixelsOf(int block) const {
    return blocks_[static_cast<std::size_t>(block)];
  }
  /// Of a block's first pixel.
  std::size_t IndexOf(int block) const {
    const cv::Point first = PlaceOf(block) * config_.block_px;
    return static_cast<std::size_t>(grid_->Index(first.x, first.y));
  }
  bool Measure(const BlockPixels& pixels, int block, int claim);
  void Bid(const BlockPixels& pixels, int block, int claim);
  void FindContested(int block, Set set);
  void Share(const BlockPixels& pixels, int block);
  bool LabelBlock(int block);
  void SpreadFrom(int block);
  int ClaimOf(int block, int label) const;
  /// Of the pixels of a block that nobody else has reached: not asked how well the plane fits.
  double GainAlone(int pixels) const {
    return static_cast<double>(WideSigmas() * WideSigmas() - 1.0f) * pixels;
  }
  void BoundGains();
  double GainOf(int claim, int block);
  bool IsUseful(int label);
  void Drop();
  void Unlink(int block, int label);

  const DepthGrid* grid_ = nullptr;
  GrowthConfig config_;
  int cols_ = 0, rows_ = 0;
  std::size_t slot_size_ = 0;  ///< pixels of a block, rounded up to whole lanes
  std::size_t set_words_ = 0;
  std::size_t row_bytes_ = 0, label_bytes_ = 0;  ///< of a row and a label in reached_
  std::vector<LabelPlane> planes_;
  std::vector<PixelPlane> pixel_planes_;  ///< the same
  std::vector<Claim> claims_;
  std::vector<std::uint64_t> sets_;      ///< of each claim
  std::vector<std::uint64_t> measured_;  ///< pixels of each block
  std::vector<cv::Point> place_;         ///< column and row of each block
  std::vector<BlockPixels> blocks_;
  std::vector<int> first_;                               ///< claim of each block
  std::vector<std::uint8_t> reached_, nothing_reached_;  ///< by label; what each begins with
  std::vector<Rows> reached_rows_;                       ///< by label: the rest is not reached
  std::vector<int> active_, next_active_;                ///< blocks that planes have reached
  std::vector<std::uint8_t> is_active_;
  std::vector<std::uint8_t>
      is_stale_;  ///< blocks whose pixels are not shared among their claims
  mutable std::vector<std::uint8_t> is_drawn_;  ///< blocks whose labels are up to date
  mutable LabelImage labels_;
  std::vector<float> bids_;  ///< BidForBlock
  std::size_t bid_count_ = 0;
  std::vector<PlaneSums> label_sums_;
  // What each label gains over the next best plane at its pixels.
  std::vector<double> least_gain_;  ///< that it has at least
  std::vector<int> pixels_;
  std::vector<std::size_t> fewest_first_;   ///< labels by pixels_
  std::vector<std::uint8_t> dropped_;       ///< each label
  std::vector<std::pair<int, int>> seeds_;  ///< (block, label)
  // Scratch of one block.
  std::vector<BlockRival> rivals_;
  std::vector<int> rival_claims_;
  mutable std::vector<BlockOwner> block_owners_;
  std::vector<std::uint64_t> contested_, unsettled_;
  std::vector<float> nearest_;  ///< of the planes that a label is compared with, sigmas
};

}  // namespace slam

#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "slam/geometry/box.h"
#include "slam/segment/depth_grid.h"
#include "slam/segment/elected_region.h"
#include "slam/segment/extraction_config.h"
#include "slam/segment/largest_part.h"
#include "slam/segment/pixel_labels.h"

namespace slam {

/// Finds the top of a thin thing that became part of what it lies on, inside a detection box.
///
/// A box says that something is there, and about where; the pixels say the rest. Where the
/// segment's pixels within the box are of two heights over its plane, the higher ones around
/// each pixel vote on it, and the largest connected region that they elect is the top if
///   - its step is more than votes of noise alone would elect (min_step_votes),
///   - its mean height is beyond doubt (min_evidence_sigmas),
///   - what is around the box is not as high (max_high_around), so that the box is not itself
///     in the middle of something high,
///   - the step is there at once along its boundary, as it is not where the sensor bends what
///     is flat, and
///   - it fills the box, alone or with the segments that the box has (min_box_iou).
/// The box's outline does not bound the region: boxes are several pixels inexact.
///
/// The memory of one search serves the next.
class BoxSplit {
 public:
  /// A region's bounds fill so much of the box at least.
  static constexpr double kLeastFilled = 0.1;

  /// @param labels   `host` where the segment is
  /// @param plane    of the segment
  /// @param box_px   of the detection
  /// @param own_px   bounds of the segments that lie in the box; empty: there are none
  /// @returns whether a region was found
  /// Cost: linear in the pixels of the box.
  bool Find(const DepthGrid& grid, const cv::Mat1b& labels, std::uint8_t host,
            const LabelPlane& plane, const Box& box_px, const Box& own_px,
            const PlaneExtractionConfig& config);

  /// Of the last search that found one.
  const ElectedRegion& region() const { return region_; }

 private:
  /// The segment's pixels in a square of the image.
  struct Cell {
    float sum = 0.0f;  ///< of residuals, sigmas
    float count = 0.0f;
    float vote = 0.0f;    ///< mean of the residuals around; kNoVote if too few
    bool inside = false;  ///< of the box, with its margin
  };

  void SumCells(const DepthGrid& grid, const cv::Mat1b& labels, std::uint8_t host,
                const LabelPlane& plane);
  void Vote();
  bool FindHeights();
  bool HighAround(double most) const;
  void FindLargestRegion();
  bool StepsAtOnce() const;
  Box RegionBounds() const;

  const Cell& At(int x, int y) const { return cells_[static_cast<std::size_t>(y * cols_ + x)]; }
  bool Chosen(int x, int y) const {
    return x >= 0 && y >= 0 && x < cols_ && y < rows_ &&
           chosen_[static_cast<std::size_t>(y * cols_ + x)] != 0;
  }

  cv::Rect area_;    ///< what is looked at: the box, its margin, and what is around
  cv::Rect search_;  ///< the box and its margin
  int cell_px_ = 0, cols_ = 0, rows_ = 0;
  std::vector<Cell> cells_;
  std::vector<std::uint8_t> chosen_;  ///< cells of the largest region
  double low_ = 0.0, high_ = 0.0;     ///< mean heights of the two kinds of cells, sigmas
  ElectedRegion region_;
  // Scratch.
  std::vector<int> best_;
  std::vector<std::uint8_t> mask_;
  LargestPart parts_;
};

/// About how many pixels of each label a box holds, from every fourth pixel of every fourth
/// row.
std::array<int, 256> CountLabels(const cv::Mat1b& labels, const Box& box_px);

}  // namespace slam

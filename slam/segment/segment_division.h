#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core/types.hpp>
#include <vector>

#include "slam/segment/depth_grid.h"
#include "slam/segment/extraction_config.h"
#include "slam/segment/label_runs.h"
#include "slam/segment/pixel_labels.h"
#include "slam/segment/seam_search.h"

namespace slam {

/// Divides segments in which depth steps along a straight line: side faces of things that lie
/// on each other. A slanted plane fits two of them within the noise of a pixel, and of a block,
/// but not within that of all their pixels.
///
/// Where residuals of neighbouring pixels, farther apart than errors are shared, are alike, the
/// best line is sought (seam_search.h), and the segment is divided there if the step is beyond
/// doubt, more than surfaces may differ by for other reasons than noise, and sudden
/// (seam_evidence.h). The parts are looked at again. The memory of one image serves the next.
class SegmentDivision {
 public:
  /// @param runs  of the segments
  /// @param sums  of the pixels of each segment; new segments follow
  /// @returns whether a segment was divided
  bool Divide(const DepthGrid& grid, const LabelRuns& runs, const PlaneExtractionConfig& config,
              std::vector<PlaneSums>& sums);

  /// Of the segments, once one was divided.
  const LabelRuns& runs() const { return runs_; }

 private:
  /// A segment.
  struct Part {
    LabelPlane plane;
    cv::Point low, high;  ///< bounds; `high` is outside
    int spacing_px = 0;   ///< of the pixels that are compared; 0 = too small to be divided
    /// Products of residuals of pixels a lag apart: about 0 each in a plane.
    double products = 0.0, pairs = 0.0;

    cv::Rect Bounds() const { return {low, high}; }
  };
  struct Residual {
    float sigmas = 0.0f;
    std::int16_t label = kNoLabel, row = -1;
  };

  static Part MakePart(const PlaneSums& sums, const cv::Rect& bounds,
                       const PlaneExtractionConfig& config);
  void Compare(const DepthGrid& grid, const LabelRuns& runs, double correlated_px);
  void CompareRun(const DepthGrid& grid, const LabelRun& run, int row, int lag_px, Part& part);
  bool IsAlike(const Part& part, double correlated_px) const;
  void MakeSmallCells(const DepthGrid& grid, int label, int step_px);
  void MakeLargeCells(const cv::Rect& bounds, int small_px);
  bool DivideOne(const DepthGrid& grid, const PlaneExtractionConfig& config, int label,
                 std::vector<PlaneSums>& sums);
  bool Cut(const DepthGrid& grid, const PlaneExtractionConfig& config, int label,
           const Seam& seam, std::vector<PlaneSums>& sums);

  LabelImage labels_;  ///< drawn once a segment is looked at
  LabelRuns runs_;
  std::vector<Part> parts_;
  std::vector<Residual> residuals_;  ///< of the last rows, one after the other
  std::vector<SeamCell> small_, large_;
  std::vector<int> large_at_;  ///< cell of each place
  std::vector<std::size_t> moved_;
  SeamSearch search_;
};

}  // namespace slam

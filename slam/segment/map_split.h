#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "slam/segment/depth_grid.h"
#include "slam/segment/elected_region.h"
#include "slam/segment/expected_plane.h"
#include "slam/segment/extraction_config.h"
#include "slam/segment/measured_segments.h"
#include "slam/segment/pixel_area.h"

namespace slam {

/// Finds a plane that the map knows inside a segment that holds it and another one.
///
/// The map says where a plane should be seen, and how far it is off another one of the map on
/// which the segment's pixels outside of the outline lie. Pixels within the outline that lie
/// nearer to it than to those outside, by the vote of what is around each, are its region if
///   - they lie off the plane of those outside beyond doubt (min_evidence_sigmas),
///   - by the map's step, and
///   - both are where the map expects them, but for one error of the pose (pose_sigma_m), which
///     may be larger than the step.
///
/// The memory of one search serves the next.
class MapSplit {
 public:
  /// Looks for `all[expected]` in a segment.
  /// @param labels  the segment's label is `host` + 1
  bool Find(const DepthGrid& grid, const cv::Mat1b& labels, int host, const Segment& segment,
            const std::vector<ExpectedPlane>& all, std::size_t expected,
            const PlaneExtractionConfig& config);

  /// Of the last search that found one.
  const ElectedRegion& region() const { return region_; }

 private:
  PlaneSums SumIn(const DepthGrid& grid, const cv::Mat1b& labels, int host,
                  const Segment& segment, const PixelArea& area) const;
  bool Elect(const DepthGrid& grid, const cv::Mat1b& labels, int host, const Segment& outside,
             const PlaneSums& inside, const Plane& sought_c, const Plane& other_c,
             const PlaneExtractionConfig& config);

  PixelArea core_, around_;  ///< surely and perhaps in the outline
  ElectedRegion region_;
};

/// About how many pixels of each label an area has, from every fourth pixel of every fourth
/// row.
std::array<int, 256> CountLabels(const cv::Mat1b& labels, const PixelArea& area);

}  // namespace slam

#pragma once

#include <memory>

#include "slam/model/frame.h"
#include "slam/segment/extraction_config.h"

namespace slam {

/// (B) of the paper for planes: segments the depth images of a camera into planes.
///
/// Blocks are clustered (BlockClustering), clusters that continue each other are joined
/// (surface_joining.h), planes, or local ones where the sensor bends a surface
/// (local_planes.h), grow over pixels (PixelGrowth), what is left or does not fit is clustered
/// with finer blocks, touching labels that continue each other are joined, cut-off parts are
/// reunited or separated (occluded_parts.h), and each segment is fitted to all its pixels.
///
/// What comes out does not depend on what came before.
///
/// Source: PEAC (Feng, Taguchi, Kamat, ICRA 2014), with changes for thin steps
/// (block_clusters.h).
class PlaneExtractor {
 public:
  /// @param rays  PixelRays of the camera
  PlaneExtractor(const cv::Mat2d& rays, const SensorModel& sensor,
                 const PlaneExtractionConfig& config);
  PlaneExtractor(PlaneExtractor&&) noexcept;
  PlaneExtractor& operator=(PlaneExtractor&&) noexcept;
  ~PlaneExtractor();

  /// Reads frame.depth_m; fills frame.planes (largest first, at most 254, without what faces/
  /// adds) and frame.plane_labels (index + 1, 0 = none). Never labels an unmeasured pixel.
  /// @throws std::invalid_argument if depth and rays differ in size.
  void Extract(Frame& frame);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> work_;
};

}  // namespace slam

#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "slam/segment/clusters/block_clusters.h"
#include "slam/segment/edges/outer_contours.h"
#include "slam/segment/growth/pixel_growth.h"
#include "slam/segment/joining/parts_on_blocks.h"
#include "slam/segment/joining/surface_joining.h"
#include "slam/segment/joining/surfaces.h"
#include "slam/segment/measured_segments.h"
#include "slam/segment/occluded_parts.h"
#include "slam/segment/plane_segments.h"

namespace slam {

/// What the extractor works with from frame to frame.
struct PlaneExtractor::Workspace {
  SensorModel sensor;
  PlaneExtractionConfig config;
  PlaneExtractionConfig here;  ///< the same, with what the sensor is seen to bend in the frame
  DepthGrid grid;
  BlockClustering clustering;
  ImageBlocks blocks;
  PixelGrowth growth;
  std::vector<PlaneSums> block_sums;  ///< sums of the measured pixels of each block
  PartsOnBlocks block_parts;
  LabelImage labels;
  LabelRuns runs;
  std::vector<Surface> surfaces;  ///< one a label
  std::vector<Segment> kept;
  OuterContours contours;

  void AddClusters(const BlockClusters& clusters, const JoinedLabels& joined);
  JoinedLabels JoinClusters(const BlockClusters& clusters);
  void JoinTouching();
  PartSegments SegmentBySteps();
  PartSegments SegmentAsPeac() const;
  void SamplePoints(const cv::Mat1b& drawn, std::vector<FramePlane>& planes);
  void Describe(Frame& frame);
};

}  // namespace slam

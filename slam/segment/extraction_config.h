#pragma once

#include <string>
#include <vector>

#include "slam/base/field_visitor.h"
#include "slam/geometry/sensor_model.h"
#include "slam/segment/clusters/cluster_config.h"
#include "slam/segment/edges/edge_config.h"
#include "slam/segment/growth/growth_config.h"
#include "slam/segment/joining/join_config.h"

namespace slam {

/// What divides a depth image into planes.
enum class Segmentation {
  kOurs,  ///< PlaneExtractor's steps
  kAhc    ///< PEAC as it was published (SegmentByAhc), to compare with
};

/// Names as in files and on the command line, in the order of the enumeration.
const std::vector<std::string>& SegmentationNames();

/// Settings of plane extraction. A length here is of the sensor or of the image, and every
/// threshold on a surface is in units of the noise.
struct PlaneExtractionConfig {
  Segmentation segmentation = Segmentation::kOurs;
  ClusterConfig coarse;
  ClusterConfig fine{.min_measured = 0.75, .max_block_error = 3.0, .min_blocks = 10};

  GrowthConfig growth;
  JoinConfig joining;
  double max_block_bias_sigmas = 3.0;

  double min_share = 1.0 / 512;  // of 640 x 480 600 pixels: at 1 m 47 x 47 mm seen frontally
  double max_angle_sigma_rad = 0.1;
  int min_island_pixels = 40;

  int point_grid_px = 6;
  EdgeConfig edges;  ///< for FramePlane::edge_points
};

inline void VisitFields(PlaneExtractionConfig& c, FieldVisitor& v) {
  v.Named("segmentation", c.segmentation, SegmentationNames(),
          "what divides a depth image into planes; ahc: PEAC as it was published, for which "
          "no other key before min_share counts");
  v.Section("coarse", "first clustering, of blocks of 8 x 8 pixels", c.coarse);
  v.Section("fine", "second clustering, of what the first one left, in blocks of 4 x 4",
            c.fine);
  v.Section("growth", "growth of regions from blocks to pixels", c.growth);
  v.Number(
      "max_block_bias_sigmas", c.max_block_bias_sigmas, "(0, inf)",
      "largest mean residual of a block, in standard errors beyond the model error; others "
      "are offered to the second clustering");
  v.Section("joining", "when parts are one surface", c.joining);
  v.Number("min_share", c.min_share, "[0, 1]", "smallest segment, as a share of the image");
  v.Degrees("max_angle_sigma_deg", c.max_angle_sigma_rad, "(0, 90)",
            "largest standard deviation of a segment's normal");
  v.Integer("min_island_pixels", c.min_island_pixels, "[1, 1000000]",
            "smallest cut-off piece of a segment that is kept");
  v.Integer("point_grid_px", c.point_grid_px, "[1, 64]",
            "spacing of the grid of pixels that give a plane's points");
}

/// The defaults for a sensor, where they follow from more than its noise.
PlaneExtractionConfig ExtractionFor(DepthSensor sensor);

}  // namespace slam

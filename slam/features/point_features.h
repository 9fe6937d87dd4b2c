#pragma once

#include <vector>

#include "slam/base/field_visitor.h"
#include "slam/features/point_depth.h"
#include "slam/geometry/camera.h"
#include "slam/model/feature_scale.h"
#include "slam/model/frame.h"

namespace slam {

/// What is taken for a point feature. Defaults: ORB-SLAM2's for 640 x 480.
struct PointFeatureConfig {
  int count = 1000;
  int fast_threshold = 20;
  int min_fast_threshold = 7;
  int cell_px = 30;
  FeatureScale scale;
  PointDepthConfig depth;
};

inline void VisitFields(PointFeatureConfig& c, FieldVisitor& v) {
  v.Integer("count", c.count, "[1, 10000]", "number of features wanted in an image, about");
  v.Integer("fast_threshold", c.fast_threshold, "[1, 254]",
            "FAST threshold, grey levels between a corner and its ring");
  v.Integer("min_fast_threshold", c.min_fast_threshold, "[1, 254]",
            "FAST threshold for cells in which the first one finds no corner; at most that");
  v.Integer("cell_px", c.cell_px, "[8, 1000]", "side of such a cell, pixels of its octave");
  v.Number("bf_px_m", c.scale.bf_px_m, "(0, inf)",
           "focal length times baseline of the virtual right camera, px m");
  v.Integer("octaves", c.scale.octaves, "[1, 16]", "number of octaves of the image pyramid");
  v.Number("octave_factor", c.scale.factor, "(1, 2]", "scale between neighbouring octaves");
  v.Number("close_baselines", c.scale.close_baselines, "(0, inf)",
           "a depth is trusted up to so many virtual baselines");
}

/// ORB features: FAST corners over a pyramid with two thresholds, spread evenly by quartering,
/// oriented by the intensity centroid, described by rotated BRIEF. Rublee et al. 2011; the
/// spread as in Mur-Artal and Tardos 2017.
///
/// @param gray  8-bit image as recorded (distorted), height x width of the camera
/// @returns features in the order octave, then row, then column; positions undistorted, without
///          depth (ReadDepths)
/// @throws std::invalid_argument when sizes differ.
/// Cost: about 6 ms for 640 x 480 and 1000 features.
std::vector<PointFeature> ExtractPointFeatures(const cv::Mat1b& gray, const Camera& camera,
                                               const PointFeatureConfig& config);

}  // namespace slam

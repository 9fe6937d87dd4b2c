#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "slam/geometry/camera.h"
#include "slam/geometry/pose.h"
#include "slam/model/detection.h"
#include "slam/model/frame_plane.h"

namespace slam {

using Descriptor = std::array<std::uint8_t, 32>;  ///< rotated BRIEF, 256 bits

/// An ORB feature. Position is of the ideal (undistorted) image.
struct PointFeature {
  Eigen::Vector2d u_px;      ///< undistorted
  int octave = 0;            ///< pyramid level, 0 the finest
  float angle_deg = 0.0f;    ///< orientation, [0, 360)
  double depth_m = 0.0;      ///< planar z at the feature; 0 = no measurement
  double right_u_px = -1.0;  ///< virtual right coordinate u - b f / z; < 0 without depth
  Descriptor descriptor{};
};

/// What was decided for a frame plane (formats.md, frame_planes.jsonl).
enum class PlaneDecision { kNone, kMatched, kNew };

/// No map point, no map plane.
inline constexpr int kNone = -1;

/// The decision on one frame plane, as it was made in its frame.
struct PlaneMatch {
  PlaneDecision decision = PlaneDecision::kNone;
  int map_plane = kNone;  ///< id of the map plane, when matched or new
  const char* by = "";    ///< the rule that decided: "parameters", "iou", "iou+ranksum", ...
};

/// One RGB-D frame on its way through the stages (A) to (F).
struct Frame {
  int index = 0;  ///< count of frames, from 0
  double timestamp_s = 0.0;

  // (A) input
  cv::Mat1b gray;     ///< 8-bit, as recorded (distorted)
  cv::Mat1f depth_m;  ///< planar z, metres; 0 = no measurement, never NaN

  // (B) extraction, (C) plane processing
  std::vector<PointFeature> features;
  std::vector<Detection> detections;
  std::vector<FramePlane> planes;
  cv::Mat1b plane_labels;  ///< index + 1 of the frame plane at each pixel; 0 = none

  // (D) association; parallel to `features` and `planes`
  std::vector<int> map_points;  ///< id of the matched map point, or kNone
  std::vector<PlaneMatch> plane_matches;

  // (E) optimisation
  Pose T_cw;
};

}  // namespace slam

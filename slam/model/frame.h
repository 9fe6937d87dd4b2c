#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "slam/base/index.h"
#include "slam/geometry/camera.h"
#include "slam/geometry/uncertain_pose.h"
#include "slam/model/detection.h"
#include "slam/model/frame_plane.h"

namespace slam {

using Descriptor = std::array<std::uint8_t, 32>;  ///< rotated BRIEF, 256 bits

/// An ORB feature. Position is of the ideal (undistorted) image.
struct PointFeature {
  Eigen::Vector2d u_px;        ///< undistorted
  int octave = 0;              ///< pyramid level, 0 the finest
  float angle_deg = 0.0f;      ///< orientation, [0, 360)
  double depth_m = 0.0;        ///< planar z at the feature; 0 = no measurement
  double depth_sigma_m = 0.0;  ///< its standard deviation, see WeighDepths
  bool on_edge = false;  ///< of a straight edge: along it, every patch looks like the next
  Descriptor descriptor{};
};

/// What was decided for a frame plane (formats.md, frame_planes.jsonl).
enum class PlaneDecision {
  kUnmatched,
  kMatched,  ///< it shows a landmark
  kTrial,    ///< it shows a candidate; written as "none"
  kNew       ///< it made its candidate a landmark
};

/// What settled the decision: between two surfaces that both came into question, the cue that
/// told them apart.
enum class MatchReason {
  kNothing,     ///< nothing of the map fits, or the plane was not asked for
  kParameters,  ///< normal and offset: nothing else lies there
  kOverlap,     ///< the runner-up's footprint lies elsewhere
  kClass,       ///< the runner-up's class belief speaks against it
  kBox,         ///< the runner-up's projected box lies farther from the detection's
  kRankTest,    ///< the runner-up's points are distributed otherwise
  kAmbiguous,   ///< two answers are too close, or the only one is in doubt: none is given
  kSplit        ///< the landmark that it was matched with turned out to be two
};

/// The decision on one frame plane, as it was made in its frame.
struct PlaneMatch {
  PlaneDecision decision = PlaneDecision::kUnmatched;
  int map_plane = kNone;  ///< id of the map plane, kNone when unmatched
  MatchReason reason = MatchReason::kNothing;

  bool ShowsLandmark() const {
    return decision == PlaneDecision::kMatched || decision == PlaneDecision::kNew;
  }
};

/// Two planes of a frame that lie side by side with a step between them.
struct FrameStep {
  int one = 0, other = 0;  ///< indices
  double step_m = 0.0;     ///< height of the one over the other
  double sigma_m = 0.0;    ///< its standard deviation, by the scatter of what was measured
};

/// A feature whose map point lies on a plane of the frame. It counts for as long as the feature has a map point.
struct PointPlaneMatch {
  int feature = 0;      ///< index
  int frame_plane = 0;  ///< index
};

/// What the depth sensor gave, before it was straightened and carried to where colour was taken.
struct DepthImage {
  cv::Mat1f depth_m;  ///< planar z, metres; 0 = no measurement
  cv::Mat1b labels;   ///< index + 1 of the frame plane found at each pixel; 0 = none
};

/// How a colour image was read, row by row, while the camera moved. The time of an image is that
/// of its middle row.
struct Readout {
  double taken_out_s = 0.0;  ///< from the first row to the last; as if it were none since
  Vector6d speed = Vector6d::Zero();  ///< that this was done with: UncertainSpeed::mean
  double sigma_s = 0.0;  ///< standard deviation of what is left, from the first row to the last

  bool empty() const { return taken_out_s == 0.0; }
  /// From the camera of the middle row to that of a row. @param share  Camera::RowShare
  Pose T_rc(double share) const { return Exp(share * taken_out_s * speed); }
};

/// One RGB-D frame on its way through the stages (A) to (F).
struct Frame {
  int index = 0;             ///< count of frames, from 0
  double timestamp_s = 0.0;  ///< when the colour image was taken

  // (A) input
  cv::Mat1b gray;     ///< 8-bit, as recorded (distorted)
  cv::Mat1f depth_m;  ///< planar z, metres; 0 = no measurement, never NaN
  DepthImage measured;
  double depth_late_s = 0.0;  ///< depth was measured so much later; negative: earlier
  UncertainSpeed speed;       ///< as the frames before say; once tracked, see CompensateMotion
  Readout readout;

  /// Turn from the colour camera to the depth camera, beyond what the recording says.
  Eigen::Matrix3d R_dc = Eigen::Matrix3d::Identity();

  /// From the camera of T_cw to the depth camera when depth was measured.
  Pose T_dc() const {
    return Pose{R_dc, Eigen::Vector3d::Zero()} * Exp(depth_late_s * speed.mean);
  }

  // (B) extraction, (C) plane processing
  std::vector<PointFeature> features;
  std::vector<Detection> detections;
  bool detector_asked = true;  ///< false: all boxes are carried over from an earlier frame
  std::vector<FramePlane> planes;
  cv::Mat1b plane_labels;   ///< index + 1 of the frame plane at each pixel of gray; 0 = none
  double bend_ratio = 0.0;  ///< what the sensor bends, root mean square, as a part of the depth

  // (D) association; parallel to `features` and `planes`
  std::vector<int> map_points;  ///< id of the matched map point, or kNone
  std::vector<PlaneMatch> plane_matches;
  std::vector<FrameStep> plane_steps;  ///< between planes that but for it could be one surface
  std::vector<PointPlaneMatch> point_planes;  ///< in the order of the features

  // (E) optimisation
  Pose T_cw;
  /// The same by the pixels of the points alone, whenever depth was measured; none where they do
  /// not say it.
  std::optional<Pose> T_cw_by_pixels;
  /// Where motion leads from the frame before; none after the camera was lost.
  std::optional<UncertainPose> prediction;
  /// From this camera to that of the frame tracked before it; none at the first.
  std::optional<Pose> T_lc;
  std::vector<MotionAxis> degenerate;  ///< directions that nothing in the frame observes
  /// What the frame's own measurements say of T_cw ...
  MotionEvidence evidence;
  /// ... and its covariance by these and the prediction; none where nothing is known of it.
  std::optional<Matrix6d> pose_covariance;
  /// That of the map which is seen, in the world, as if the camera went with it; see MapCovarianceAt.
  Matrix6d map_covariance = Matrix6d::Zero();

  /// Leaves it without a pose and without matches.
  void ForgetPose() {
    T_cw = Pose{};
    evidence = {};
    pose_covariance.reset();
    map_points.assign(features.size(), kNone);
    plane_matches.assign(planes.size(), {});
    plane_steps.clear();
  }
};

}  // namespace slam

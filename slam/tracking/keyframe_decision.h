#pragma once

#include "slam/base/field_visitor.h"
#include "slam/model/map.h"

namespace slam {

/// When a frame becomes a keyframe.
struct KeyframeDecisionConfig {
  double min_reference_ratio = 0.75;   // ORB-SLAM2
  double first_reference_ratio = 0.4;  // ORB-SLAM2
  int min_frames_between = 1;
  int min_close_tracked = 100;   // ORB-SLAM2
  int min_close_untracked = 70;  // ORB-SLAM2
  // 5 degrees: keyframes that share many points hold each other. Less is no clear gain and costs
  // time; measured: docs/points.md, "How many keyframes".
  double max_view_rad = 0.09;
  double max_new_ratio = 0.5;
};

inline void VisitFields(KeyframeDecisionConfig& c, FieldVisitor& v) {
  v.Number("min_reference_ratio", c.min_reference_ratio, "[0, 1]",
           "insert below this ratio of tracked points to the reference keyframe's good points");
  v.Number("first_reference_ratio", c.first_reference_ratio, "[0, 1]",
           "the same ratio while the map has one keyframe");
  v.Integer("min_frames_between", c.min_frames_between, "[1, 1000]",
            "frames from one keyframe to the next, at least");
  v.Integer("min_close_tracked", c.min_close_tracked, "[0, 100000]",
            "insert when fewer close points are tracked, among 1000 features, and ...");
  v.Integer("min_close_untracked", c.min_close_untracked, "[0, 100000]",
            "... more close features than this are not tracked");
  v.Number("max_view_rad", c.max_view_rad, "(0, 3.15)",
           "a point looks new when seen from more than this beside every keyframe");
  v.Number("max_new_ratio", c.max_new_ratio, "[0, 1]",
           "insert when more than this share of the tracked points looks new");
}

/// Numbers behind the decision.
struct KeyframeEvidence {
  int tracked = 0;           ///< matched points of the frame
  int reference_points = 0;  ///< points of the reference that are seen by enough keyframes
  int close_tracked = 0, close_untracked = 0;
  int new_looks = 0;  ///< tracked points that no keyframe has seen from nearly there
  bool wanted = false;
};

/// Whether the frame should be kept: it sees clearly less of the map than its reference
/// keyframe did, or it tracks few close points where there are many to be had, or it sees most
/// of what it tracks from a new side: from there no keyframe would know the place again.
/// @param close_m  depth up to which a point is close, see FeatureScale
KeyframeEvidence DecideKeyframe(const Frame& frame, const Map& map, int reference,
                                int frames_since_last, double close_m,
                                const KeyframeDecisionConfig& config);

/// Whether a frame should be kept whose pose planes hold, because it tracks too few points: it
/// follows many that the map does not know yet, made a landmark, or sees its planes from a new side or
/// place.
/// @param newest    the keyframe before
/// @param followed  features that agree with those of the frame before on one motion; corners
///                  of noise do not
bool KeepViewOfPlanes(const Frame& frame, const Keyframe& newest, int followed,
                      const KeyframeDecisionConfig& config);

}  // namespace slam

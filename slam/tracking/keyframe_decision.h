#pragma once

#include "slam/base/field_visitor.h"
#include "slam/model/map.h"

namespace slam {

/// When a frame becomes a keyframe.
struct KeyframeDecisionConfig {
  double min_reference_ratio =
      0.75;  ///< tracked over the reference's good points: below, insert
  double first_reference_ratio = 0.4;  ///< the same while the map has one keyframe
  int min_frames_between = 1;          ///< domain [1, inf)
  int min_close_tracked = 100;         ///< fewer tracked close points ...
  int min_close_untracked = 70;  ///< ... and more untracked ones: insert; of 1000 features
  double max_view_rad = 0.26;    ///< a point seen from more beside every keyframe looks new
  double max_new_ratio = 0.5;    ///< share of the tracked points that look new: above, insert
};

inline void VisitFields(KeyframeDecisionConfig& c, FieldVisitor& v) {
  v.Number("min_reference_ratio", c.min_reference_ratio, "[0, 1]",
           "tracked over the reference's points");
  v.Number("first_reference_ratio", c.first_reference_ratio, "[0, 1]",
           "the same with one keyframe");
  v.Integer("min_frames_between", c.min_frames_between, "[1, 1000]",
            "frames from one to the next");
  v.Integer("min_close_tracked", c.min_close_tracked, "[0, 100000]",
            "fewer tracked close points ...");
  v.Integer("min_close_untracked", c.min_close_untracked, "[0, 100000]",
            "... and more untracked: insert");
  v.Number("max_view_rad", c.max_view_rad, "(0, 3.15)",
           "a point seen from more beside every keyframe looks new");
  v.Number("max_new_ratio", c.max_new_ratio, "[0, 1]",
           "tracked points that look new over all: more, and insert");
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

}  // namespace slam

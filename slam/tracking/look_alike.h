#pragma once

#include <Eigen/Core>
#include <optional>

#include "slam/base/field_visitor.h"
#include "slam/model/map.h"

namespace slam {

/// How alike two places must look to be taken for each other.
struct LookAlikeConfig {
  int max_keyframes = 20;  // bounds the work
  int max_distance = 50;   // TH_LOW of ORB-SLAM2
  double min_shift_m = 0.1;
  double reach = 0.03;  // noise of depth and pose; more finds likenesses by chance
  int min_alike = 10;
  double min_share = 0.3;  // balances a false refusal against a camera a repeat away
};

inline void VisitFields(LookAlikeConfig& c, FieldVisitor& v) {
  v.Integer("max_keyframes", c.max_keyframes, "[1, 100000]",
            "keyframes of the map around whose points are compared");
  v.Integer("max_distance", c.max_distance, "[0, 256]",
            "largest number of differing bits of points that look alike");
  v.Number("min_shift_m", c.min_shift_m, "(0, inf)", "places nearer than this are the same");
  v.Number("reach", c.reach, "(0, 1)",
           "largest distance from a moved point to its likeness, as a share of its range");
  v.Integer("min_alike", c.min_alike, "[1, 100000]",
            "features that must find their likeness at the other place");
  v.Number("min_share", c.min_share, "(0, 1]",
           "share of the features that find any point there that must find their likeness");
}

/// A place from which the frame would look as it does.
struct LookAlike {
  Eigen::Vector3d shift_w;  ///< from where the frame is believed to be
  int alike = 0;            ///< matched features that find a point of their look there ...
  int met = 0;              ///< ... of those that find a point at all
};

/// Whether the camera could as well be elsewhere, turned as it is: on a pattern that repeats
/// itself a repeat away. Moves the frame's matched points along; the best place is where
/// the most of them meet points of their look. Points that meet nothing say nothing: the map
/// may end there.
/// @param frame  with its pose, and matches with the map
/// @returns the place that is most alike, when it is alike enough to be taken for this one
std::optional<LookAlike> FindLookAlike(const Frame& frame, const Map& map,
                                       const LookAlikeConfig& config);

}  // namespace slam

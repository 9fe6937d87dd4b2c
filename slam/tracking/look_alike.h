#pragma once

#include <Eigen/Core>
#include <optional>

#include "slam/base/field_visitor.h"
#include "slam/model/map.h"

namespace slam {

/// How alike two places must look to be taken for each other.
struct LookAlikeConfig {
  int max_keyframes = 20;    ///< of the map around, whose points are compared; domain [1, inf)
  int max_distance = 50;     ///< differing bits of points that look alike; domain [0, 256]
  double min_shift_m = 0.1;  ///< nearer than that it is the same place; domain (0, inf)
  // How far apart a moved point and its likeness may be: a part of the distance to the camera.
  double reach = 0.03;     ///< domain (0, 1)
  int min_alike = 10;      ///< features that find their likeness; domain [1, inf)
  double min_share = 0.3;  ///< ... of those that find any point there; domain (0, 1]
};

inline void VisitFields(LookAlikeConfig& c, FieldVisitor& v) {
  v.Integer("max_keyframes", c.max_keyframes, "[1, 100000]", "around, whose points compare");
  v.Integer("max_distance", c.max_distance, "[0, 256]", "bits by which points look alike");
  v.Number("min_shift_m", c.min_shift_m, "(0, inf)", "nearer is the same place");
  v.Number("reach", c.reach, "(0, 1)", "of a likeness, as a part of the distance");
  v.Integer("min_alike", c.min_alike, "[1, 100000]", "features that find their likeness");
  v.Number("min_share", c.min_share, "(0, 1]", "of those that find any point");
}

/// A place from which the frame would look as it does.
struct LookAlike {
  Eigen::Vector3d shift_w;  ///< from where the frame is held to be
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

#pragma once

#include <vector>

#include "slam/base/field_visitor.h"
#include "slam/geometry/uncertain_pose.h"
#include "slam/model/frame.h"
#include "slam/model/map.h"

namespace slam {

/// How a camera is found by the planes of a map alone.
struct PlanePlaceConfig {
  double max_angle_rad = 0.052;  // 3 degrees: noise and bend of a first Kinect's small planes
  double max_offset_m = 0.02;    // beside three sigmas of the plane's own
  double max_side_share = 0.03;  // of a face's length; its corners err by as much
  int max_checked = 24;          // bounds the work
  // Right places came to 5 planes, 0.63 and 0.975 or more; wrong ones of as many planes to 0.57 of
  // those that met 0.95 (docs/points.md).
  int min_planes = 5;
  double min_explained = 0.6;
  double min_met = 0.95;
  double max_second_best_ratio = 0.8;  // right places: 0.8 or less; balances wrong against none
};

inline void VisitFields(PlanePlaceConfig& c, FieldVisitor& v) {
  v.Degrees("max_angle_deg", c.max_angle_rad, "(0, 30)",
            "largest angle between a frame plane and the landmark that it shows");
  v.Number("max_offset_m", c.max_offset_m, "(0, 1)",
           "largest distance between them, beside three standard deviations of the plane's");
  v.Number("max_side_share", c.max_side_share, "(0, 1)",
           "sides of a face with four corners may differ from the landmark's by this share");
  v.Integer("max_checked", c.max_checked, "[1, 10000]",
            "poses held against the whole map and the depth image, at most");
  v.Integer("min_planes", c.min_planes, "[1, 100000]",
            "frame planes that must show landmarks, at least");
  v.Number("min_explained", c.min_explained, "(0, 1]",
           "share of the frame's planes that must show landmarks");
  v.Number("min_met", c.min_met, "(0, 1]",
           "share of the landmarks in view that must be where depth was measured");
  v.Number("max_second_best_ratio", c.max_second_best_ratio, "(0, 1]",
           "another place that fits this well, compared with the best, makes both doubtful");
}

/// A landmark, as the search for a camera needs it.
struct KnownPlane {
  Plane pi_w;
  Eigen::Vector3d centroid_w;
  double reach_m = 0.0;  ///< no part of it lies farther from its centroid
  double area_m2 = 0.0;
  const MapPlane* landmark = nullptr;  ///< of the map
};

/// The landmarks of a map, which must outlive them; candidates tell no place.
std::vector<KnownPlane> KnownPlanes(const Map& map);

/// Whether their classes allow that a frame plane shows a known plane: both are of the same, or one
/// has none.
bool ClassesAllow(const FramePlane& plane, const KnownPlane& known);

/// The known plane that is nearest to a frame plane among those that lie as it does and where it
/// lies, of a class that allows it: within the angle, thrice the offset, and the known plane's reach.
/// @returns null when there is none
const KnownPlane* NearestLike(const FramePlane& plane, const std::vector<KnownPlane>& known,
                              const Pose& T_cw, const PlanePlaceConfig& config);

/// What a frame plane weighs among the others: a desk more than a book, but not a hundred
/// times.
double Weight(const FramePlane& plane);

/// Poses at which planes of the frame would show landmarks, those of which the most do first: by
/// the angles between planes and the distances along each direction, and by faces with four
/// corners. No two are the same place.
std::vector<UncertainPose> GuessPlaces(const Frame& frame, const std::vector<KnownPlane>& known,
                                       const PlanePlaceConfig& config);

}  // namespace slam

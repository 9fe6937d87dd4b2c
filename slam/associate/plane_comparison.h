#pragma once

#include "slam/associate/association_config.h"
#include "slam/geometry/uncertain_pose.h"
#include "slam/model/frame_plane.h"
#include "slam/model/map_plane.h"

namespace slam {

/// Parameters of a frame plane against those of a map plane, with everybody's uncertainty.
struct PlaneComparison {
  double angle_rad = 0.0;  ///< between the oriented normals
  double offset_m = 0.0;   ///< height of the one over the other
  double offset_sigma_m = 0.0;
  double chi2 = 0.0;  ///< chi-square of offset and two slopes: 3 degrees of freedom
  /// Logarithm of their covariance's determinant; of a frame plane, over that of its own errors:
  /// how many times as much fits because map plane and pose are not known exactly.
  double log_spread = 0.0;
};

/// Compares where the patch is: height and slopes of the measured plane over the map plane at
/// the patch's centroid, weighted by the full covariance: sensor, fit, map plane *there*, and
/// pose. Extrapolating either plane to the other's centroid widens its uncertainty by the lever
/// arm, so measuring in both directions adds nothing that the slopes do not already say.
/// Source: PAS-SLAM eq6, eq7 (corrected as in plane_gates.h; weighted by uncertainty).
PlaneComparison ComparePlanes(const FramePlane& frame_plane, const MapPlane& map_plane,
                              const UncertainPose& pose, const AssociationConfig& config);

/// Two planes of one frame: no pose comes between, so millimetres count.
PlaneComparison ComparePlanes(const FramePlane& one, const FramePlane& other,
                              const AssociationConfig& config);

/// Two planes of the map, compared where `one` lies, by their estimates alone. Their chi-square is
/// the same from the other side, to first order in the angle between them.
PlaneComparison ComparePlanes(const MapPlane& one, const MapPlane& other);

}  // namespace slam

#pragma once

#include <vector>

#include "slam/geometry/camera.h"
#include "slam/model/frame.h"
#include "slam/model/map.h"

namespace slam {

/// How a map plane's cloud falls on the frame's plane segments.
struct PlaneView {
  int expected = 0;         ///< cloud points in the picture that nothing nearer hides
  std::vector<int> landed;  ///< by frame plane: how many of these fall on its pixels
  double cell_m2 = 0.0;     ///< area of the map plane that one cloud point stands for
};

/// Counts where the cloud of one map plane is seen from T_cw. Desk and book have disjoint
/// clouds however close they lie: what is under the book has never been seen. Cost:
/// O(points_w).
PlaneView ViewMapPlane(const MapPlane& map_plane, const Frame& frame, const Pose& T_cw,
                       const Camera& camera);

/// Share of the smaller of the two footprints that the other covers, both as seen now, in
/// [0, 1].
double Overlap(const PlaneView& view, const FramePlane& frame_plane);

/// Share of a frame plane that the map plane's cloud covers, [0, 1].
double Covered(const PlaneView& view, const FramePlane& frame_plane);

}  // namespace slam

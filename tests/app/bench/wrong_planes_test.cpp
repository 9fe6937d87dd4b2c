#include "app/bench/wrong_planes.h"

#include <gtest/gtest.h>

#include "tests/support/map_surfaces.h"

namespace app {
namespace {

/// A wall at this distance before the camera, and a frame plane that shows it.
slam::FramePlane WallAt(double z_m) {
  slam::FramePlane plane;
  plane.pi_c = {Eigen::Vector3d(0, 0, -1), z_m};
  plane.centroid_c = {0, 0, z_m};
  return plane;
}

TEST(WrongPlanes, TakeAPlaneForTheNearestParallelOneBeforeOrBehindIt) {
  for (const double sign : {-1.0, 1.0}) {
    slam::Map map;
    slam::Frame frame;
    for (const double off_m : {0.0, 0.1 * sign, -0.3 * sign}) {
      const slam::FramePlane wall = WallAt(1.0 + off_m);
      slam::MapPlane landmark;
      landmark.pi_w = wall.pi_c;
      frame.planes.push_back(wall);
      frame.plane_matches.push_back(
          {slam::PlaneDecision::kMatched, slam::AddLandmark(map, landmark)});
    }
    const int nearest = frame.plane_matches[1].map_plane;
    WrongPlanes all(1.0, 5);
    all(frame, map);
    EXPECT_EQ(all.matches(), 3);
    EXPECT_EQ(frame.plane_matches[0].map_plane, nearest) << sign;
  }
}

}  // namespace
}  // namespace app

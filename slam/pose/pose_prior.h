#pragma once

namespace slam {

/// What a pose that comes without a covariance is worth before the planes speak: standard
/// deviations per axis. That of a first Kinect at 1.5 m: what it bends moves the pose so far.
struct PosePrior {
  double sigma_m = 0.006;
  double sigma_rad = 0.004;  // 0.23 degrees
};

}  // namespace slam

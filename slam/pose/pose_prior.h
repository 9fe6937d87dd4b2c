#pragma once

namespace slam {

/// What a pose predicted by points is worth before the planes speak: standard deviations per
/// axis. Measured on simulated desks; real recordings drift more.
struct PosePrior {
  double sigma_m = 0.006;
  double sigma_rad = 0.004;  // 0.23 degrees
};

}  // namespace slam

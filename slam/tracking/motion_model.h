#pragma once

#include <optional>

#include "slam/geometry/pose.h"

namespace slam {

/// Constant velocity: the camera moves on as it moved between the last two frames.
class MotionModel {
 public:
  /// Tells the model where the camera was. Frames in between may be missing: time counts.
  void Observe(double timestamp_s, const Pose& T_cw);
  /// After the track was lost nothing is known of the speed.
  void Forget();
  /// The last pose was found to be another one (the map moved under it); the speed stays.
  void Correct(const Pose& T_cw);

  /// T_cw at a time as predicted from the last two poses; nullopt when fewer than two are known.
  std::optional<Pose> Predict(double timestamp_s) const;

 private:
  struct Known {
    double timestamp_s;
    Pose T_cw;
  };
  std::optional<Known> last_;
  std::optional<Vector6d> speed_;  ///< Log(T_cl) per second, l the frame before
};

}  // namespace slam

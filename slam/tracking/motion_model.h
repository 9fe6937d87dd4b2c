#pragma once

#include <optional>

#include "slam/geometry/pose.h"

namespace slam {

/// Constant velocity: the camera moves on as it moved between the last two frames.
class MotionModel {
 public:
  /// Tells the model where the camera was; frames in between may have been lost.
  void Observe(int frame_index, const Pose& T_cw);
  /// After the track was lost nothing is known of the speed.
  void Forget();
  /// The last pose was found to be another one (the map moved under it); the speed stays.
  void Correct(const Pose& T_cw);

  /// T_cw of a frame as predicted from the last two; nullopt when fewer than two are known.
  std::optional<Pose> Predict(int frame_index) const;

 private:
  struct Known {
    int frame_index;
    Pose T_cw;
  };
  std::optional<Known> last_;
  std::optional<Vector6d> speed_;  ///< Log(T_cl) per frame, l the frame before
};

}  // namespace slam

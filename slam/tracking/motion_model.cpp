#include "slam/tracking/motion_model.h"

#include "slam/base/require.h"

namespace slam {

void MotionModel::Observe(int frame_index, const Pose& T_cw) {
  if (last_) {
    const int frames = frame_index - last_->frame_index;
    Require(frames > 0, "MotionModel::Observe: frames must come in order");
    speed_ = Log(T_cw * Inverse(last_->T_cw)) / frames;
  }
  last_ = Known{frame_index, T_cw};
}

void MotionModel::Forget() {
  last_.reset();
  speed_.reset();
}

void MotionModel::Correct(const Pose& T_cw) {
  if (last_) last_->T_cw = T_cw;
}

std::optional<Pose> MotionModel::Predict(int frame_index) const {
  if (!speed_) return std::nullopt;
  const int frames = frame_index - last_->frame_index;
  return Normalised(Exp(frames * *speed_) * last_->T_cw);
}

}  // namespace slam

#include "slam/tracking/motion_model.h"

#include "slam/base/require.h"

namespace slam {

void MotionModel::Observe(double timestamp_s, const Pose& T_cw) {
  if (last_) {
    const double passed_s = timestamp_s - last_->timestamp_s;
    Require(passed_s > 0, "MotionModel::Observe: frames must come in order");
    speed_ = Log(T_cw * Inverse(last_->T_cw)) / passed_s;
  }
  last_ = Known{timestamp_s, T_cw};
}

void MotionModel::Forget() {
  last_.reset();
  speed_.reset();
}

void MotionModel::Correct(const Pose& T_cw) {
  if (last_) last_->T_cw = T_cw;
}

std::optional<Pose> MotionModel::Predict(double timestamp_s) const {
  if (!speed_) return std::nullopt;
  return Normalised(Exp((timestamp_s - last_->timestamp_s) * *speed_) * last_->T_cw);
}

}  // namespace slam

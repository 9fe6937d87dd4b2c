#pragma once

#include <optional>

#include "slam/base/field_visitor.h"
#include "slam/geometry/uncertain_pose.h"

namespace slam {

/// How a camera is moved by hand.
struct MotionFilterConfig {
  // TUM's fr1/xyz, by its truth 100 times a second (MotionFilter.KnowsARealHand): 0.2 m/s and 11
  // degrees/s by axis, of which the frames before leave 0.02 m/s and 10 degrees/s unknown. Others of
  // its recordings turn faster.
  double speed_mps = 0.25;
  double turn_rad_per_s = 0.7;  // 40 degrees/s
  double memory_s = 2.0;
  // 28 seconds of one open step: what else is known of the pose is exact all the while, and once the
  // step is seen again what was mapped meanwhile is moved (slam/places/close_gap).
  double max_sigma_m = 2.5;
  double max_sigma_rad = 0.17;  // 10 degrees
};

inline void VisitFields(MotionFilterConfig& c, FieldVisitor& v) {
  v.Number("speed_mps", c.speed_mps, "(0, inf)",
           "standard deviation of the camera's speed, by axis, m/s");
  v.Degrees("turn_deg_per_s", c.turn_rad_per_s, "(0, 3600)",
            "standard deviation of the rate of turning, by axis, degrees/s");
  v.Number("memory_s", c.memory_s, "(0, inf)",
           "time after which the camera's speed is forgotten, seconds");
  v.Number("max_sigma_m", c.max_sigma_m, "(0, inf)",
           "standard deviation of a position by planes and motion beyond which the camera is "
           "lost");
  v.Degrees("max_sigma_deg", c.max_sigma_rad, "(0, 90)", "the same for its rotation");
}

/// Whether a pose with this covariance is known well enough to go on from.
bool IsKnownWell(const Matrix6d& covariance, const MotionFilterConfig& config);

/// How a camera moved in the frame that its path begins with.
struct StartSpeed {
  double timestamp_s = 0.0;
  UncertainSpeed speed;
};

/// Where a camera can be when nothing is seen of it: pose and speed with their covariance. The
/// speed forgets itself (Ornstein and Uhlenbeck), so that a direction that nothing observes
/// comes to rest and grows ever more uncertain, and does not run away.
///
/// What goes in and comes out is in the camera's axes; within, speeds and covariances are in the
/// world's. There a step that nothing observes stays the same one while the camera turns; carried along
/// with the camera it would seem to be observed.
class MotionFilter {
 public:
  explicit MotionFilter(const MotionFilterConfig& config) : config_(config) {}

  /// The pose at a later time, with its covariance; nullopt before the first Observe, and at no
  /// later time.
  std::optional<UncertainPose> Predict(double timestamp_s) const;

  /// The path begins so: nothing before its first frame tells how that one moves, but another who
  /// followed the same path may know. Before the first Observe.
  void StartAt(const StartSpeed& start) { start_ = start; }
  /// The speed in the first frame observed, as the second one told it; none before that, or where
  /// the camera was lost in between.
  const std::optional<StartSpeed>& at_start() const { return at_start_; }

  /// The speed at a later time; at rest, as steadily as a hand is, when nothing is known.
  UncertainSpeed Speed(double timestamp_s) const;

  /// The speed at a later time, by where the camera is found to be then; none before the first
  /// Observe, and at no later time.
  std::optional<SpeedByPose> SpeedAt(double timestamp_s) const;

  /// Takes over the pose of a frame that came after the ones before.
  /// @param evidence  by what was measured in the frame, without the prediction; singular where
  ///                  nothing was
  void Observe(double timestamp_s, const Pose& T_cw, const MotionEvidence& evidence);

  /// The world was moved under the camera: pose and nothing else changes.
  void Correct(const Pose& T_cw);
  /// Nothing is known any more.
  void Forget() { known_.reset(); }

 private:
  using Matrix12d = Eigen::Matrix<double, 12, 12>;
  struct State {
    double timestamp_s = 0.0;
    Pose T_cw;
    Vector6d speed_w = Vector6d::Zero();         ///< of xi, a second, in the world's axes
    Matrix12d covariance_w = Matrix12d::Zero();  ///< of pose and speed, likewise

    Vector6d Speed() const;        ///< in the camera's axes
    Matrix12d Covariance() const;  ///< likewise
    void SetSpeed(const Vector6d& speed);
  };
  State At(double timestamp_s) const;
  static SpeedByPose SpeedOf(const State& predicted);
  /// Of a speed of which nothing is known.
  Matrix6d SpeedCovariance() const {
    return IsotropicCovariance(config_.speed_mps, config_.turn_rad_per_s);
  }

  MotionFilterConfig config_;
  std::optional<State> known_;
  std::optional<StartSpeed> start_;     ///< given
  std::optional<double> first_s_;       ///< time of the first frame observed
  std::optional<StartSpeed> at_start_;  ///< found
};

}  // namespace slam

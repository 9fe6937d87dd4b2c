#include "eval/trajectory/score_consistency.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "eval/formats/stamps.h"
#include "eval/trajectory/pairs.h"

namespace eval {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;

/// xi of E = Exp(xi), to first order.
Vector6d ErrorOf(const Pose& E) {
  const Eigen::AngleAxisd turn(E.R);
  Vector6d xi;
  xi << E.t, turn.angle() * turn.axis();
  return xi;
}

/// Takes xi of the frame b to that of the frame a: T_ab Exp(xi_b) = Exp(adjoint xi_b) T_ab.
Matrix6d Adjoint(const Pose& T_ab) {
  Eigen::Matrix3d hat;
  hat << 0, -T_ab.t.z(), T_ab.t.y(), T_ab.t.z(), 0, -T_ab.t.x(), -T_ab.t.y(), T_ab.t.x(), 0;
  Matrix6d adjoint = Matrix6d::Zero();
  adjoint.topLeftCorner<3, 3>() = adjoint.bottomRightCorner<3, 3>() = T_ab.R;
  adjoint.topRightCorner<3, 3>() = hat * T_ab.R;
  return adjoint;
}

/// Sums up errors and their covariances.
class Claims {
 public:
  void Add(const Vector6d& e, const Matrix6d& C) {
    const auto position = NeesOf<3>(e.head<3>(), C.topLeftCorner<3, 3>());
    const auto rotation = NeesOf<3>(e.tail<3>(), C.bottomRightCorner<3, 3>());
    const auto pose = NeesOf<6>(e, C);
    if (!position || !rotation || !pose) return;
    position_.push_back(*position);
    rotation_.push_back(*rotation);
    pose_.push_back(*pose);
    // The largest ratio of error and standard deviation over all directions is the NEES' root.
    silent_ += std::max(*position, *rotation) > kSilentSigmas * kSilentSigmas ? 1 : 0;
  }

  std::optional<ClaimScore> Score() const {
    if (pose_.empty()) return std::nullopt;
    return ClaimScore{pose_.size(), NeesOver(position_, kBandOf3),
                      NeesOver(rotation_, kBandOf3), NeesOver(pose_, kBandOf6), silent_};
  }

 private:
  std::vector<double> position_, rotation_, pose_;
  std::size_t silent_ = 0;
};

std::optional<ClaimScore> ScoreAbsolute(const std::vector<ClaimedPose>& poses,
                                        const Alignment& gauge) {
  Claims claims;
  for (const ClaimedPose& pose : poses)
    claims.Add(ErrorOf(Inverse(gauge * pose.T_wc) * pose.T_gc), pose.covariance);
  return claims.Score();
}

std::optional<ClaimScore> ScoreRelative(const std::vector<ClaimedPose>& poses,
                                        const std::vector<PosePair>& pairs) {
  Claims claims;
  for (const auto& [i, j] : pairs) {
    const ClaimedPose &a = poses[i], &b = poses[j];
    const Pose T_ba = Inverse(b.T_wc) * a.T_wc;
    const Matrix6d adjoint = Adjoint(T_ba);
    claims.Add(ErrorOf(T_ba * (Inverse(a.T_gc) * b.T_gc)),
               b.covariance + adjoint * a.covariance * adjoint.transpose());
  }
  return claims.Score();
}

}  // namespace

ConsistencyScore ScoreConsistency(const std::vector<ClaimedPose>& poses,
                                  const std::optional<Alignment>& gauge, double half_frame_s) {
  ConsistencyScore score;
  if (gauge) score.absolute = ScoreAbsolute(poses, *gauge);
  const std::vector<PosePair> pairs = PairsByTime(StampsOf(poses), kClaimTime_s, half_frame_s);
  score.relative = ScoreRelative(poses, pairs);
  if (!score.absolute) {
    score.no_absolute = poses.empty() ? "no pose with a covariance has a true pose of its time"
                        : gauge       ? "no covariance is regular"
                                      : "the rotations of run and truth contradict each other";
  }
  if (!score.relative) {
    score.no_relative = pairs.empty() ? "no two matched poses with a covariance are 1 s apart"
                                      : "no covariance of two poses 1 s apart is regular";
  }
  return score;
}

}  // namespace eval

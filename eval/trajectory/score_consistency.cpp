#include "eval/trajectory/score_consistency.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "eval/trajectory/pairs.h"
#include "eval/trajectory/statistics.h"

namespace eval {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;

/// The middle 95 % of chi-square.
struct Band {
  double low, high;
};
constexpr Band kBandOf3{0.2157953, 9.3484036};
constexpr Band kBandOf6{1.2373442, 14.4493753};

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

/// e^T C^-1 e; nothing where the covariance is singular.
template <int kSize>
std::optional<double> NeesOf(const Eigen::Matrix<double, kSize, 1>& e,
                             const Eigen::Matrix<double, kSize, kSize>& C) {
  const Eigen::LLT<Eigen::Matrix<double, kSize, kSize>> root(C);
  if (root.info() != Eigen::Success) return std::nullopt;
  const double nees = root.matrixL().solve(e).squaredNorm();
  return std::isfinite(nees) ? std::optional(nees) : std::nullopt;
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
    return ClaimScore{pose_.size(), Of(position_, kBandOf3), Of(rotation_, kBandOf3),
                      Of(pose_, kBandOf6), silent_};
  }

 private:
  static Nees Of(const std::vector<double>& values, const Band& band) {
    const auto described = Describe(values);
    const double n = static_cast<double>(values.size());
    const auto above = std::count_if(values.begin(), values.end(),
                                     [&](double value) { return value > band.high; });
    const auto below = std::count_if(values.begin(), values.end(),
                                     [&](double value) { return value < band.low; });
    return {described->mean, described->median, 1.0 - static_cast<double>(above + below) / n,
            static_cast<double>(above) / n};
  }

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
                                        double half_frame_s) {
  std::vector<double> stamps_s;
  stamps_s.reserve(poses.size());
  for (const ClaimedPose& pose : poses) stamps_s.push_back(pose.stamp_s);
  Claims claims;
  for (const auto& [i, j] : PairsByTime(stamps_s, kClaimTime_s, half_frame_s)) {
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
  score.relative = ScoreRelative(poses, half_frame_s);
  if (!score.absolute) {
    score.no_absolute = poses.empty() ? "no pose with a covariance has a true pose of its time"
                        : gauge       ? "no covariance is regular"
                                      : "the rotations of run and truth contradict each other";
  }
  if (!score.relative) {
    score.no_relative = "no two matched poses with a covariance are 1 s apart";
  }
  return score;
}

}  // namespace eval

#include "slam/calibrate/rolling_learner.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "slam/base/chi_square.h"
#include "slam/base/index.h"

namespace slam {
namespace {

constexpr int kMinPoints = 50;            // of a frame: a pose and more
constexpr double kEpochSigma_s = 0.003;   // by the noise of features alone: an epoch
constexpr std::size_t kFewestEpochs = 3;  // then it is known
constexpr std::size_t kEpochs = 20;       // by the last of them
constexpr double kLeast_s = 0.003;        // moves no feature by a pixel at a radian a second
// Points of a frame share the map's errors: epochs of simulated recordings scatter so.
constexpr double kUsualScatter_s = 0.01;

/// How fast the row moves a point, as the camera of the middle row sees it: metres a second of
/// reading the whole image.
Eigen::Vector3d RowMotion(const Camera& camera, const Readout& readout,
                          const Eigen::Vector3d& x_c) {
  const double share = camera.RowShare(camera.ProjectDistorted(x_c).y());
  return share * (readout.speed.head<3>() + readout.speed.tail<3>().cross(x_c));
}

/// What the row has done to a point here, less what rows did in the mean of the keyframes that made it.
struct RowShift {
  Eigen::Vector3d per_s;      ///< for each second of reading, metres a second
  Eigen::Vector3d taken_out;  ///< as much of it as was taken out, metres
};
RowShift RowShiftOf(const MapPoint& point, const Eigen::Vector3d& x_c, const Frame& frame,
                    const Map& map, const Camera& camera) {
  const Eigen::Vector3d here = RowMotion(camera, frame.readout, x_c);
  Eigen::Vector3d motion = Eigen::Vector3d::Zero(), taken = Eigen::Vector3d::Zero();
  for (const auto& [id, unused] : point.observations) {
    const Keyframe& keyframe = map.keyframes[Index(id)];
    const Eigen::Vector3d x_k = keyframe.T_cw * point.p_w;
    if (!(x_k.z() > kMinVisibleDepth_m)) continue;
    const Eigen::Vector3d there =
        frame.T_cw.R * (keyframe.T_cw.R.transpose() * RowMotion(camera, keyframe.readout, x_k));
    motion += there, taken += keyframe.readout.taken_out_s * there;
  }
  const auto views = static_cast<double>(point.observations.size());
  return {here - motion / views, frame.readout.taken_out_s * here - taken / views};
}

}  // namespace

RollingLearner::RollingLearner(const Camera& camera, const FeatureScale& scale,
                               const RollingConfig& config)
    : camera_(camera), scale_(scale), config_(config) {}

Readout RollingLearner::ReadoutAt(const Vector6d& speed) const {
  if (!config_.learn) return {0.0, speed};
  return {estimate_ ? estimate_->applied_s : 0.0, speed,
          estimate_ ? estimate_->sigma_s : config_.usual_s};
}

std::optional<RollingLearner::Evidence> RollingLearner::EvidenceOf(const Frame& frame,
                                                                   const Map& map) const {
  // Normal equations of the pose's six numbers and the time.
  using Matrix7d = Eigen::Matrix<double, 7, 7>;
  using Vector7d = Eigen::Matrix<double, 7, 1>;
  Matrix7d H = Matrix7d::Zero();
  Vector7d b = Vector7d::Zero();
  int points = 0;
  for (std::size_t i = 0; i < frame.features.size(); ++i) {
    if (frame.map_points[i] == kNone) continue;
    const MapPoint& point = map.points[Index(frame.map_points[i])];
    const Eigen::Vector3d x_c = frame.T_cw * point.p_w;
    if (point.observations.empty() || !(x_c.z() > kMinVisibleDepth_m)) continue;
    const PointFeature& feature = frame.features[i];
    const double weight = 1.0 / scale_.Variance(feature.octave);
    const Eigen::Vector2d off_px = feature.u_px - camera_.Project(x_c);
    if (!(weight * off_px.squaredNorm() < kChi2Of2At95)) continue;

    const RowShift shift = RowShiftOf(point, x_c, frame, map, camera_);
    Eigen::Matrix<double, 2, 3> by_x;
    by_x << camera_.fx, 0, -camera_.fx * x_c.x() / x_c.z(), 0, camera_.fy,
        -camera_.fy * x_c.y() / x_c.z();
    by_x /= x_c.z();
    Eigen::Matrix<double, 2, 7> A;
    A << by_x, -by_x * Hat(x_c), by_x * shift.per_s;
    H += weight * A.transpose() * A;
    b += weight * A.transpose() * (off_px + by_x * shift.taken_out);
    ++points;
  }
  if (points < kMinPoints) return std::nullopt;

  // The pose is left over to the points.
  const Eigen::LDLT<Matrix6d> pose(H.topLeftCorner<6, 6>());
  const Vector6d shared = pose.solve(H.topRightCorner<6, 1>());
  return Evidence{H(6, 6) - shared.dot(H.topRightCorner<6, 1>()),
                  b(6) - shared.dot(b.head<6>())};
}

void RollingLearner::CloseEpoch() {
  // Older ones were seen with a map that knew less of it.
  if (epochs_.size() == kEpochs) epochs_.erase(epochs_.begin());
  epochs_.push_back(epoch_);
  epoch_ = {};
  if (epochs_.size() < kFewestEpochs) return;
  Evidence all;
  for (const Evidence& epoch : epochs_) {
    all.information += epoch.information;
    all.weighted_s += epoch.weighted_s;
  }
  // Epochs count alike, nearly: each ends when it has enough.
  double scatter2 = kUsualScatter_s * kUsualScatter_s;
  for (const Evidence& epoch : epochs_) scatter2 += std::pow(epoch.read_s() - all.read_s(), 2);
  const auto n = static_cast<double>(epochs_.size());
  RollingEstimate now;
  now.read_s = all.read_s();
  now.sigma_s = std::sqrt(scatter2) / n;
  now.epochs = static_cast<int>(epochs_.size());
  const double usual2 = config_.usual_s * config_.usual_s;
  if (std::abs(now.read_s) > kLeast_s)
    now.applied_s = now.read_s * usual2 / (usual2 + now.sigma_s * now.sigma_s);
  estimate_ = now;
}

void RollingLearner::Learn(const Frame& frame, const Map& map) {
  if (!config_.learn || held_) return;
  const auto evidence = EvidenceOf(frame, map);
  if (!evidence || !(evidence->information > 0.0)) return;
  epoch_.information += evidence->information;
  epoch_.weighted_s += evidence->weighted_s;
  if (epoch_.information * kEpochSigma_s * kEpochSigma_s > 1.0) CloseEpoch();
}

}  // namespace slam

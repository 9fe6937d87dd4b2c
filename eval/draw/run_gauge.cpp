#include "eval/draw/run_gauge.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "eval/trajectory/alignment.h"
#include "eval/trajectory/match_stamps.h"

namespace eval {
namespace {

/// A plane can be what things stand on if its normal is so near to the camera's up: cameras
/// look down by up to 70 degrees, and a wall's normal is level.
constexpr double kMinUp_cos = 0.3;
/// Without a level plane the z axis of a truth is up if the camera agrees within 60 degrees.
constexpr double kMinUpright_cos = 0.5;
/// A truth's z axis that is up agrees with the normal of floor or desk within 15 degrees.
constexpr double kMinLevel_cos = 0.966;

/// Mean direction of the camera's up, -y, in the world of the run.
Eigen::Vector3d MeanUp(const Trajectory& trajectory) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const StampedPose& pose : trajectory) sum -= pose.T_wc.R.col(1);
  constexpr double kMinShare = 0.1;  // of unit length: a camera that tumbles has no up
  if (sum.norm() > kMinShare * static_cast<double>(trajectory.size())) return sum.normalized();
  return trajectory.empty() ? -Eigen::Vector3d::UnitY()
                            : Eigen::Vector3d(-trajectory.front().T_wc.R.col(1));
}

/// The large, often seen plane that things stand on: floor or desk. Null if there is none.
const RunMapPlane* MainLevelPlane(const std::vector<RunMapPlane>& map,
                                  const Eigen::Vector3d& up_w) {
  const RunMapPlane* main = nullptr;
  double most = 0;
  for (const RunMapPlane& plane : map) {
    const double weight = plane.area_m2 * std::max(plane.observations, 1);
    if (plane.merged_into || !(plane.pi_w.n.dot(up_w) > kMinUp_cos) || !(weight > most))
      continue;
    most = weight;
    main = &plane;
  }
  return main;
}

bool StandsUpright(const Pose& T_gw, const RunMapPlane* floor, const Eigen::Vector3d& up_w) {
  if (floor != nullptr) return (T_gw.R * floor->pi_w.n).z() > kMinLevel_cos;
  return (T_gw.R * up_w).z() > kMinUpright_cos;
}

}  // namespace

std::optional<Pose> AlignByPoses(const Trajectory& run, const Trajectory& truth,
                                 bool synthetic) {
  const std::vector<StampMatch> matches =
      synthetic ? MatchEqual(truth, run) : MatchNearest(truth, run);
  std::vector<Pose> T_wc, T_gc;
  for (const StampMatch& match : matches) {
    T_wc.push_back(run[match.estimate].T_wc);
    T_gc.push_back(truth[match.truth].T_wc);
  }
  const auto alignment = AlignByPoses(T_wc, T_gc);
  return alignment ? std::optional(alignment->T_gw) : std::nullopt;
}

MapGauge ChooseMapGauge(const Run& run, const Sequence& sequence) {
  MapGauge gauge;
  if (sequence.groundtruth) {
    const auto T_gw = AlignByPoses(run.trajectory, *sequence.groundtruth, sequence.synthetic);
    if (T_gw) gauge = {*T_gw, Pose{}, true, false};
  }
  const Eigen::Vector3d up_w = MeanUp(run.trajectory);
  const RunMapPlane* floor = MainLevelPlane(run.map, up_w);
  if (gauge.on_truth && (sequence.synthetic || StandsUpright(gauge.T_vw, floor, up_w))) {
    return gauge;
  }
  Pose T_turn;
  const Eigen::Vector3d up_v = gauge.T_vw.R * (floor == nullptr ? up_w : floor->pi_w.n);
  T_turn.R =
      Eigen::Quaterniond::FromTwoVectors(up_v, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return {T_turn * gauge.T_vw, T_turn, gauge.on_truth, floor != nullptr};
}

}  // namespace eval

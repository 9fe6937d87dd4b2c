#include "eval/draw/run_gauge.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "eval/trajectory/alignment.h"
#include "eval/trajectory/match_stamps.h"

namespace eval {

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
  if (sequence.groundtruth) {
    const auto T_gw = AlignByPoses(run.trajectory, *sequence.groundtruth, sequence.synthetic);
    if (T_gw) return {*T_gw, true};
  }
  const auto largest = std::max_element(
      run.map.begin(), run.map.end(),
      [](const RunMapPlane& a, const RunMapPlane& b) { return a.area_m2 < b.area_m2; });
  if (largest == run.map.end()) {
    // No plane tells where up is: the first camera does, whose y axis points down.
    Pose T_vw;
    if (!run.trajectory.empty()) {
      const Eigen::Vector3d up = -run.trajectory.front().T_wc.R.col(1);
      T_vw.R =
          Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    }
    return {T_vw, false};
  }
  Pose T_vw;
  T_vw.R = Eigen::Quaterniond::FromTwoVectors(largest->pi_w.n, Eigen::Vector3d::UnitZ())
               .toRotationMatrix();
  return {T_vw, false};
}

const RunMapPlane* FinalPlane(const std::vector<RunMapPlane>& map, int id) {
  const RunMapPlane* plane = nullptr;
  for (std::size_t steps = 0; steps <= map.size(); ++steps) {
    const auto found = std::find_if(map.begin(), map.end(),
                                    [&](const RunMapPlane& other) { return other.id == id; });
    if (found == map.end()) return plane;
    plane = &*found;
    if (!found->merged_into) return plane;
    id = *found->merged_into;
  }
  return plane;
}

}  // namespace eval

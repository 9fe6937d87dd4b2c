#pragma once

#include "eval/formats/run/run.h"
#include "eval/formats/sequence/sequence.h"

namespace eval {

/// Rigid motion that lays a run on the truth, from whole poses of the same time, as the map is
/// scored.
/// @returns nothing when no pose has a truth of the same time
std::optional<Pose> AlignByPoses(const Trajectory& run, const Trajectory& truth,
                                 bool synthetic);

/// Frame v in which maps are drawn: z up, metres.
struct MapGauge {
  Pose T_vw;              ///< world of the run to v
  Pose T_vg;              ///< world of the truth to v; only where `on_truth`
  bool on_truth = false;  ///< the run is laid on the truth
  bool levelled = false;  ///< v is turned until the main level plane lies level
};

/// v is the world of the truth where that has its z axis up: a simulator's has, and a
/// recording's if the map has a plane that is level in it. Else v is turned until the most
/// seen large plane below the camera (its normal within 72 degrees of the camera's up) lies
/// level; without one, until the camera stands upright in the mean.
MapGauge ChooseMapGauge(const Run& run, const Sequence& sequence);

}  // namespace eval

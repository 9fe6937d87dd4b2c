#pragma once

#include "eval/formats/run.h"
#include "eval/formats/sequence.h"

namespace eval {

/// Rigid motion that lays a run on the truth, from whole poses of the same time, as the map is
/// scored.
/// @returns nothing when no pose has a truth of the same time
std::optional<Pose> AlignByPoses(const Trajectory& run, const Trajectory& truth,
                                 bool synthetic);

/// Frame v in which maps are drawn: z up, metres.
struct MapGauge {
  Pose T_vw;              ///< world of the run to v
  bool on_truth = false;  ///< v is the world of the truth
};

/// v is the world of the truth when there is one, else the run turned until its largest plane
/// lies level with its front up.
MapGauge ChooseMapGauge(const Run& run, const Sequence& sequence);

/// The plane a map plane ended up in.
const RunMapPlane* FinalPlane(const std::vector<RunMapPlane>& map, int id);

}  // namespace eval

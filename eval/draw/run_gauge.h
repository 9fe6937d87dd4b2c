#pragma once

#include "eval/formats/run.h"
#include "eval/formats/sequence.h"

namespace eval {

/// Rigid motion that lays a run on the truth, from whole poses: the rotation nearest to the sum
/// of R_gc R_wc^T, then the mean offset of positions. Unlike an alignment of positions alone it
/// holds for short and straight paths, and it does not tilt the map to please the path.
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

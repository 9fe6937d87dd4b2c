#pragma once

#include "slam/associate/association_config.h"
#include "slam/mapping/plane_map_config.h"
#include "slam/model/frame.h"
#include "slam/model/map.h"

namespace slam {

/// Splits landmarks that turn out to hold two surfaces.
///
/// Where a frame shows two planes of one landmark with a step between them, the lesser one goes
/// on trial as a part of it (MapPlane::parts), and later frames are counted for or against. A
/// part becomes a landmark of its own when
/// - it is as large and was seen as often as a candidate must be (plane_trial.h);
/// - most of the frames that showed it and more of the landmark showed the step;
/// - the step, over all of them, is certain beyond what the sensor bends;
/// - part and rest, each as these frames measured it, do not agree within their uncertainty, and
///   the higher one is higher at the step.
/// The last two are needed both: the depth of a flat desk may have a sharp edge, and its far ends
/// need not fit each other, but what is bent seldom does both in the same place.
///
/// The id stays with the larger of the two; the other gets a new one, `split_from`, and the
/// decision `kNew` for the plane of the frame that shows it. Two such landmarks are never fused.
/// Run once a frame, at the final frame.T_cw, when its planes have been observed.
/// @returns the number of landmarks split
int SplitPlanes(Frame& frame, Map& map, const Camera& camera,
                const AssociationConfig& association, const PlaneMapConfig& config);

}  // namespace slam

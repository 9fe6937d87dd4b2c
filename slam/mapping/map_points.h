#pragma once

#include "slam/base/field_visitor.h"
#include "slam/model/feature_scale.h"
#include "slam/model/map.h"

namespace slam {

/// A new point seen by one keyframe's feature, which must have none yet. @returns its id.
int AddPoint(Map& map, const Eigen::Vector3d& p_w, int keyframe, int feature,
             const FeatureScale& scale);

/// Notes that `keyframe` sees `point` at `feature`, in both of them. Does nothing when the
/// keyframe sees it already or the feature has another point.
void AddObservation(Map& map, int point, int keyframe, int feature);

/// Takes the observation back, from both; a point with too little left is culled: one
/// keyframe's view is not enough.
void RemoveObservation(Map& map, int point, int keyframe);

/// Takes the point out of the map; its id stays.
void CullPoint(Map& map, int point);

/// Fuses `point` into `into`, which takes its observations over.
void ReplacePoint(Map& map, int point, int into);

/// Evidence in a point's observations: 2 for each with depth, 1 for each without.
int ObservationWeight(const Map& map, int point);

/// Sets descriptor (the one with the least median distance to the others), mean viewing
/// direction and range of distances from the observations.
void UpdatePoint(Map& map, int point, const FeatureScale& scale);

/// Rules by which young points prove themselves.
struct PointCullingConfig {
  // Mur-Artal, Montiel, Tardos 2015.
  double min_found_ratio = 0.25;
  int trial_keyframes = 3;
  int min_weight = 4;  // two keyframes that see it with depth
};

inline void VisitFields(PointCullingConfig& c, FieldVisitor& v) {
  v.Number("min_found_ratio", c.min_found_ratio, "[0, 1]",
           "share of the frames that should see a young point, in which it must be found");
  v.Integer("trial_keyframes", c.trial_keyframes, "[1, 100]",
            "number of keyframes during which a point is young");
  v.Integer("min_weight", c.min_weight, "[1, 1000]",
            "evidence that a point needs after two keyframes: 2 for each observation with "
            "depth, 1 for each without");
}

/// Culls young points that are seldom found where they should be, or that no second keyframe
/// sees. @returns how many.
int CullYoungPoints(Map& map, int keyframe, const PointCullingConfig& config);

}  // namespace slam

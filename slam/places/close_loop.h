#pragma once

#include "slam/mapping/local_mapping.h"
#include "slam/places/loop_detection.h"

namespace slam {

/// Loop closing; off unless asked for, as in the paper's tables.
struct LoopClosingConfig {
  bool enabled = false;
  LoopDetectionConfig detection;
  int min_edge_points = 60;  // ORB-SLAM2: 100
  int full_iterations = 10;  // ORB-SLAM2
};

inline void VisitFields(LoopClosingConfig& c, FieldVisitor& v) {
  v.Flag("enabled", c.enabled, "close loops; the paper's tables are without");
  VisitFields(c.detection, v);
  v.Integer("min_edge_points", c.min_edge_points, "[1, 100000]",
            "shared points that tie two keyframes in the pose graph");
  v.Integer("full_iterations", c.full_iterations, "[0, 1000]",
            "iterations a round of the adjustment of the whole map; 0: none");
}

/// What closing a loop did.
struct LoopReport {
  double moved_m = 0.0;   ///< shift of the keyframe's centre, before the adjustment of all
  int fused = 0;          ///< points that turned out to be known
  bool adjusted = false;  ///< the adjustment of all was usable
};

/// Draws the map together at a loop: the keyframe and its neighbours move to where the place
/// says, what they see is fused with what the place holds, the error is spread over the pose
/// graph of all keyframes, points and planes are carried along, and everything is adjusted
/// once. The first keyframe, the world, stays.
/// @param turn  the map is needed to draw it together and to take the adjustment over
LoopReport CloseLoop(Map& map, const Loop& loop, const Camera& camera,
                     const FeatureScale& scale, const LocalMappingConfig& mapping,
                     const LoopClosingConfig& config, const MapTurn& turn = AtOnce);

}  // namespace slam

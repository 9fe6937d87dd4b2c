#pragma once

#include <vector>

#include "slam/features/point_features.h"
#include "slam/features/read_depths.h"
#include "slam/features/weigh_depths.h"
#include "slam/mapping/local_mapping.h"
#include "slam/tracking/point_tracking.h"

namespace slam {

/// Tracking and mapping by points alone, frame after frame: what a run does without planes.
struct PointOdometer {
  Camera camera;
  PointTracking tracking;
  Map map{};
  LocalMappingConfig mapping{};

  explicit PointOdometer(const Camera& c, const PointTrackingConfig& config = {})
      : camera(c), tracking(c, FeatureScale{}, PointSearchConfig{}, config) {}

  /// @param frame with gray and depth_m; gets features
  void Extract(Frame& frame) const {
    frame.features = ExtractPointFeatures(frame.gray, camera, {});
    ReadDepths(frame.depth_m, camera, {}, {}, {}, frame.features);
    WeighDepths(SensorModel{}, camera, {}, frame.features);
  }

  /// @param frame with gray and depth_m; gets features, matches and pose
  PointTrackReport Step(Frame& frame) {
    Extract(frame);
    const PointTrackReport report = tracking.TrackPoints(frame, map);
    if (report.state == TrackState::kTracking) Finish(frame);
    return report;
  }

  /// Maps a tracked frame and goes on from it.
  void Finish(Frame& frame) {
    if (tracking.NeedKeyframe(frame, map)) {
      const int keyframe =
          InsertKeyframe(frame, map, camera, FeatureScale{}, mapping.keyframes);
      MapLocally(map, keyframe, camera, FeatureScale{}, mapping);
    }
    tracking.Accept(frame, map);
  }
};

}  // namespace slam

#include "slam/run/config.h"

namespace slam {

Config ConfigFor(DepthSensor sensor) {
  Config config;
  config.sensor = ModelOf(sensor);
  config.plane_extraction = ExtractionFor(sensor);
  return config;
}

void VisitFields(Config& c, FieldVisitor& v) {
  const DepthSensor before = c.sensor.sensor;
  v.Section("sensor", "the depth camera", c.sensor);
  if (c.sensor.sensor != before) c.plane_extraction = ExtractionFor(c.sensor.sensor);
  v.Section("depth_warp", "what the depth camera bends, and what is done about it",
            c.depth_warp);
  v.Section("depth_registration", "how far depth lies beside its colour", c.depth_registration);
  v.Section("rolling_shutter", "how long the colour camera reads an image", c.rolling_shutter);
  v.Section("first_look", "what is learnt of the device before a recording is run",
            c.first_look);

  v.Section("point_features", "ORB extraction", c.point_features);
  v.Section("point_depth", "depth of a feature", c.point_features.depth);
  v.Section("pose", "pose optimisation, eq13", c.point_search.pose);
  v.Section("keyframe_decision", "when a frame becomes a keyframe", c.tracking.decision);
  v.Section("point_projection", "search of map points", c.point_search.projection);
  v.Section("relocalise", "finding a lost camera", c.point_search.place);
  v.Section("look_alike", "when a lost camera could as well be elsewhere",
            c.tracking.look_alike);
  v.Section("point_tracking", "tracking by points", c.tracking);

  v.Section("classes", "what objects of a class are good for", c.classes);
  v.Section("detection", "how often the detector is asked", c.detection);
  v.Section("yolox", "the detector of --detector yolox:FILE", c.yolox);
  v.Section("box_tracks", "tracks of detection boxes, which stand in for missed detections",
            c.box_tracks);

  v.Section("plane_extraction", "planes of a depth image", c.plane_extraction);
  v.Section("plane_edges", "boundary points of planes", c.plane_extraction.edges);
  v.Section("plane_processing", "segments to trusted planes", c.plane_processing);

  v.Section("association", "association of frame planes with map planes", c.association);
  v.Section("plane_constraints", "the plane factors of eq13", c.plane_constraints);
  v.Section("structure", "what is assumed of how planes stand to each other", c.structure);

  v.Section("mapping", "how keyframes are mapped", std::function<void()>([&] {
              v.Flag("async", c.async_mapping,
                     "map on a thread beside tracking, which never waits for an adjustment; no "
                     "two runs are then quite the same");
            }));
  v.Section("keyframes", "insertion and removal of keyframes", c.mapping.keyframes);
  v.Section("point_culling", "removal of map points", c.mapping.culling);
  v.Section("triangulation", "new points from two keyframes", c.mapping.triangulation);
  v.Section("point_fusion", "fusion of points that are one", c.mapping.fusion);
  v.Section("local_bundle", "local bundle adjustment", c.mapping.bundle);
  v.Section("plane_map", "planes of the map", c.plane_map);
  v.Section("loop_closing", "recognition of known places, and correction of the map",
            c.loop_closing);
}

}  // namespace slam

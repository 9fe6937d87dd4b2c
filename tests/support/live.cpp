#include "tests/support/live.h"

#include <opencv2/imgproc.hpp>

#include "sim/shapes/planes.h"
#include "slam/input/image_file.h"

namespace live {

slam::Camera CameraOf(const sim::Camera& camera) {
  slam::Camera c;
  c.width = camera.width, c.height = camera.height;
  c.fx = camera.fx, c.fy = camera.fy, c.cx = camera.cx, c.cy = camera.cy;
  c.fps = camera.fps, c.depth_factor = camera.depth_factor;
  return c;
}

slam::Pose PoseOf(const sim::Pose& T_wc) { return slam::Inverse({T_wc.R, T_wc.t}); }

slam::Frame FrameOf(const sim::SimulatedFrame& simulated, int index, double timestamp_s,
                    double depth_factor) {
  slam::Frame frame;
  frame.index = index;
  frame.timestamp_s = timestamp_s;
  cv::cvtColor(simulated.colour, frame.gray, cv::COLOR_BGR2GRAY);
  frame.depth_m = slam::DepthInMetres(simulated.depth, depth_factor);
  return frame;
}

std::vector<slam::Detection> DetectionsOf(const sim::SimulatedFrame& simulated) {
  const slam::ClassTable classes = slam::CocoClassTable();
  std::vector<slam::Detection> detections;
  for (const sim::Detection& seen : simulated.detections) {
    slam::Detection detection;
    detection.class_name = seen.class_name;
    detection.kind = classes.KindOf(seen.class_name);
    detection.score = seen.score;
    detection.box_px.min = {seen.box.x0, seen.box.y0};
    detection.box_px.max = {seen.box.x1, seen.box.y1};
    detections.push_back(detection);
  }
  return detections;
}

std::vector<int> TruthOf(const slam::Frame& frame, const sim::SimulatedFrame& simulated,
                         const sim::Scene& scene) {
  std::map<int, sim::Role> role_of_object;
  for (const sim::Object& object : scene.objects) role_of_object[object.id] = object.role;
  std::map<int, bool> scored;
  for (const sim::ScenePlane& plane : sim::ScenePlanes(scene)) {
    const sim::Role role = role_of_object.at(plane.object);
    scored[plane.id] = role == sim::Role::kStructure || role == sim::Role::kRegular;
  }

  std::vector<std::map<int, int>> votes(frame.planes.size());
  for (int v = 0; v < frame.plane_labels.rows; ++v) {
    for (int u = 0; u < frame.plane_labels.cols; ++u) {
      const int label = frame.plane_labels(v, u);
      if (label == 0) continue;
      const int id = simulated.plane_id(v, u);
      const auto found = scored.find(id);
      ++votes[static_cast<std::size_t>(label - 1)]
             [found != scored.end() && found->second ? id : 0];
    }
  }
  std::vector<int> truth;
  for (const std::map<int, int>& vote : votes) {
    int best = 0, most = 0;
    for (const auto& [id, count] : vote) {
      if (count > most) best = id, most = count;
    }
    truth.push_back(best);
  }
  return truth;
}

void AppendRecords(const slam::Frame& frame, const std::vector<int>& truth,
                   std::vector<eval::AssociationRecord>& records) {
  for (std::size_t i = 0; i < frame.planes.size(); ++i) {
    if (!frame.plane_matches[i].ShowsLandmark()) continue;
    records.push_back({frame.index, truth[i], frame.plane_matches[i].map_plane});
  }
}

}  // namespace live

#include "slam/planes/process_planes.h"

namespace slam {
namespace {

/// Lines and corners of a face, when its object is one that has rectangular faces.
void OutlineFace(FramePlane& plane, const Frame& frame, const Camera& camera,
                 const PlaneProcessingConfig& config) {
  plane.lines_c.clear();
  plane.vertices_c.clear();
  if (!plane.detection) return;
  const Detection& detection = frame.detections.at(static_cast<std::size_t>(*plane.detection));
  if (detection.kind != ClassKind::kRegular) return;
  const Random random{config.seed, static_cast<std::uint64_t>(frame.index),
                      static_cast<std::uint64_t>(plane.index)};
  const std::vector<EdgeLine> lines = FindEdgeLines(plane, camera, config.edge_lines, random);
  for (const EdgeLine& line : lines) plane.lines_c.push_back(line.line_c);
  plane.vertices_c = FindVertices(plane, lines, camera, detection.box_px, config.vertices);
}

}  // namespace

void ProcessPlanes(Frame& frame, const Camera& camera, const PlaneProcessingConfig& config) {
  for (FramePlane& plane : frame.planes) RefitPlane(plane, config.noise, config.refit);
  LinkBoxes(frame.planes, frame.detections, config.box_link);
  for (FramePlane& plane : frame.planes) {
    OutlineFace(plane, frame, camera, config);
    plane.bad = FindFault(plane, frame.detections, camera, config.select);
  }
}

}  // namespace slam

#include "slam/faces/process_planes.h"

#include <algorithm>

namespace slam {
namespace {

void DemandMore(const UnlinkedConfig& unlinked, EdgeLineConfig& lines, VertexConfig& vertices) {
  lines.min_contour_share = std::max(lines.min_contour_share, unlinked.min_contour_share);
  lines.min_length_px = std::max(lines.min_length_px, unlinked.min_length_px);
  vertices.max_parallel_angle_rad =
      std::min(vertices.max_parallel_angle_rad, unlinked.max_parallel_angle_rad);
  vertices.max_square_error_rad =
      std::min(vertices.max_square_error_rad, unlinked.max_square_error_rad);
}

/// Lines and corners of a face, unless its object is known to have no rectangular ones.
void OutlineFace(FramePlane& plane, const Frame& frame, const Camera& camera,
                 const PlaneProcessingConfig& config) {
  plane.lines_c.clear();
  plane.vertices_c.clear();
  const Detection* linked = nullptr;  // only to what has rectangular faces
  if (plane.detection) {
    const Detection& found = frame.detections.at(static_cast<std::size_t>(*plane.detection));
    if (found.kind == ClassKind::kUnstructured) return;
    if (found.kind == ClassKind::kRegular) linked = &found;
  }
  const Random random{config.seed, static_cast<std::uint64_t>(frame.index),
                      static_cast<std::uint64_t>(plane.index)};
  EdgeLineConfig line_config = config.edge_lines;
  VertexConfig vertex_config = config.vertices;
  if (!linked) DemandMore(config.unlinked, line_config, vertex_config);
  const std::vector<EdgeLine> lines = FindEdgeLines(plane, camera, line_config, random);
  for (const EdgeLine& line : lines) plane.lines_c.push_back(line.line_c);
  const std::optional<Box> box_px = linked ? std::optional<Box>(linked->box_px) : std::nullopt;
  plane.vertices_c = FindVertices(plane, lines, camera, box_px, vertex_config);
}

}  // namespace

void ProcessPlanes(Frame& frame, const Camera& camera, const SensorModel& sensor,
                   const PlaneProcessingConfig& config) {
  for (FramePlane& plane : frame.planes) RefitPlane(plane, sensor, config.refit);
  const UsualRoughness usual = FindUsualRoughness(frame.planes);
  LinkBoxes(frame.planes, frame.detections, config.box_link);
  for (FramePlane& plane : frame.planes) {
    OutlineFace(plane, frame, camera, config);
    plane.bad = FindFault(plane, frame.detections, config.box_link.min_score, usual, camera,
                          config.select);
  }
}

}  // namespace slam

#include "slam/mapping/plane_observation.h"

#include <cmath>

#include "slam/mapping/plane_cloud.h"
#include "slam/mapping/plane_evidence.h"
#include "slam/mapping/plane_face.h"
#include "slam/mapping/plane_vertices.h"
#include "slam/model/class_belief.h"
#include "slam/pose/pose_error.h"

namespace slam {
namespace {

/// The observation's information.
void UpdateParameters(MapPlane& m, const FramePlane& plane, const Frame& frame,
                      const PlaneMapConfig& config) {
  AddEvidence(m.estimate, plane, frame, Inverse(frame.T_cw), config.keep_information,
              VarianceAlong(CovarianceInWorld(frame), plane.pi_c.n, plane.centroid_c));
  if (!m.estimate.empty()) m.pi_w = m.estimate.Mean();
}

/// Clouds, outline, area and centroid.
void UpdateShape(MapPlane& m, const FramePlane& plane, const Pose& T_wc,
                 const PlaneMapConfig& config) {
  // The grid starts at the first observation, so that voxels do not move with the estimate.
  const Plane grid{m.estimate.normal_w, 0.0};
  const Eigen::Vector3d& grid_origin_w = m.estimate.origin_w;
  m.voxel_m =
      MergeIntoCloud(m.points_w, PointsInWorld(plane.points_c, T_wc), grid, grid_origin_w,
                     std::max(config.voxel_m, m.voxel_m), config.max_cloud_points);
  // What once lay on the plane stays in its outline, until its corners are known.
  const bool face_known = KnowsItsFace(m, config);
  if (face_known) KeepWhatLiesOnFace(m, config);
  std::vector<Eigen::Vector3d> extent_w = face_known ? m.vertices_w : m.hull_w;
  extent_w.insert(extent_w.end(), m.points_w.begin(), m.points_w.end());
  Outline outline = ConvexOutline(extent_w, m.pi_w);
  m.hull_w = std::move(outline.hull_w);
  m.area_m2 = outline.area_m2;
  m.centroid_w = m.points_w.empty() ? ProjectOnto(m.pi_w, m.centroid_w)
                                    : CloudCentroid(m.points_w, m.pi_w);
}

void UpdateClass(MapPlane& m, const FramePlane& plane, const Frame& frame) {
  if (!frame.detector_asked)
    return;  // a box that is carried over was counted where it was found
  double score = 1.0;
  if (plane.detection && *plane.detection < static_cast<int>(frame.detections.size())) {
    const Detection& detection = frame.detections[static_cast<std::size_t>(*plane.detection)];
    if (detection.score > 0) score = detection.score;
    // A box that was only predicted from its track is half an observation.
    if (detection.compensated) score *= 0.5;
  }
  UpdateClassBelief(m, plane.class_name, score);
}

/// Corners are those of an object's face, and only of a face that was seen whole.
bool HasCorners(const FramePlane& plane, const MapPlane& m) {
  return !plane.bad && !m.class_name.empty();
}

}  // namespace

std::vector<Eigen::Vector3d> PointsInWorld(const std::vector<Eigen::Vector3d>& points_c,
                                           const Pose& T_wc) {
  std::vector<Eigen::Vector3d> points_w;
  points_w.reserve(points_c.size());
  for (const Eigen::Vector3d& p_c : points_c) points_w.push_back(T_wc * p_c);
  return points_w;
}

MapPlane StartPlane(const FramePlane& plane, const Frame& frame) {
  const Pose T_wc = Inverse(frame.T_cw);
  MapPlane m;
  m.pi_w = Transform(T_wc, plane.pi_c);
  m.centroid_w = T_wc * plane.centroid_c;
  m.first_frame = frame.index;
  m.first_seen_s = frame.timestamp_s;
  m.last_frame = kNone;
  return m;
}

void ObservePlane(MapPlane& m, const FramePlane& plane, const Frame& frame,
                  const PlaneMapConfig& config) {
  const Pose T_wc = Inverse(frame.T_cw);
  UpdateParameters(m, plane, frame, config);
  UpdateShape(m, plane, T_wc, config);
  UpdateClass(m, plane, frame);
  if (HasCorners(plane, m)) FuseVertices(m, plane.vertices_c, T_wc, config);
  // Several segments of one surface in a frame are one observation.
  if (m.last_frame != frame.index || m.observations == 0) ++m.observations;
  m.seen_px += plane.pixel_count;
  m.last_frame = frame.index;
  m.last_seen_s = frame.timestamp_s;
}

}  // namespace slam

#include "slam/mapping/plane_update.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "slam/base/index.h"
#include "slam/geometry/pixel_projection.h"
#include "slam/mapping/plane_cloud.h"
#include "slam/mapping/plane_evidence.h"
#include "slam/mapping/plane_face.h"
#include "slam/mapping/plane_trial.h"
#include "slam/mapping/plane_vertices.h"
#include "slam/model/class_belief.h"
#include "slam/model/map_queries.h"

namespace slam {
namespace {

/// A candidate before its first observation.
MapPlane StartPlane(const FramePlane& plane, const Frame& frame, const Pose& T_wc) {
  MapPlane m;
  m.pi_w = Transform(T_wc, plane.pi_c);
  m.centroid_w = T_wc * plane.centroid_c;
  m.first_frame = frame.index;
  m.first_seen_s = frame.timestamp_s;
  m.last_frame = kNone;
  return m;
}

std::vector<Eigen::Vector3d> InWorld(const std::vector<Eigen::Vector3d>& points_c,
                                     const Pose& T_wc) {
  std::vector<Eigen::Vector3d> points_w;
  points_w.reserve(points_c.size());
  for (const Eigen::Vector3d& p_c : points_c) points_w.push_back(T_wc * p_c);
  return points_w;
}

/// Boundary points where the surface itself ends.
std::vector<Eigen::Vector3d> TrueEdges(const FramePlane& plane, const Pose& T_wc) {
  std::vector<Eigen::Vector3d> points_w;
  for (const EdgePoint& edge : plane.edge_points) {
    if (edge.kind == EdgeKind::kSurface) points_w.push_back(T_wc * edge.p_c);
  }
  return points_w;
}

/// The observation's information, errors that do not average out included.
void UpdateParameters(MapPlane& m, const FramePlane& plane, const Pose& T_wc,
                      const AssociationConfig& a, const PlaneMapConfig& config) {
  AddEvidence(m.estimate, plane, T_wc, a, config.keep_information);
  if (!m.estimate.empty()) m.pi_w = m.estimate.Mean();
}

/// Clouds, outline, area and centroid.
void UpdateShape(MapPlane& m, const FramePlane& plane, const Pose& T_wc,
                 const PlaneMapConfig& config) {
  // The grid starts at the first observation, so that voxels do not move with the estimate.
  const Plane grid{m.estimate.normal_w, 0.0};
  const Eigen::Vector3d& grid_origin_w = m.estimate.origin_w;
  MergeIntoCloud(m.points_w, InWorld(plane.points_c, T_wc), grid, grid_origin_w, config.voxel_m,
                 config.max_cloud_points);
  MergeIntoCloud(m.edge_points_w, TrueEdges(plane, T_wc), grid, grid_origin_w, config.voxel_m,
                 config.max_edge_points);
  // What once lay on the plane stays in its outline, until its corners are known.
  const bool face_known = KnowsItsFace(m, config);
  if (face_known) KeepWhatLiesOnFace(m, config);
  std::vector<Eigen::Vector3d> extent_w = face_known ? m.vertices_w : m.hull_w;
  extent_w.insert(extent_w.end(), m.points_w.begin(), m.points_w.end());
  Outline outline = ConvexOutline(extent_w, m.pi_w);
  m.hull_w = std::move(outline.hull_w);
  m.area_m2 = outline.area_m2;
  // The centroid of the cloud, on the plane.
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p_w : m.points_w) sum += p_w;
  if (!m.points_w.empty()) m.centroid_w = sum / static_cast<double>(m.points_w.size());
  m.centroid_w = ProjectOnto(m.pi_w, m.centroid_w);
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

/// The landmark that each label of the frame stands for, or kNone.
std::vector<int> LandmarkOfPlane(const Frame& frame) {
  std::vector<int> landmark(frame.planes.size(), kNone);
  for (std::size_t f = 0; f < landmark.size(); ++f) {
    const PlaneMatch& match = frame.plane_matches[f];
    if (match.ShowsLandmark()) landmark[f] = match.map_plane;
  }
  return landmark;
}

/// Counts the frame for every pair of landmarks in it.
void UpdateCovisibility(const std::vector<int>& landmark, Map& map) {
  std::set<int> seen;
  for (const int id : landmark) {
    if (id != kNone) seen.insert(id);
  }
  for (const int id : seen) {
    for (const int other : seen) {
      if (other != id) ++map.planes.At(id).covisible[other];
    }
  }
}

/// Notes the steps between surfaces that the frame shows side by side.
void UpdateSteps(const Frame& frame, Map& map) {
  std::set<std::pair<int, int>> between;  // several segments of a surface are one observation
  for (const FrameStep& step : frame.plane_steps) {
    const PlaneMatch& one = frame.plane_matches[Index(step.one)];
    const PlaneMatch& other = frame.plane_matches[Index(step.other)];
    if (one.map_plane == kNone || other.map_plane == kNone) continue;
    if (one.map_plane != other.map_plane)
      between.insert(std::minmax(one.map_plane, other.map_plane));
  }
  for (const auto& [one, other] : between) {
    ++map.planes.At(one).stepped[other];
    ++map.planes.At(other).stepped[one];
  }
}

/// Notes the frame's matched map points that lie on its planes.
void UpdateMapPoints(const Frame& frame, const std::vector<int>& landmark, const Camera& camera,
                     double max_distance_m, Map& map) {
  if (frame.plane_labels.empty()) return;
  for (const auto& [feature, id] : MatchedPoints(frame, map)) {
    const Eigen::Vector2i u =
        RecordedPixel(camera, camera.Backproject(frame.features[feature].u_px, 1.0));
    if (u.x() < 0) continue;
    const auto label = static_cast<std::size_t>(frame.plane_labels(u.y(), u.x()));
    if (label == 0 || label > landmark.size() || landmark[label - 1] == kNone) continue;
    MapPlane& m = map.planes.At(landmark[label - 1]);
    const Eigen::Vector3d& p_w = map.points[static_cast<std::size_t>(id)].p_w;
    if (std::abs(SignedDistance(m.pi_w, p_w)) < max_distance_m) m.map_points.insert(id);
  }
}

/// Corners are those of an object's face, and only of a face that was seen whole.
bool HasCorners(const FramePlane& plane, const MapPlane& m) {
  return !plane.bad && !m.class_name.empty();
}

/// Adds one frame plane to the map plane that it shows.
void Observe(MapPlane& m, const FramePlane& plane, const Frame& frame, const Pose& T_wc,
             const AssociationConfig& association, const PlaneMapConfig& config) {
  UpdateParameters(m, plane, T_wc, association, config);
  UpdateShape(m, plane, T_wc, config);
  UpdateClass(m, plane, frame);
  if (HasCorners(plane, m)) FuseVertices(m, plane.vertices_c, T_wc, config);
  // Several segments of one surface in a frame are one observation.
  if (m.last_frame != frame.index || m.observations == 0) ++m.observations;
  m.seen_px += plane.pixel_count;
  m.last_frame = frame.index;
  m.last_seen_s = frame.timestamp_s;
}

/// Good planes that show nothing of the map start a candidate; or landmarks, where the map has
/// none yet and the segment is proof enough.
void StartCandidates(Frame& frame, const Pose& T_wc, const PlaneMapConfig& config, Map& map) {
  const bool any_landmark =
      std::any_of(map.planes.begin(), map.planes.end(),
                  [](const MapPlane& m) { return m.status != LandmarkStatus::kCandidate; });
  for (std::size_t f = 0; f < frame.planes.size(); ++f) {
    PlaneMatch& match = frame.plane_matches[f];
    const FramePlane& plane = frame.planes[f];
    if (match.decision != PlaneDecision::kUnmatched ||
        match.reason == MatchReason::kAmbiguous || !IsGood(plane, config)) {
      continue;
    }
    MapPlane& m = map.planes.Add(StartPlane(plane, frame, T_wc));
    const bool at_once =
        config.trial_frames <= 1 || (!any_landmark && IsProofAlone(plane, config));
    if (at_once) m.status = LandmarkStatus::kLandmark;
    match = {at_once ? PlaneDecision::kNew : PlaneDecision::kTrial, m.id,
             MatchReason::kNothing};
  }
}

/// Makes landmarks of the candidates in this frame that have proven themselves. The largest
/// segment is the one that made it, so that one decision a landmark says "new".
void PromoteProven(Frame& frame, const PlaneMapConfig& config, Map& map) {
  std::map<int, std::size_t> largest;  // segment, by candidate
  for (std::size_t f = 0; f < frame.planes.size(); ++f) {
    const PlaneMatch& match = frame.plane_matches[f];
    if (match.decision != PlaneDecision::kTrial || !IsGood(frame.planes[f], config)) continue;
    const auto [found, first] = largest.emplace(match.map_plane, f);
    if (!first && frame.planes[f].pixel_count > frame.planes[found->second].pixel_count) {
      found->second = f;
    }
  }
  for (const auto& [id, f] : largest) {
    MapPlane& m = map.planes.At(id);
    if (!HasProvenItself(m, config)) continue;
    m.status = LandmarkStatus::kLandmark;
    frame.plane_matches[f].decision = PlaneDecision::kNew;
  }
}

}  // namespace

void UpdatePlanes(Frame& frame, Map& map, const Camera& camera,
                  const AssociationConfig& association, const PlaneMapConfig& config) {
  frame.plane_matches.resize(frame.planes.size());
  const Pose T_wc = Inverse(frame.T_cw);
  StartCandidates(frame, T_wc, config, map);

  // Landmarks learn from whatever was matched with them, candidates from good planes alone.
  for (std::size_t f = 0; f < frame.planes.size(); ++f) {
    const PlaneMatch& match = frame.plane_matches[f];
    if (match.decision == PlaneDecision::kUnmatched) continue;
    if (match.decision == PlaneDecision::kTrial && !IsGood(frame.planes[f], config)) continue;
    Observe(map.planes.At(match.map_plane), frame.planes[f], frame, T_wc, association, config);
  }
  UpdateSteps(frame, map);
  PromoteProven(frame, config, map);
  EraseFailedCandidates(frame, camera, config, map);

  const std::vector<int> landmark = LandmarkOfPlane(frame);
  UpdateCovisibility(landmark, map);
  UpdateMapPoints(frame, landmark, camera, config.max_point_distance_m, map);
}

}  // namespace slam

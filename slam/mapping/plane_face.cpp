#include "slam/mapping/plane_face.h"

#include <algorithm>
#include <utility>

#include "slam/model/frame_plane.h"

namespace slam {

bool KnowsItsFace(const MapPlane& m, const PlaneMapConfig& config) {
  return m.vertices_w.size() == kFaceCorners && m.vertex_weights.size() == kFaceCorners &&
         std::all_of(m.vertex_weights.begin(), m.vertex_weights.end(),
                     [&](double weight) { return weight >= config.min_face_weight; });
}

void ForgetDoubtfulCorners(MapPlane& m, const PlaneMapConfig& config) {
  std::vector<Eigen::Vector3d> corners_w;
  std::vector<double> weights;
  for (std::size_t i = 0; i < m.vertices_w.size() && i < m.vertex_weights.size(); ++i) {
    if (!(m.vertex_weights[i] >= config.min_corner_weight)) continue;
    corners_w.push_back(m.vertices_w[i]);
    weights.push_back(m.vertex_weights[i]);
  }
  m.vertices_w = std::move(corners_w);
  m.vertex_weights = std::move(weights);
}

void KeepWhatLiesOnFace(MapPlane& m, const PlaneMapConfig& config) {
  Eigen::Vector3d middle_w = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& corner_w : m.vertices_w)
    middle_w += corner_w / double(kFaceCorners);
  // Beyond a side: outwards of it, in the plane, by more than the margin.
  const auto beyond = [&](const Eigen::Vector3d& p_w) {
    for (std::size_t i = 0; i < kFaceCorners; ++i) {
      const Eigen::Vector3d& from_w = m.vertices_w[i];
      const Eigen::Vector3d along = m.vertices_w[(i + 1) % kFaceCorners] - from_w;
      Eigen::Vector3d outwards = along.cross(m.pi_w.n).normalized();
      if (outwards.dot(middle_w - from_w) > 0) outwards = -outwards;  // either sense of turning
      if (outwards.dot(p_w - from_w) > config.face_margin_m) return true;
    }
    return false;
  };
  std::erase_if(m.points_w, beyond);
}

}  // namespace slam

#include "slam/faces/carry_to_colour.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

namespace slam {
namespace {

constexpr int kBlock_px = 8;

/// Tells a plane as another camera sees it, if not from behind. @param T_oc  to that camera
void MovePlane(const Pose& T_oc, const Camera& camera, FramePlane& plane) {
  Plane moved = Transform(T_oc, plane.pi_c);
  moved.n.normalize();
  if (!(moved.d > 0)) return;  // seen from its edge, and from there not at all
  plane.pi_c = moved;
  plane.centroid_c = T_oc * plane.centroid_c;
  plane.inverse_depth_covariance = T_oc.R * plane.inverse_depth_covariance * T_oc.R.transpose();
  for (Eigen::Vector3d& p_c : plane.points_c) p_c = T_oc * p_c;
  plane.box_px = {};
  for (EdgePoint& edge : plane.edge_points) {
    edge.p_c = T_oc * edge.p_c;
    if (edge.p_c.z() > kMinVisibleDepth_m) edge.u_px = camera.ProjectDistorted(edge.p_c);
    plane.box_px.Include(edge.u_px);
  }
  for (Line& line : plane.lines_c) line = {T_oc * line.P, T_oc.R * line.V};
  for (Vertex& vertex : plane.vertices_c) {
    vertex.p_c = T_oc * vertex.p_c;
    vertex.covariance_c = T_oc.R * vertex.covariance_c * T_oc.R.transpose();
  }
}

/// Depth in the middle of a block, or where it is measured around it; 0 if nowhere.
float DepthOfBlock(const cv::Mat1f& depth_m, const cv::Rect& block) {
  const cv::Point middle = (block.tl() + block.br()) / 2;
  for (const cv::Point& by : {cv::Point(0, 0),
                              {2, 0},
                              {-2, 0},
                              {0, 2},
                              {0, -2},
                              {-3, -3},
                              {3, -3},
                              {-3, 3},
                              {3, 3}}) {
    const cv::Point at = middle + by;
    if (block.contains(at) && depth_m(at) > 0.0f) return depth_m(at);
  }
  return 0.0f;
}

void MoveRow(const float* from_m, int count, double scale, double offset_m, float* to_m) {
  const auto by = static_cast<float>(scale), plus_m = static_cast<float>(offset_m);
  for (int k = 0; k < count; ++k) to_m[k] = from_m[k] > 0.0f ? by * from_m[k] + plus_m : 0.0f;
}

}  // namespace

void CarryToColour(const Camera& camera, const cv::Mat2d& rays, Frame& frame) {
  const Pose T_dc = frame.T_dc(), T_cd = Inverse(T_dc);
  if (T_dc.R.isIdentity(0.0) && T_dc.t.isZero(0.0)) return;
  for (FramePlane& plane : frame.planes) MovePlane(T_cd, camera, plane);

  // Each block of the colour image looks at the pixels of the depth image where it is seen.
  const cv::Mat1b& labels_d = frame.plane_labels;
  const cv::Mat1f& depth_d = frame.depth_m;
  cv::Mat1b labels(labels_d.size(), 0);
  cv::Mat1f depth_m(depth_d.size(), 0.0f);
  double z_m = 1.0;  // of the block before, where nothing is measured
  for (int v0 = 0; v0 < depth_m.rows; v0 += kBlock_px) {
    for (int u0 = 0; u0 < depth_m.cols; u0 += kBlock_px) {
      const cv::Rect block(u0, v0, std::min(kBlock_px, depth_m.cols - u0),
                           std::min(kBlock_px, depth_m.rows - v0));
      if (const float there_m = DepthOfBlock(depth_d, block); there_m > 0.0f)
        z_m = static_cast<double>(there_m);
      const cv::Point middle = (block.tl() + block.br()) / 2;
      const cv::Vec2d& ray = rays(middle);
      const Eigen::Vector3d x_d = T_dc * Eigen::Vector3d(z_m * ray[0], z_m * ray[1], z_m);
      if (!(x_d.z() > kMinVisibleDepth_m)) continue;
      const Eigen::Vector2d seen = camera.ProjectDistorted(x_d);
      const cv::Point by(static_cast<int>(std::lround(seen.x())) - middle.x,
                         static_cast<int>(std::lround(seen.y())) - middle.y);
      const cv::Rect from = (block + by) & cv::Rect({}, depth_d.size());
      if (from.empty()) continue;
      // Over a block the ray hardly turns.
      const double scale = 1 / T_dc.R.row(2).dot(Eigen::Vector3d(ray[0], ray[1], 1.0));
      const double offset_m = -T_dc.t.z() * scale;
      for (int v = from.y; v < from.y + from.height; ++v)
        MoveRow(depth_d[v] + from.x, from.width, scale, offset_m,
                depth_m[v - by.y] + from.x - by.x);
      if (!labels_d.empty()) labels_d(from).copyTo(labels(from - by));
    }
  }
  if (!labels_d.empty()) frame.plane_labels = labels;
  frame.depth_m = depth_m;
}

void CarryPlanesAgain(const Pose& T_dc, const Camera& camera, Frame& frame) {
  const Pose now = frame.T_dc();
  if (now.R == T_dc.R && now.t == T_dc.t) return;
  const Pose T_oc = Inverse(now) * T_dc;
  for (FramePlane& plane : frame.planes) MovePlane(T_oc, camera, plane);
}

}  // namespace slam

#pragma once

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "slam/base/random.h"
#include "slam/model/frame.h"
#include "tests/support/cameras.h"
#include "tests/support/normal_draws.h"

namespace slam {

/// A rectangle with a front: center + a half_1 + b half_2, |a|, |b| <= 1; the front is half_1 x
/// half_2.
struct WorldPlane {
  Eigen::Vector3d center_w, half_1_w, half_2_w;
  std::string class_name;  ///< "" for structure
  int object = 0;          ///< planes of one object share its detection box

  Plane pi_w() const {
    const Eigen::Vector3d n = half_1_w.cross(half_2_w).normalized();
    return {n, -n.dot(center_w)};
  }
};

/// Rectangles to be seen by a camera: a closed-form world for tests of association and mapping.
struct PlaneWorld {
  std::vector<WorldPlane> planes;
  int objects = 0;

  /// A single rectangle, an object of its own. @returns its index.
  int Add(const Eigen::Vector3d& center_w, const Eigen::Vector3d& half_1_w,
          const Eigen::Vector3d& half_2_w, const std::string& class_name) {
    planes.push_back({center_w, half_1_w, half_2_w, class_name, objects++});
    return static_cast<int>(planes.size()) - 1;
  }

  /// Top and four sides of an upright box that stands at `base_w` (z up). @returns the top's
  /// index.
  int AddBox(const Eigen::Vector3d& base_w, const Eigen::Vector3d& size_m, double yaw_rad,
             const std::string& class_name) {
    const Eigen::Matrix3d R = ExpSo3({0, 0, yaw_rad});
    const Eigen::Vector3d x = R.col(0) * size_m.x() / 2, y = R.col(1) * size_m.y() / 2;
    const Eigen::Vector3d z = Eigen::Vector3d::UnitZ() * size_m.z() / 2;
    const Eigen::Vector3d middle_w = base_w + z;
    const int top = Add(middle_w + z, x, y, class_name), object = planes.back().object;
    planes.push_back({middle_w + x, y, z, class_name, object});
    planes.push_back({middle_w - x, z, y, class_name, object});
    planes.push_back({middle_w + y, z, x, class_name, object});
    planes.push_back({middle_w - y, x, z, class_name, object});
    return top;
  }
};

/// What goes wrong between the world and the frame. Zero everywhere: an exact view.
struct ViewFaults {
  double depth_noise = 0.0;  ///< times Nguyen's sigma(z) = 1.2 mm + 1.9 mm/m^2 (z - 0.4 m)^2
  double miss_rate = 0.0;    ///< share of objects without a detection in a frame
  double box_jitter_px = 0.0;
  double pose_sigma_m = 0.0, pose_sigma_rad = 0.0;  ///< of frame.T_cw per axis
};

/// One frame and, per frame plane, the world plane that it shows.
struct SeenWorld {
  Frame frame;
  std::vector<int> truth;
};

/// Camera at `eye_w` that looks at `target_w`, z up in the world, image upright.
inline Pose LookAt(const Eigen::Vector3d& eye_w, const Eigen::Vector3d& target_w) {
  const Eigen::Vector3d z = (target_w - eye_w).normalized();
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  Pose T_cw;
  T_cw.R << x.transpose(), z.cross(x).transpose(), z.transpose();
  T_cw.t = -(T_cw.R * eye_w);
  return T_cw;
}

namespace plane_world_detail {

inline double Sigma(double z) { return 0.0012 + 0.0019 * (z - 0.4) * (z - 0.4); }

/// Index of the world plane at each pixel, -1 for none, and its depth along z.
inline void Cast(const PlaneWorld& world, const Pose& T_cw, const Camera& camera, cv::Mat1i& id,
                 cv::Mat1d& depth) {
  id = cv::Mat1i(camera.height, camera.width, -1);
  depth = cv::Mat1d(camera.height, camera.width, 0.0);
  for (std::size_t i = 0; i < world.planes.size(); ++i) {
    const WorldPlane& plane = world.planes[i];
    const Plane pi_c = Transform(T_cw, plane.pi_w());
    if (pi_c.d <= 0) continue;  // seen from behind
    const Eigen::Vector3d center_c = T_cw * plane.center_w;
    const Eigen::Vector3d h1 = T_cw.R * plane.half_1_w, h2 = T_cw.R * plane.half_2_w;
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const Eigen::Vector3d ray = camera.Backproject({u, v}, 1.0);
        const double slope = pi_c.n.dot(ray);
        if (!(slope < -1e-3)) continue;
        const double z = -pi_c.d / slope;
        const Eigen::Vector3d q = z * ray - center_c;
        const bool inside =
            std::abs(q.dot(h1)) <= h1.squaredNorm() && std::abs(q.dot(h2)) <= h2.squaredNorm();
        if (inside && z > 0.1 && (id(v, u) < 0 || z < depth(v, u))) {
          id(v, u) = static_cast<int>(i);
          depth(v, u) = z;
        }
      }
    }
  }
}

/// Pixels of the connected piece of one id that holds (v, u); marks them as done.
inline std::vector<Eigen::Vector2i> Piece(const cv::Mat1i& id, cv::Mat1b& done, int v, int u) {
  std::vector<Eigen::Vector2i> piece{{u, v}};
  done(v, u) = 1;
  for (std::size_t k = 0; k < piece.size(); ++k) {
    for (const Eigen::Vector2i& step : {Eigen::Vector2i(1, 0), Eigen::Vector2i(-1, 0),
                                        Eigen::Vector2i(0, 1), Eigen::Vector2i(0, -1)}) {
      const Eigen::Vector2i q = piece[k] + step;
      if (q.x() < 0 || q.y() < 0 || q.x() >= id.cols || q.y() >= id.rows) continue;
      if (done(q.y(), q.x()) || id(q.y(), q.x()) != id(v, u)) continue;
      done(q.y(), q.x()) = 1;
      piece.push_back(q);
    }
  }
  return piece;
}

/// Least squares over the piece's noisy points, and what that fit is worth.
inline void Fit(const std::vector<Eigen::Vector3d>& points_c, double sigma_z,
                FramePlane& plane) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& p : points_c) mean += p;
  mean /= static_cast<double>(points_c.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const auto& p : points_c) scatter += (p - mean) * (p - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  const Eigen::Vector3d n = solver.eigenvectors().col(0);
  plane.pi_c = FacingOrigin({n, -n.dot(mean)});
  plane.centroid_c = mean;
  const double sigma = std::max(1e-5, sigma_z);
  plane.offset_sigma_m = sigma / std::sqrt(static_cast<double>(points_c.size()));
  plane.angle_sigma_rad = sigma / std::sqrt(std::max(1e-12, solver.eigenvalues()[1]));
  plane.inlier_ratio = 1.0;
}

}  // namespace plane_world_detail

/// Casts a ray per pixel and makes every connected visible piece of a rectangle of at least
/// `min_pixels` a frame plane: labels, fit, sigmas, points, edge points, boxes, and corners
/// where all four lie in the picture and the piece is whole.
inline SeenWorld See(const PlaneWorld& world, const Pose& T_cw, const Camera& camera,
                     const ViewFaults& faults, Random random, int min_pixels = 40) {
  using namespace plane_world_detail;
  SeenWorld out;
  Frame& frame = out.frame;
  Vector6d error;
  for (int i = 0; i < 6; ++i) {
    error[i] = Normal(random) * (i < 3 ? faults.pose_sigma_m : faults.pose_sigma_rad);
  }
  frame.T_cw = Exp(error) * T_cw;
  cv::Mat1i id;
  cv::Mat1d depth;
  Cast(world, T_cw, camera, id, depth);
  frame.gray = cv::Mat1b(camera.height, camera.width, static_cast<unsigned char>(128));
  frame.depth_m = cv::Mat1f(camera.height, camera.width, 0.0f);
  frame.plane_labels = cv::Mat1b(camera.height, camera.width, static_cast<unsigned char>(0));
  std::vector<Box> object_box(static_cast<std::size_t>(world.objects));
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      if (id(v, u) < 0) continue;
      const double z = depth(v, u);
      frame.depth_m(v, u) =
          static_cast<float>(z + faults.depth_noise * Sigma(z) * Normal(random));
      const WorldPlane& plane = world.planes[static_cast<std::size_t>(id(v, u))];
      object_box[static_cast<std::size_t>(plane.object)].Include(Eigen::Vector2d(u, v));
    }
  }
  std::vector<int> detection_of(object_box.size(), -1);
  for (const WorldPlane& plane : world.planes) {
    const auto o = static_cast<std::size_t>(plane.object);
    if (plane.class_name.empty() || object_box[o].empty() || detection_of[o] != -1) continue;
    detection_of[o] = -2;
    if (random.Uniform() < faults.miss_rate) continue;
    Detection detection;
    detection.class_name = plane.class_name;
    detection.kind = ClassKind::kRegular;
    detection.score = 0.9;
    detection.box_px = object_box[o];
    for (int k = 0; k < 2; ++k) {
      detection.box_px.min[k] += faults.box_jitter_px * Normal(random);
      detection.box_px.max[k] += faults.box_jitter_px * Normal(random);
    }
    detection_of[o] = static_cast<int>(frame.detections.size());
    frame.detections.push_back(detection);
  }
  cv::Mat1b done(camera.height, camera.width, static_cast<unsigned char>(0));
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      if (done(v, u) || id(v, u) < 0) continue;
      const std::vector<Eigen::Vector2i> piece = Piece(id, done, v, u);
      if (static_cast<int>(piece.size()) < min_pixels || frame.planes.size() >= 250) continue;
      const WorldPlane& source = world.planes[static_cast<std::size_t>(id(v, u))];
      FramePlane plane;
      plane.index = static_cast<int>(frame.planes.size());
      std::vector<Eigen::Vector3d> points_c;
      for (const Eigen::Vector2i& q : piece) {
        frame.plane_labels(q.y(), q.x()) = static_cast<unsigned char>(plane.index + 1);
        const Eigen::Vector3d p_c = camera.Backproject(
            q.cast<double>(), static_cast<double>(frame.depth_m(q.y(), q.x())));
        points_c.push_back(p_c);
        if (q.x() % 2 == 0 && q.y() % 2 == 0) plane.points_c.push_back(p_c);
        plane.box_px.Include(q.cast<double>());
        EdgePoint edge{p_c, q.cast<double>(), EdgeKind::kSurface};
        bool at_edge = false;
        for (const Eigen::Vector2i& step : {Eigen::Vector2i(1, 0), Eigen::Vector2i(-1, 0),
                                            Eigen::Vector2i(0, 1), Eigen::Vector2i(0, -1)}) {
          const Eigen::Vector2i r = q + step;
          if (r.x() < 0 || r.y() < 0 || r.x() >= camera.width || r.y() >= camera.height) {
            at_edge = true;
            edge.kind = EdgeKind::kBorder;
          } else if (id(r.y(), r.x()) != id(v, u)) {
            at_edge = true;
            if (id(r.y(), r.x()) >= 0 && depth(r.y(), r.x()) < depth(q.y(), q.x()) - 0.002) {
              edge.kind = EdgeKind::kOccluded;
            }
          }
        }
        if (at_edge) plane.edge_points.push_back(edge);
      }
      plane.pixel_count = static_cast<int>(piece.size());
      const double z = depth(v, u);
      Fit(points_c, faults.depth_noise * Sigma(z), plane);
      const double cosine = std::abs(plane.pi_c.n.dot(plane.centroid_c.normalized()));
      const double zc = plane.centroid_c.z();
      plane.area_m2 =
          plane.pixel_count * zc * zc / (camera.fx * camera.fy) / std::max(0.1, cosine);
      const int detection = detection_of[static_cast<std::size_t>(source.object)];
      if (detection >= 0) {
        plane.detection = detection;
        plane.class_name = source.class_name;
      }
      bool whole = true;
      for (const auto& [a, b] :
           {std::pair(1, 1), std::pair(-1, 1), std::pair(-1, -1), std::pair(1, -1)}) {
        const Eigen::Vector3d x_c =
            T_cw * (source.center_w + a * source.half_1_w + b * source.half_2_w);
        const Eigen::Vector2d px =
            x_c.z() > 0.1 ? camera.Project(x_c) : Eigen::Vector2d(-9, -9);
        whole = whole && camera.ImageBox().Contains(px, -1) && plane.box_px.Contains(px, 2.5);
        plane.vertices_c.push_back({ProjectOnto(plane.pi_c, x_c), false});
      }
      if (!whole) plane.vertices_c.clear();
      out.truth.push_back(id(v, u));
      frame.planes.push_back(std::move(plane));
    }
  }
  frame.map_points.assign(frame.features.size(), kNone);
  return out;
}

}  // namespace slam

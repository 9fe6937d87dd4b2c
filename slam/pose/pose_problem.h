#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "slam/base/field_visitor.h"
#include "slam/geometry/box.h"
#include "slam/geometry/camera.h"
#include "slam/geometry/plane.h"
#include "slam/geometry/uncertain_pose.h"
#include "slam/pose/late_planes.h"

namespace slam {

/// f_p: a map point seen at a feature. Source: PAS-SLAM eq14, its third component as measured depth.
struct PointConstraint {
  Eigen::Vector3d p_w;
  Eigen::Vector2d u_px;        ///< undistorted
  double sigma_px = 1.0;       ///< standard deviation of u_px, each coordinate
  double depth_m = 0.0;        ///< planar z; 0: none, two residuals only
  double depth_sigma_m = 0.0;  ///< standard deviation of depth_m
};

/// f_pi: a map plane seen as a frame plane. Source: PAS-SLAM eq15, eq16 (corrected).
struct PlaneConstraint {
  Plane pi_w, pi_c;
  Eigen::Vector3d centroid_c = Eigen::Vector3d::Zero();  ///< where the offset was measured
  double angle_sigma_rad = 0.01;
  double offset_sigma_m = 0.005;
  double world_variance_m2 = 0.0;  ///< of the map plane, see PlaneEstimate; weighs nothing
};

/// f_b_pi: the box of a map plane's projected corners against a detection box. A side that
/// carries no information (image border, hidden) has its flag off. Source: PAS-SLAM eq17.
struct BoxConstraint {
  std::vector<Eigen::Vector3d> corners_w;
  Box box_obs_px;                                   ///< recorded image
  std::array<bool, 4> use{true, true, true, true};  ///< min u, min v, max u, max v
  double sigma_px = 8.0;
};

/// f_p_pi: a map point that lies on a frame plane. Source: PAS-SLAM eq18.
struct PointPlaneConstraint {
  Eigen::Vector3d p_w;
  Plane pi_c;
  double sigma_m = 0.01;
};

/// f_v: a corner of a map plane seen as a corner of the frame plane. Source: PAS-SLAM names the
/// vertices of a plane; the factor is no equation of the paper's.
struct VertexConstraint {
  Eigen::Vector3d p_w, p_c;
  /// S, S^T S in 1/m^2, of what lies along the frame plane.
  Eigen::Matrix<double, 2, 3> sqrt_information = Eigen::Matrix<double, 2, 3>::Zero();
};

/// f_pi_p and f_pi_v: a map plane parallel or perpendicular to a frame plane.
/// Source: PAS-SLAM eq19, eq20 (corrected).
struct DirectionConstraint {
  Eigen::Vector3d n_w, n_c;
  double sigma_rad = 0.02;
};

/// f_R: a rotation of the camera that was measured by itself; free about what is not observed.
/// Source: no equation of the paper's; the decoupled rotation of Manhattan frames.
struct RotationConstraint {
  Eigen::Matrix3d R_cw = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d sqrt_information = Eigen::Matrix3d::Zero();  ///< S, S^T S in 1/rad^2, of xi
};

struct PoseProblemConfig {
  int rounds = 4;  // Mur-Artal and Tardos 2017, with iterations
  int iterations = 10;
  double huber_planes = 2.0;
  bool use_points = true;
  bool use_planes = true;
  // The first two buy nothing, the last pays only where there are next to no prints: docs/back_end.md
  bool use_point_planes = false, use_boxes = false, use_vertices = false;
};

inline void VisitFields(PoseProblemConfig& c, FieldVisitor& v) {
  v.Integer("rounds", c.rounds, "[1, 10]",
            "number of rounds; after each, points are classified as inliers or outliers");
  v.Integer("iterations", c.iterations, "[1, 100]",
            "largest number of Levenberg-Marquardt steps in a round");
  v.Number("huber_planes", c.huber_planes, "(0, inf)",
           "Huber's threshold for the plane factors, in standard deviations");
  v.Flag("use_points", c.use_points, "f_p: a map point seen at a feature");
  v.Flag("use_planes", c.use_planes, "f_pi: a map plane seen as a frame plane");
  v.Flag("use_boxes", c.use_boxes, "f_b_pi: projected corners against a detection box");
  v.Flag("use_vertices", c.use_vertices, "f_v: a map plane's corner seen as a frame plane's");
  v.Flag("use_point_planes", c.use_point_planes, "f_p_pi: a map point on a frame plane");
}

/// Everything that constrains one camera pose, eq13.
struct PoseProblem {
  Pose T_cw;  ///< first guess
  std::vector<PointConstraint> points;
  std::vector<PlaneConstraint> planes;
  std::vector<BoxConstraint> boxes;
  std::vector<PointPlaneConstraint> point_planes;
  std::vector<VertexConstraint> vertices;
  std::vector<DirectionConstraint> parallels, perpendiculars;
  std::vector<RotationConstraint> rotations;
  /// Planes, whatever is made of them, were measured at another time.
  std::optional<LatePlanes> late;
  /// What was known of the pose before the frame was looked at: it holds the directions that
  /// nothing observes. None where points alone observe all six.
  std::optional<UncertainPose> prior;
};

/// What OptimisePose came to.
struct PoseSummary {
  Pose T_cw;
  bool usable = false;              ///< all six directions constrained and everything finite
  int nullity = 6;                  ///< directions of the pose that nothing constrains, 0 to 6
  std::vector<bool> point_inliers;  ///< parallel to PoseProblem::points
  int inlier_count = 0;
  /// What was measured says so at the solution; the prior apart. Where planes are off by more than
  /// they say, root mean square, all count as so much less certain.
  MotionEvidence evidence;
  /// Of the pose by all together; zero when not usable.
  Matrix6d covariance = Matrix6d::Zero();
};

/// Minimises eq13 over the camera pose by Levenberg-Marquardt with Huber weights, in rounds:
/// after each, points are classified by chi-square (95 %) and outliers left out of the next;
/// the last of several rounds is plain least squares over the inlying points. A constraint that is not
/// finite is left out. When `usable` is false, T_cw is the best pose found, finite if the first
/// guess was. Deterministic: sums run in the order of the vectors. Cost: about 1 ms for 500
/// points.
PoseSummary OptimisePose(const PoseProblem& problem, const Camera& camera,
                         const PoseProblemConfig& config);

}  // namespace slam

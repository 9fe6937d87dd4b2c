#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "slam/geometry/box.h"
#include "slam/geometry/line.h"
#include "slam/geometry/plane.h"

namespace slam {

/// Why a plane is not to be trusted (PAS-SLAM, Plane Selection). Written as in formats.md.
enum class BadReason {
  kFar,        ///< "far": too far from the camera
  kInliers,    ///< "inliers": no point on it after the re-fit, stairs, or round
  kBorder,     ///< "border": tied to a regular object's box, but at the image border
  kStructure,  ///< "structure": same, but without two pairs of parallel lines or four vertices
  kUnstructured  ///< "unstructured": most edge points in an unstructured object's box
};

/// What lies beyond a boundary point of a segment.
enum class EdgeKind {
  kSurface,   ///< the surface itself ends here: a step down to something farther, or a crease
  kOccluded,  ///< something nearer hides the rest
  kBorder,    ///< the image ends here
  kMissing    ///< no depth there
};

/// A boundary point of a plane's segment.
struct EdgePoint {
  Eigen::Vector3d p_c;   ///< on the plane's own pixels, metres, camera frame
  Eigen::Vector2d u_px;  ///< pixel, recorded image
  EdgeKind kind = EdgeKind::kSurface;
  float step_sigmas = 0.0f;  ///< depth step between the plane and what lies beyond; 0: unknown
};

/// Corners of a rectangular face.
inline constexpr std::size_t kFaceCorners = 4;

/// Standard deviation of what a corner's covariance does not hold: pose, calibration, depth that is late
/// or lies beside its colour, bends. Measured by axis: 1.3 mm for noise alone, 4 mm for a first Kinect as
/// recorded (docs/planes.md, corners).
inline constexpr double kOtherVertexSigma_m = 0.003;
inline constexpr double kOtherVertexVariance_m2 = kOtherVertexSigma_m * kOtherVertexSigma_m;

/// A corner of a rectangular face.
struct Vertex {
  Eigen::Vector3d p_c;        ///< metres, camera frame
  bool extrapolated = false;  ///< no edge points near it: it follows from the two lines alone
  /// Covariance of p_c, m^2, from the plane's fit and the two edge lines. Zero: not known.
  Eigen::Matrix3d covariance_c = Eigen::Matrix3d::Zero();
};

/// How much depth differs, off a plane, between pixels of it that are some pixels apart: half the
/// mean square, in variances of the noise; 0 where too few pixels are there to say.
struct Roughness {
  double fine = 0.0;    ///< neighbours: what noise does here
  double coarse = 0.0;  ///< 8 px apart, in small images less: noise and shape
};

/// How much a surface curves along itself, 1 / radius, in the direction in which that is surest.
/// Zero: too narrow to say.
struct SurfaceCurvature {
  double per_m = 0.0;
  double sigma_per_m = 0.0;  ///< by noise

  /// What it is at least, to 1 in 700.
  double Surely_per_m() const { return per_m - 3.0 * sigma_per_m; }
};

/// A plane seen in one frame: a segment of the depth image and all that is known of it.
/// Everything is in the camera frame, metres.
struct FramePlane {
  int index = 0;  ///< position in Frame::planes; its label image value is index + 1
  Plane pi_c;     ///< facing the camera, d > 0
  Eigen::Vector3d centroid_c = Eigen::Vector3d::Zero();
  int pixel_count = 0;
  double area_m2 = 0.0;          ///< the visible patch's
  double inlier_ratio = 1.0;     ///< after the re-fit, [0, 1]; 1 before
  Roughness roughness;           ///< off the plane
  SurfaceCurvature curvature;    ///< of the segment
  double offset_sigma_m = 0.0;   ///< standard deviation of the offset at the centroid
  double angle_sigma_rad = 0.0;  ///< standard deviation of the normal, worse of two directions
  /// What the sensor bends adds to these two and to the curvature; frames from one place share it.
  double bend_offset_sigma_m = 0.0, bend_angle_sigma_rad = 0.0, bend_curvature_per_m = 0.0;
  /// Covariance of g = -n / d, 1/m^2; the inverse depth of the plane along the ray (x, y, 1) is
  /// g . (x, y, 1). Like the two above that of the segment's fit. Zero: not known.
  Eigen::Matrix3d inverse_depth_covariance = Eigen::Matrix3d::Zero();

  std::vector<Eigen::Vector3d> points_c;  ///< inliers, thinned to a regular pixel grid
  std::vector<EdgePoint> edge_points;     ///< B_c, ordered along the contour
  Box box_px;                             ///< bounds the edge points, recorded image

  std::optional<int> detection;  ///< index into Frame::detections
  std::string class_name;        ///< that detection's; empty is the paper's class -1

  std::vector<Line> lines_c;       ///< edge lines L = (P, V)
  std::vector<Vertex> vertices_c;  ///< in order around the face; 4 when complete

  std::optional<BadReason> bad;  ///< nothing: the plane is trusted

  /// Standard deviations of offset and normal with what the sensor bends.
  double OffsetSigma_m() const { return std::hypot(offset_sigma_m, bend_offset_sigma_m); }
  double AngleSigma_rad() const { return std::hypot(angle_sigma_rad, bend_angle_sigma_rad); }
};

/// A segment that is evidence enough by itself: for a landmark, while the map has none, and for a map
/// to start on. 4,800 pixels at 640 x 480.
/// @param image_px  pixels of the depth image
inline bool IsProofAlone(const FramePlane& plane, double image_px) {
  return plane.pixel_count >= image_px / 64;
}

}  // namespace slam

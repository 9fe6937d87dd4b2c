#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "slam/base/field_visitor.h"
#include "slam/base/random.h"
#include "slam/faces/line_error.h"
#include "slam/geometry/camera.h"
#include "slam/geometry/line.h"
#include "slam/model/frame_plane.h"

namespace slam {

struct EdgeLineConfig {
  int max_lines = 6;
  int iterations = 120;
  double max_distance_px = 2.0;
  double max_gap_px = 16.0;
  double min_length_px = 10.0;
  double min_contour_share = 0.03;
  double inset_px =
      0.5;  // boundary pixels are the last inside, and centres lie half a pixel in
  /// Where a segment ends and where its surface does, after windows, votes and creases, differ
  /// along a whole side.
  double shared_sigma_px = 0.25;
  /// Where a segment ends is doubtful where depth hardly changes, at a thin step or a blunt
  /// crease: by a pixel along a whole side where the depth a few pixels beyond differs by so
  /// many sigmas, and less with the square of these.
  double doubtful_step_sigmas = 4.0;
};

inline void VisitFields(EdgeLineConfig& c, FieldVisitor& v) {
  v.Integer("max_lines", c.max_lines, "[1, 16]", "largest number of edge lines of a plane");
  v.Integer("iterations", c.iterations, "[1, 1000000]",
            "number of RANSAC's hypotheses for each line");
  v.Number("max_distance_px", c.max_distance_px, "(0, inf)",
           "largest distance of an inlier from its line");
  v.Number("max_gap_px", c.max_gap_px, "(0, inf)",
           "largest gap between neighbouring inliers of one line");
  v.Number("min_length_px", c.min_length_px, "(0, inf)", "shortest line");
  v.Number("min_contour_share", c.min_contour_share, "[0, 1)",
           "smallest share of the plane's edge points on a line");
  v.Number("inset_px", c.inset_px, "[0, 1]",
           "distance by which boundary pixels lie inside the edge itself");
  v.Number("shared_sigma_px", c.shared_sigma_px, "[0, inf)",
           "standard deviation of the error that all points of a line have in common, at "
           "either end of a side");
  v.Number("doubtful_step_sigmas", c.doubtful_step_sigmas, "[0, inf)",
           "depth step, in standard deviations, at which a side is doubtful by a pixel");
}

/// A straight piece of a plane's boundary.
struct EdgeLine {
  Line line_c;                     ///< on the plane, camera frame
  Eigen::Vector2d from_px, to_px;  ///< ends of the piece that is seen, ideal image
  int support = 0;                 ///< edge points on it
  LineError error{};               ///< that of the line through from_px and to_px
};

/// A line in the image: u = p + s v, v unit.
struct ImageLine {
  Eigen::Vector2d p = Eigen::Vector2d::Zero(), v = Eigen::Vector2d::UnitX();
  /// Ends of the supported piece.
  Eigen::Vector2d from = Eigen::Vector2d::Zero(), to = Eigen::Vector2d::Zero();
  int support = 0;
  LineError error{};
};

/// Straight lines in a set of image points, the best supported first, one after the other:
/// RANSAC (Random passed in), total least squares on the inliers, the longest piece without
/// gaps; its points are taken away and the search goes on. Points are sorted first, so their
/// order does not matter.
/// @param min_support  points that a line must hold
std::vector<ImageLine> FindImageLines(std::vector<Eigen::Vector2d> points_px, int min_support,
                                      const EdgeLineConfig& config, Random random);

/// Edge lines of a plane from those edge points where the surface itself ends
/// (EdgeKind::kSurface).
///
/// Lines are sought in the ideal image, where the noise of a silhouette is the same in all
/// directions, and intersected with the plane. Source: PAS-SLAM, Extracting Edge Lines of
/// Planes.
std::vector<EdgeLine> FindEdgeLines(const FramePlane& plane, const Camera& camera,
                                    const EdgeLineConfig& config, const Random& random);

}  // namespace slam

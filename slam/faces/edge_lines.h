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
  int max_lines = 6;             ///< domain [1, 16]
  int iterations = 120;          ///< hypotheses of RANSAC for each line; domain [1, inf)
  double max_distance_px = 2.0;  ///< from an inlier to its line; domain (0, inf)
  double max_gap_px = 16.0;      ///< between neighbouring inliers of one line; domain (0, inf)
  double min_length_px = 10.0;   ///< domain (0, inf)
  double min_contour_share = 0.03;  ///< part of the edge points on a line; domain [0, 1)
  /// Boundary pixels are the last inside the surface: their centres lie this far inside the
  /// edge itself. Domain [0, 1].
  double inset_px = 0.5;
  /// What neighbouring points of a line have in common: where a segment ends and where its
  /// surface does, after windows, votes and creases, differ along a whole side. Standard
  /// deviation at either end of a side. Domain [0, inf).
  double shared_sigma_px = 0.25;
  /// Where a segment ends is doubtful where depth hardly changes, at a thin step or a blunt
  /// crease: by a pixel along a whole side where the depth a few pixels beyond differs by so
  /// many sigmas, and less with the square of these. Domain [0, inf).
  double doubtful_step_sigmas = 4.0;
};

inline void VisitFields(EdgeLineConfig& c, FieldVisitor& v) {
  v.Integer("max_lines", c.max_lines, "[1, 16]", "of a plane");
  v.Integer("iterations", c.iterations, "[1, 1000000]", "of RANSAC, a line");
  v.Number("max_distance_px", c.max_distance_px, "(0, inf)", "of an inlier from its line");
  v.Number("max_gap_px", c.max_gap_px, "(0, inf)", "between neighbouring inliers");
  v.Number("min_length_px", c.min_length_px, "(0, inf)", "of a line");
  v.Number("min_contour_share", c.min_contour_share, "[0, 1)",
           "of the edge points that a line holds");
  v.Number("inset_px", c.inset_px, "[0, 1]", "boundary pixels lie this far inside the edge");
  v.Number("shared_sigma_px", c.shared_sigma_px, "[0, inf)",
           "error that all points of a line have in common");
  v.Number("doubtful_step_sigmas", c.doubtful_step_sigmas, "[0, inf)",
           "depth step at which a side is doubtful by a pixel");
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

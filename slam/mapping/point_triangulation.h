#pragma once

#include <optional>

#include "slam/base/field_visitor.h"
#include "slam/geometry/camera.h"
#include "slam/model/feature_scale.h"
#include "slam/model/map.h"

namespace slam {

/// When two views make a point.
struct TriangulationConfig {
  int max_distance = 50;   // Mur-Artal, Montiel, Tardos 2015, for matches that must be sure
  double max_ratio = 0.8;  // Lowe 2004
  double min_parallax_rad = 0.02;
  int neighbours = 5;
};

inline void VisitFields(TriangulationConfig& c, FieldVisitor& v) {
  v.Integer("max_distance", c.max_distance, "[0, 256]",
            "largest number of bits in which the two descriptors differ");
  v.Number("max_ratio", c.max_ratio, "(0, 1]",
           "largest ratio of the best descriptor distance to the second best");
  v.Degrees("min_parallax_deg", c.min_parallax_rad, "(0, 180)",
            "smallest angle between the two rays");
  v.Integer("neighbours", c.neighbours, "[0, 1000]",
            "number of covisible keyframes that points are triangulated with");
}

/// Point nearest to the rays of two ideal pixels (midpoint of the common perpendicular), world;
/// nothing when the rays make less than `min_parallax_rad` or meet behind a camera.
std::optional<Eigen::Vector3d> Triangulate(const Eigen::Vector2d& u_1_px, const Pose& T_1w,
                                           const Eigen::Vector2d& u_2_px, const Pose& T_2w,
                                           const Camera& camera, double min_parallax_rad);

/// Makes points of features that have none in `keyframe` and in a covisible one: matched along
/// the epipolar line, triangulated, and kept when both views agree. @returns how many.
int TriangulatePoints(Map& map, int keyframe, const Camera& camera, const FeatureScale& scale,
                      const TriangulationConfig& config);

}  // namespace slam

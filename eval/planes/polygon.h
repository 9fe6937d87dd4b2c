#pragma once

#include <Eigen/Core>
#include <vector>

#include "eval/formats/plane.h"

namespace eval {

using Polygon2 = std::vector<Eigen::Vector2d>;

/// Coordinates in a plane: origin on it and two unit axes. The area keeps its unit.
struct PlaneChart {
  Eigen::Vector3d origin, axis_u, axis_v;

  Eigen::Vector2d operator()(const Eigen::Vector3d& x) const {
    return {axis_u.dot(x - origin), axis_v.dot(x - origin)};
  }
};

/// A chart of the plane with its origin at the foot of `near`.
PlaneChart ChartOf(const Plane& pi, const Eigen::Vector3d& near);

/// Charted points, in their order.
Polygon2 Project(const PlaneChart& chart, const std::vector<Eigen::Vector3d>& points);

/// Counter-clockwise hull without collinear points; fewer than 3 points if there is no area.
Polygon2 ConvexHull(Polygon2 points);

/// Whether a simple loop, which may turn inwards, goes round a point; both seen along z.
bool GoesRoundFromAbove(const std::vector<Eigen::Vector3d>& loop, const Eigen::Vector3d& point);

/// Area of a simple polygon, not signed.
double Area(const Polygon2& polygon);

/// Common area of two convex counter-clockwise polygons.
double IntersectionArea(const Polygon2& a, const Polygon2& b);

/// Distance from a point to a convex counter-clockwise polygon, 0 inside.
double Distance(const Eigen::Vector2d& point, const Polygon2& polygon);

/// Symmetric Hausdorff distance of two convex counter-clockwise polygons, each with what it encloses:
/// how far the farthest point of either is from the other.
double HausdorffDistance(const Polygon2& a, const Polygon2& b);

}  // namespace eval

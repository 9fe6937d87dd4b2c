#pragma once

#include <optional>
#include <vector>

#include "slam/base/field_visitor.h"
#include "slam/model/frame.h"
#include "slam/model/map.h"
#include "slam/structure/rotation_from_axes.h"

namespace slam {

/// Structure "manhattan" and "mixture": when planes count as at right angles.
struct ManhattanConfig {
  double max_axis_angle_rad = 0.05;
  double axis_sigma_rad = 0.0087;  // 0.5 degrees: ManhattanSLAM, PlanarSLAM and SP-SLAM
  double min_area_m2 = 0.05;
  double min_axis_area_m2 = 0.2;
  int min_observations = 5;
  double max_pair_angle_rad = 0.01;  // ManhattanSLAM: |n . n'| < 0.01
};

inline void VisitFields(ManhattanConfig& c, FieldVisitor& v) {
  v.Degrees(
      "max_axis_angle_deg", c.max_axis_angle_rad, "(0, 28)",
      "manhattan: largest angle between a plane's normal and its axis; others are ignored");
  v.Degrees("axis_sigma_deg", c.axis_sigma_rad, "(0, 90)",
            "standard deviation of an axis, besides the measured one: how square things are");
  v.Number("min_area_m2", c.min_area_m2, "[0, inf)", "smallest area of a plane that counts");
  v.Number("min_axis_area_m2", c.min_axis_area_m2, "(0, inf)",
           "manhattan: landmarks of so much area together must face along each of three axes");
  v.Integer("min_observations", c.min_observations, "[1, 100000]",
            "manhattan: smallest number of observations of such a landmark");
  v.Degrees("max_pair_angle_deg", c.max_pair_angle_rad, "(0, 28)",
            "mixture: largest angle by which planes of one frame miss a right angle");
}

/// Structure "manhattan": one Manhattan frame for the whole map, held from when it was found.
///
/// The axes of the world that its landmarks' normals say, columns: three directions at right
/// angles, each with enough area facing along it either way, of all such the one with most area.
/// None: the world has none, or has not shown it yet.
/// Source: Structure-SLAM (Li, Brasch, Wang, Navab, Tombari 2020), which takes them from the
/// first frame; here they wait for landmarks.
std::optional<Eigen::Matrix3d> FindManhattanAxes(const MapPlanes& planes,
                                                 const ManhattanConfig& config);

/// What a frame's trusted planes say of the axes: for each, the mean of the normals in a cone
/// about it, either way (one step of the mean shift of Zhou, Kneip, Rodriguez, Li 2016). Axes
/// that no plane faces along are left out, and so are planes off all axes.
/// @param axes_w  columns
std::vector<AxisObservation> SeenAxes(const Frame& frame, const Eigen::Matrix3d& axes_w,
                                      const ManhattanConfig& config);

}  // namespace slam

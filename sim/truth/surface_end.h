#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "sim/base/pose.h"
#include "sim/shapes/mesh.h"
#include "sim/trace/exact_cast.h"

namespace sim {

/// Where surfaces break off as the camera sees them: behind the edge lies nothing, or something
/// further away. At a crease, where a side of a box stands on the desk or two sides that are
/// both seen meet, the surface goes on. Decided in double, with the scene's triangles alone.
class SurfaceEnds {
 public:
  explicit SurfaceEnds(std::span<const Triangle> triangles);

  /// Whether in some direction kBeside from a seen point, the ray meets nothing, or passes the
  /// point by kBreak_m or more and meets a face whose plane does not hold the point.
  /// @pre the camera sees the point
  bool At(const Pose& T_wc, const Eigen::Vector3d& x_w) const;

  /// Share of the way to the point: a thousandth of a pixel.
  static constexpr double kBeside = 2e-6;
  static constexpr double kBreak_m = 2e-4;  ///< twice what a scene allows touching bodies
  static constexpr int kDirections = 16;

 private:
  ExactCaster caster_;
  std::vector<std::array<Eigen::Vector3d, 3>> corners_w_;
};

}  // namespace sim

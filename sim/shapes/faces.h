#pragma once

#include <Eigen/Core>
#include <array>

#include "sim/scene/scene.h"

namespace sim {

/// The order in which the faces of a box become planes.
inline constexpr std::array<Face, 6> kFaces{Face::kMinusX, Face::kPlusX,  Face::kMinusY,
                                            Face::kPlusY,  Face::kMinusZ, Face::kPlusZ};

/// Directions of a face in the object's frame; u x v = normal, so print is never mirrored.
struct FaceAxes {
  Eigen::Vector3d normal, u, v;
};
FaceAxes AxesOf(Face face);

/// A face in the world. Corners at (u, v) = (0, 0), (U, 0), (U, V), (0, V): counter-clockwise
/// seen from the front; size_m = (U, V).
struct FaceRectangle {
  Eigen::Vector3d n_w, center_w;
  Eigen::Vector2d size_m;
  std::array<Eigen::Vector3d, 4> corners_w;
};
FaceRectangle RectangleOf(const Object& object, Face face);

}  // namespace sim

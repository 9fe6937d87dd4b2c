#include "sim/shapes/faces.h"

#include "sim/scene/geometry.h"

namespace sim {

FaceAxes AxesOf(Face face) {
  using Eigen::Vector3d;
  switch (face) {
    case Face::kMinusX:
      return {-Vector3d::UnitX(), -Vector3d::UnitY(), Vector3d::UnitZ()};
    case Face::kPlusX:
      return {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
    case Face::kMinusY:
      return {-Vector3d::UnitY(), Vector3d::UnitX(), Vector3d::UnitZ()};
    case Face::kPlusY:
      return {Vector3d::UnitY(), -Vector3d::UnitX(), Vector3d::UnitZ()};
    case Face::kMinusZ:
      return {-Vector3d::UnitZ(), -Vector3d::UnitX(), Vector3d::UnitY()};
    case Face::kPlusZ:
      break;
  }
  return {Vector3d::UnitZ(), Vector3d::UnitX(), Vector3d::UnitY()};
}

FaceRectangle RectangleOf(const Object& object, Face face) {
  const FaceAxes axes = AxesOf(face);
  const Pose T_wo = ObjectPose(object);
  const Eigen::Vector3d half = object.size / 2;
  const Eigen::Vector3d center_o = axes.normal.cwiseProduct(half);
  const Eigen::Vector3d u_o = axes.u.cwiseProduct(half), v_o = axes.v.cwiseProduct(half);
  FaceRectangle rectangle;
  rectangle.n_w = T_wo.R * axes.normal;
  rectangle.center_w = T_wo * center_o;
  rectangle.size_m = {2 * u_o.cwiseAbs().sum(), 2 * v_o.cwiseAbs().sum()};
  const std::array<Eigen::Vector3d, 4> corners_o{
      Eigen::Vector3d(center_o - u_o - v_o), Eigen::Vector3d(center_o + u_o - v_o),
      Eigen::Vector3d(center_o + u_o + v_o), Eigen::Vector3d(center_o - u_o + v_o)};
  for (std::size_t i = 0; i < 4; ++i) rectangle.corners_w[i] = T_wo * corners_o[i];
  return rectangle;
}

}  // namespace sim

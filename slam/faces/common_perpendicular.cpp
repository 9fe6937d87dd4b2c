#include "slam/faces/common_perpendicular.h"

#include <cmath>

namespace slam {

std::optional<PerpendicularFeet> CommonPerpendicular(const Line& L_i, const Line& L_j,
                                                     double min_angle_rad) {
  const double length_i = L_i.V.norm(), length_j = L_j.V.norm();
  if (!(length_i > 0 && length_j > 0 && std::isfinite(length_i) && std::isfinite(length_j))) {
    return std::nullopt;
  }
  const Eigen::Vector3d V_i = L_i.V / length_i, V_j = L_j.V / length_j;
  const Eigen::Vector3d &P_i = L_i.P, &P_j = L_j.P;
  if (!P_i.allFinite() || !P_j.allFinite()) return std::nullopt;

  // V_j . V_j - (V_i . V_j)^2 for unit directions, without the cancellation at small angles.
  const double sin2 = V_i.cross(V_j).squaredNorm();
  const double sin_min = std::sin(min_angle_rad);
  if (!(sin2 > sin_min * sin_min)) return std::nullopt;

  const double K_j = (P_i - P_j + (P_j - P_i).dot(V_i) * V_i).dot(V_j) / sin2;  // eq5
  const Eigen::Vector3d P_pj = P_j + K_j * V_j;                                 // eq2
  const Eigen::Vector3d P_pi = P_i + (P_pj - P_i).dot(V_i) * V_i;               // eq3
  return PerpendicularFeet{P_pi, P_pj};
}

}  // namespace slam

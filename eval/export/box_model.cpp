#include "eval/export/box_model.h"

#include <array>
#include <cmath>
#include <sstream>

namespace eval {
namespace {

constexpr double kSame = 1e-5;  ///< metres, and of a unit vector

}  // namespace

bool IsBox(const SceneTruth& scene, const TruthObject& object) {
  std::array<int, 6> faces{};
  int count = 0;
  for (const TruthPlane& plane : scene.planes) {
    if (plane.object != object.id) continue;
    ++count;
    const Eigen::Vector3d n_o = object.R_go.transpose() * plane.pi_g.n;
    Eigen::Index axis = 0;
    n_o.cwiseAbs().maxCoeff(&axis);
    const double from_centre = -(plane.pi_g.n.dot(object.center_g) + plane.pi_g.d);
    if (std::abs(std::abs(n_o[axis]) - 1) > kSame) return false;
    if (std::abs(from_centre - object.size_m[axis] / 2) > kSame) return false;
    ++faces[static_cast<std::size_t>(2 * axis + (n_o[axis] > 0 ? 1 : 0))];
  }
  return count == 6 && faces == std::array<int, 6>{1, 1, 1, 1, 1, 1};
}

std::string BoxPly(const Eigen::Vector3d& size_m) {
  std::ostringstream vertices, faces;
  vertices.precision(9);
  int first = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const Eigen::Vector3d n = sign * Eigen::Vector3d::Unit(axis);
      const Eigen::Vector3d u = Eigen::Vector3d::Unit((axis + 1) % 3), v = n.cross(u);
      for (const auto& [a, b] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        const Eigen::Vector3d x = 500 * (n + a * u + b * v).cwiseProduct(size_m);
        vertices << x.x() << ' ' << x.y() << ' ' << x.z() << ' ' << n.x() + 0.0 << ' '
                 << n.y() + 0.0 << ' ' << n.z() + 0.0 << '\n';
      }
      faces << "3 " << first << ' ' << first + 1 << ' ' << first + 2 << "\n3 " << first << ' '
            << first + 2 << ' ' << first + 3 << '\n';
      first += 4;
    }
  }
  return "ply\nformat ascii 1.0\ncomment a box, millimetres\nelement vertex 24\n"
         "property float x\nproperty float y\nproperty float z\n"
         "property float nx\nproperty float ny\nproperty float nz\n"
         "element face 12\nproperty list uchar int vertex_indices\nend_header\n" +
         vertices.str() + faces.str();
}

nlohmann::ordered_json BoxInfo(const Eigen::Vector3d& size_m) {
  const Eigen::Vector3d size = 1000 * size_m;
  return {{"diameter", size.norm()}, {"min_x", -size.x() / 2}, {"min_y", -size.y() / 2},
          {"min_z", -size.z() / 2},  {"size_x", size.x()},     {"size_y", size.y()},
          {"size_z", size.z()}};
}

}  // namespace eval

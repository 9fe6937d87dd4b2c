#include "slam/mapping/bundle/coplanar_points.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "slam/base/chi_square.h"

namespace slam {
namespace {

/// Normal equations of a point alone, its viewers' poses as they are.
struct PointAlone {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
};

std::map<std::size_t, PointAlone> HeldPointsAlone(const BundleWindow& window) {
  std::map<std::size_t, PointAlone> alone;
  for (const BundleWindow::Observation& o : window.observations) {
    if (!o.inlier || !window.IsHeld(o.position_at)) continue;
    const double* blocks[] = {window.poses[o.pose_at].data(),
                              window.positions[o.position_at].data()};
    Eigen::Vector3d r;
    Eigen::Matrix3d J_transposed;  // the term fills rows in, which are columns here
    double* jacobians[] = {nullptr, J_transposed.data()};
    o.term->Evaluate(blocks, r.data(), jacobians);
    PointAlone& sum = alone[o.position_at];
    sum.information += J_transposed * J_transposed.transpose();
    sum.gradient += J_transposed * r;
  }
  return alone;
}

}  // namespace

void HoldToPlane(const MapPlane& landmark, BundleWindow& window) {
  const std::size_t plane_at = window.planes.size() - 1;
  const WindowPlane& plane = window.planes.back();
  for (const int id : landmark.map_points) {
    const auto at = std::lower_bound(window.points.begin(), window.points.end(), id);
    if (at == window.points.end() || *at != id) continue;
    window.coplanar.try_emplace(
        static_cast<std::size_t>(at - window.points.begin()),
        BundleWindow::CoplanarPoint{plane_at, PlaneAxes(plane.start_w, plane.reference_w)});
  }
  for (BundleWindow::Observation& o : window.observations) {
    const auto at = window.coplanar.find(o.position_at);
    if (at != window.coplanar.end() && at->second.plane_at == plane_at)
      o.in_plane = std::make_unique<InPlaneTerm<3>>(*o.term, at->second.axes);
  }
}

void PlaceInPlanes(BundleWindow& window) {
  for (const auto& [at, point] : window.coplanar) {
    if (!point.held) continue;
    auto& position = window.positions[at];
    const InPlaneBlock block =
        point.axes.BlockOf(Eigen::Map<const Eigen::Vector3d>(position.data()));
    std::copy(block.begin(), block.end(), position.begin());
  }
}

void PlaceInWorld(BundleWindow& window) {
  for (const auto& [at, point] : window.coplanar) {
    if (!point.held) continue;
    auto& position = window.positions[at];
    const InPlanePoint place =
        PointOf(point.axes, window.plane_blocks[point.plane_at].data(), position.data());
    Eigen::Map<Eigen::Vector3d>{position.data()} = place.p_w;
  }
}

void LetGoOfThoseOff(double sigma_m, BundleWindow& window) {
  for (const auto& [at, alone] : HeldPointsAlone(window)) {
    BundleWindow::CoplanarPoint& point = window.coplanar.at(at);
    const Eigen::LDLT<Eigen::Matrix3d> solver(alone.information);
    const Eigen::Vector3d n =
        Eigen::Map<const Eigen::Vector3d>(window.plane_blocks[point.plane_at].data());
    const Eigen::Vector3d step_w = -solver.solve(alone.gradient);
    const double off_m = n.dot(step_w), variance_m2 = n.dot(solver.solve(n));
    if (!(off_m * off_m > kChi2Of1At95 * (sigma_m * sigma_m + variance_m2))) continue;
    point.held = false;
    Eigen::Map<Eigen::Vector3d>{window.positions[at].data()} += step_w;
  }
}

}  // namespace slam

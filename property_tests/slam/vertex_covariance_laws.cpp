#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>

#include "property_tests/generators/poses.h"
#include "slam/faces/vertex_covariance.h"

namespace slam {
namespace {

/// A corner with the errors that it depends on. Principal point in the middle and square
/// pixels, so that a turn about the optical axis is a turn of the image about (0, 0).
struct AnyCorner {
  AnyCorner() {
    camera.fy = camera.fx, camera.cx = 0, camera.cy = 0;
    const double turn = AnyReal(-3.0, 3.0), crossing = AnyReal(0.4, 2.7);
    u_px = {AnyReal(-250, 250), AnyReal(-200, 200)};
    line_i = AnyLine(turn), line_j = AnyLine(turn + crossing);
    Eigen::Vector3d n(AnyReal(-0.7, 0.7), AnyReal(-0.7, 0.7), -1.0);
    n.normalize();
    plane.pi_c = {n, AnyReal(0.4, 3.0)};
    const Eigen::Vector3d ray = camera.Backproject(u_px, 1.0);
    RC_PRE(n.dot(ray) < -0.1);
    p_c = ray * (-plane.pi_c.d / n.dot(ray));
    Eigen::Matrix3d a;
    for (int k = 0; k < 9; ++k) a(k / 3, k % 3) = AnyReal(-0.01, 0.01);
    plane.inverse_depth_covariance = a * a.transpose();
  }
  LineError AnyLine(double angle) const {
    const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
    return {u_px + AnyReal(-200, 200) * along, along, AnyReal(0.001, 1.0), AnyReal(0.0, 1e-4)};
  }
  Eigen::Matrix3d Covariance() const {
    return VertexCovariance(plane, line_i, line_j, p_c, camera);
  }
  Camera camera;
  FramePlane plane;
  Eigen::Vector2d u_px;
  LineError line_i, line_j;
  Eigen::Vector3d p_c;
};

/// The corner's place when its lines are moved across themselves and its plane's g by dg.
Eigen::Vector3d Moved(const AnyCorner& c, double across_i, double across_j,
                      const Eigen::Vector3d& dg) {
  const auto line = [](const LineError& l, double across) {
    const Eigen::Vector3d p =
        (l.at_px + across * Eigen::Vector2d(-l.along.y(), l.along.x())).homogeneous();
    return Eigen::Vector3d(p.cross((p.head<2>() + l.along).eval().homogeneous()));
  };
  const Eigen::Vector2d u =
      line(c.line_i, across_i).cross(line(c.line_j, across_j)).hnormalized();
  const Eigen::Vector3d ray = c.camera.Backproject(u, 1.0);
  return ray / (dg - c.plane.pi_c.n / c.plane.pi_c.d).dot(ray);
}

RC_GTEST_PROP(VertexCovariance, IsSymmetricAndNowhereNegative, ()) {
  const Eigen::Matrix3d covariance = AnyCorner().Covariance();
  const double size = covariance.norm();
  RC_ASSERT(size > 0);
  RC_ASSERT((covariance - covariance.transpose()).norm() <= 1e-12 * size);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance);
  RC_ASSERT(axes.eigenvalues().minCoeff() >= -1e-9 * size);
}

RC_GTEST_PROP(VertexCovariance, IsTheSumOfWhatEachErrorMovesTheCorner, ()) {
  const AnyCorner c;
  // Central differences of the exact construction, one standard deviation at a time, small.
  const double h = 1e-4;
  Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
  const auto add = [&](double i, double j, const Eigen::Vector3d& dg) {
    const Eigen::Vector3d d =
        (Moved(c, h * i, h * j, h * dg) - Moved(c, -h * i, -h * j, -h * dg)) / (2 * h);
    expected += d * d.transpose();
  };
  const auto sigma = [&](const LineError& l) {
    const double lever = (c.u_px - l.at_px).norm();
    return std::sqrt(l.offset_px2 + lever * lever * l.angle_rad2);
  };
  add(sigma(c.line_i), 0, Eigen::Vector3d::Zero());
  add(0, sigma(c.line_j), Eigen::Vector3d::Zero());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(c.plane.inverse_depth_covariance);
  for (int k = 0; k < 3; ++k) {
    add(0, 0, std::sqrt(std::max(axes.eigenvalues()[k], 0.0)) * axes.eigenvectors().col(k));
  }
  RC_ASSERT((c.Covariance() - expected).norm() <= 1e-4 * expected.norm());
}

RC_GTEST_PROP(VertexCovariance, DoesNotDependOnWhichLineIsFirst, ()) {
  AnyCorner c;
  const Eigen::Matrix3d before = c.Covariance();
  std::swap(c.line_i, c.line_j);
  c.line_i.along = -c.line_i.along;  // nor on the sense of a line
  RC_ASSERT((c.Covariance() - before).norm() <= 1e-9 * before.norm());
}

RC_GTEST_PROP(VertexCovariance, TurnsWithTheCameraAboutItsAxis, ()) {
  AnyCorner c;
  const Eigen::Matrix3d before = c.Covariance();
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(AnyReal(-3.0, 3.0), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Matrix2d R_px = R.topLeftCorner<2, 2>();
  for (LineError* line : {&c.line_i, &c.line_j}) {
    line->at_px = R_px * line->at_px;
    line->along = R_px * line->along;
  }
  c.plane.pi_c.n = R * c.plane.pi_c.n;
  c.plane.inverse_depth_covariance = R * c.plane.inverse_depth_covariance * R.transpose();
  c.p_c = R * c.p_c;
  RC_ASSERT((c.Covariance() - R * before * R.transpose()).norm() <= 1e-9 * before.norm());
}

RC_GTEST_PROP(VertexCovariance, GrowsWithTheSquareOfTheNoise, ()) {
  AnyCorner c;
  const Eigen::Matrix3d before = c.Covariance();
  const double times = AnyReal(0.1, 10.0);
  for (LineError* line : {&c.line_i, &c.line_j}) {
    line->offset_px2 *= times * times, line->angle_rad2 *= times * times;
  }
  c.plane.inverse_depth_covariance *= times * times;
  RC_ASSERT((c.Covariance() - times * times * before).norm() <=
            1e-9 * times * times * before.norm());
}

}  // namespace
}  // namespace slam

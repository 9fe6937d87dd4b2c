#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <opencv2/core.hpp>

#include "property_tests/generators/poses.h"
#include "slam/mapping/bundle/bundle_terms.h"
#include "slam/pose/factors/plane.h"
#include "slam/pose/factors/point_plane.h"
#include "slam/pose/point_constraints.h"
#include "tests/support/point_world.h"

// P36 for the full problem: poses, points and planes that all move. What no measurement tells
// is where the world lies, six directions, and nothing else.
namespace slam {
namespace {

/// Columns: 6 a keyframe (T_cw <- Exp(xi) T_cw), 3 a point, 3 a plane (turn about two tangents,
/// offset).
struct FullProblem {
  PointWorld world;
  std::vector<int> points;  ///< seen by two keyframes at least
  std::vector<Plane> planes_w;
  bool depth = true;

  int PointColumn(std::size_t i) const {
    return 6 * static_cast<int>(world.map.keyframes.size()) + 3 * static_cast<int>(i);
  }
  int PlaneColumn(std::size_t i) const {
    return PointColumn(points.size()) + 3 * static_cast<int>(i);
  }
  int Columns() const { return PlaneColumn(planes_w.size()); }
};

FullProblem AnyFullProblem(bool depth) {
  FullProblem problem;
  problem.depth = depth;
  problem.world = MakePointWorld(AnyInt(2, 4), AnyInt(25, 40),
                                 static_cast<std::uint64_t>(AnyInt(0, 1 << 20)), AnyInt(1, 3));
  for (const MapPoint& point : problem.world.map.points) {
    if (point.observations.size() > 1) problem.points.push_back(point.id);
  }
  const int planes = depth ? AnyInt(1, 3) : 0;
  for (int i = 0; i < planes; ++i) {
    const Eigen::Vector3d n = Eigen::Vector3d(AnyReal(-1, 1), AnyReal(-1, 1), -1).normalized();
    problem.planes_w.push_back({n, AnyReal(1, 3)});
  }
  return problem;
}

Plane Moved(const Plane& plane, int column, double step) {
  Plane moved = plane;
  if (column == 2) {
    moved.d += step;
  } else {
    moved.n = ExpSo3(step * TangentBasis(plane.n).col(column)) * plane.n;
  }
  return moved;
}

class Rows {
 public:
  explicit Rows(int columns) : columns_(columns) {}
  Eigen::MatrixXd& Add(int rows) {
    blocks_.emplace_back(Eigen::MatrixXd::Zero(rows, columns_));
    return blocks_.back();
  }
  Eigen::MatrixXd Stacked() const {
    Eigen::Index rows = 0;
    for (const auto& block : blocks_) rows += block.rows();
    Eigen::MatrixXd J(rows, columns_);
    rows = 0;
    for (const auto& block : blocks_) {
      J.middleRows(rows, block.rows()) = block;
      rows += block.rows();
    }
    return J;
  }

 private:
  int columns_;
  std::vector<Eigen::MatrixXd> blocks_;
};

void AddPoints(const FullProblem& problem, Rows& rows) {
  const Map& map = problem.world.map;
  for (std::size_t i = 0; i < problem.points.size(); ++i) {
    const MapPoint& point = map.points[static_cast<std::size_t>(problem.points[i])];
    for (const auto& [k, f] : point.observations) {
      const Keyframe& keyframe = map.keyframes[static_cast<std::size_t>(k)];
      PointFeature feature = keyframe.features[static_cast<std::size_t>(f)];
      if (!problem.depth) feature.depth_m = 0;
      const BundleTerm term(ConstraintOf(feature, point.p_w, {}), problem.world.camera);
      const PoseBlock pose = BlockOf(keyframe.T_cw);
      const double* parameters[] = {pose.data(), point.p_w.data()};
      Eigen::Matrix<double, 3, 7, Eigen::RowMajor> by_pose;
      Eigen::Matrix<double, 3, 3, Eigen::RowMajor> by_point;
      double* jacobians[] = {by_pose.data(), by_point.data()};
      Eigen::Vector3d r;
      RC_ASSERT(term.Evaluate(parameters, r.data(), jacobians));
      Eigen::MatrixXd& J = rows.Add(3);
      J.middleCols<6>(6 * k) = by_pose.leftCols<6>();
      J.middleCols<3>(problem.PointColumn(i)) = by_point;
    }
  }
}

/// The plane as each keyframe measures it, and the first point as one on its frame plane.
void AddPlanes(const FullProblem& problem, Rows& rows) {
  for (const Keyframe& keyframe : problem.world.map.keyframes) {
    for (std::size_t i = 0; i < problem.planes_w.size(); ++i) {
      const Plane& pi_w = problem.planes_w[i];
      const Plane pi_c = Transform(keyframe.T_cw, pi_w);
      const Eigen::Vector3d centroid_c = ProjectOnto(pi_c, {0.1, -0.2, 1.5});
      const auto factor = [&](const Plane& plane_w) {
        return PlaneFactor({plane_w, pi_c, centroid_c}, keyframe.T_cw);
      };
      Eigen::MatrixXd& J = rows.Add(4);
      J.middleCols<6>(6 * keyframe.id) = factor(pi_w).J;
      for (int column = 0; column < 3; ++column) {
        const auto at = [&](double step) { return factor(Moved(pi_w, column, step)).r; };
        constexpr double h = 1e-3;
        J.col(problem.PlaneColumn(i) + column) =
            (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
      }
    }
  }
}

Eigen::MatrixXd JacobianOf(const FullProblem& problem) {
  Rows rows(problem.Columns());
  AddPoints(problem, rows);
  AddPlanes(problem, rows);
  return rows.Stacked();
}

/// The world moved by Exp(xi) for each of six xi: what it does to every pose, point and plane.
Eigen::MatrixXd Gauge(const FullProblem& problem) {
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(problem.Columns(), 6);
  for (const Keyframe& keyframe : problem.world.map.keyframes) {
    G.middleRows<6>(6 * keyframe.id) = -Adjoint(keyframe.T_cw);
  }
  for (std::size_t i = 0; i < problem.points.size(); ++i) {
    const MapPoint& p = problem.world.map.points[static_cast<std::size_t>(problem.points[i])];
    G.block<3, 3>(problem.PointColumn(i), 0).setIdentity();
    G.block<3, 3>(problem.PointColumn(i), 3) = -Hat(p.p_w);
  }
  for (std::size_t i = 0; i < problem.planes_w.size(); ++i) {
    const Plane& pi = problem.planes_w[i];
    const int row = problem.PlaneColumn(i);
    // The normal turns about omega, of which the part along it does nothing.
    G.block<2, 3>(row, 3) = TangentBasis(pi.n).transpose();
    G.block<1, 3>(row + 2, 0) = -pi.n.transpose();
  }
  return G;
}

/// Null directions by singular values, the columns brought to one length.
int NullityOf(Eigen::MatrixXd J) {
  for (int i = 0; i < J.cols(); ++i) {
    if (J.col(i).norm() > 0) J.col(i).normalize();
  }
  cv::Mat1d values;  // OpenCV's: Eigen's takes the compiler a minute
  cv::SVD::compute(cv::Mat1d(static_cast<int>(J.cols()), static_cast<int>(J.rows()), J.data()),
                   values, cv::SVD::NO_UV);
  return static_cast<int>(J.cols()) - cv::countNonZero(values >= 1e-9 * values(0));
}

RC_GTEST_PROP(FullProblemP36, LeavesTheSixDirectionsOfTheWorldOpenAndNoOther, ()) {
  const FullProblem problem = AnyFullProblem(true);
  const Eigen::MatrixXd J = JacobianOf(problem), G = Gauge(problem);
  RC_ASSERT((J * G).cwiseAbs().maxCoeff() < 1e-8 * J.cwiseAbs().maxCoeff());
  RC_ASSERT(NullityOf(J) == 6);
  RC_ASSERT(NullityOf(J.rightCols(J.cols() - 6)) == 0);  // the first pose held
}

RC_GTEST_PROP(FullProblemP36, LeavesTheScaleOpenTooWithoutDepth, ()) {
  const Eigen::MatrixXd J = JacobianOf(AnyFullProblem(false));
  RC_ASSERT(NullityOf(J) == 7);
}

}  // namespace
}  // namespace slam

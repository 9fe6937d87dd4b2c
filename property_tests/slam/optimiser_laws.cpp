#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "property_tests/generators/planes.h"
#include "slam/pose/pose_problem.h"
#include "slam/pose/solve.h"

namespace slam {
namespace {

/// A camera, and `points` stereo features and `planes` planes that it sees without noise.
PoseProblem ExactProblem(const Pose& T_cw, int points, int planes) {
  const Camera camera;
  const Pose T_wc = Inverse(T_cw);
  PoseProblem problem;
  problem.T_cw = T_cw;
  for (int i = 0; i < points; ++i) {
    PointConstraint c;
    const double z = AnyReal(0.8, 4);
    c.u_px = {AnyReal(60, 600), AnyReal(20, 460)};
    c.p_w = T_wc * camera.Backproject(c.u_px, z);
    c.depth_m = z, c.depth_sigma_m = AnyReal(0.001, 0.1);
    problem.points.push_back(c);
  }
  for (int i = 0; i < planes; ++i) {
    const SeenPlane seen = AnySeenPlane();
    PlaneConstraint c;
    c.pi_c = seen.pi_c;
    c.centroid_c = seen.point_c;
    c.pi_w = Transform(T_wc, seen.pi_c);
    problem.planes.push_back(c);
  }
  return problem;
}

RC_GTEST_PROP(PoseOptimiserEq13, StaysAtTruth, ()) {
  const PoseProblem problem = ExactProblem(AnyPose(3), 30, 3);
  const PoseSummary summary = OptimisePose(problem, Camera{}, {});
  RC_ASSERT(RotationAngle(summary.T_cw, problem.T_cw) < 1e-7);
  RC_ASSERT((summary.T_cw.t - problem.T_cw.t).norm() < 1e-9);
}

RC_GTEST_PROP(PoseOptimiserEq13, ConvergesToTruthFromFiveDegreesAndFiveCentimetres, ()) {
  PoseProblem problem = ExactProblem(AnyPose(3), 40, AnyInt(0, 3));
  const Pose truth = problem.T_cw;
  problem.T_cw = AnyMotion(0.087, 0.05) * truth;
  const PoseSummary summary = OptimisePose(problem, Camera{}, {});
  RC_ASSERT(summary.usable);
  RC_ASSERT(summary.inlier_count == 40);
  // LogSo3 of a rotation matrix has a floor of sqrt(eps) = 1.5e-8 near zero.
  RC_ASSERT(RotationAngle(summary.T_cw, truth) < 1e-7);
  RC_ASSERT((summary.T_cw.t - truth.t).norm() < 1e-8);
}

RC_GTEST_PROP(PoseOptimiserEq13, FollowsTheWorldWhenItIsMoved, ()) {
  PoseProblem here = ExactProblem(AnyPose(3), 20, 2);
  here.T_cw = AnyMotion(0.05, 0.03) * here.T_cw;
  for (PointConstraint& c : here.points) c.u_px += Eigen::Vector2d(AnyNormal(), AnyNormal());
  // Known before as well as the points tell it, differently along each axis of the camera.
  Vector6d variances;
  for (int i = 0; i < 6; ++i) variances[i] = std::pow(10.0, AnyReal(-7, -5));
  here.prior = UncertainPose{AnyMotion(0.05, 0.03) * here.T_cw, variances.asDiagonal()};
  const Pose T_vw = AnyPose(5), T_wv = Inverse(T_vw);
  PoseProblem there = here;
  there.T_cw = here.T_cw * T_wv;
  there.prior->T_cw = here.prior->T_cw * T_wv;
  for (PointConstraint& c : there.points) c.p_w = T_vw * c.p_w;
  for (PlaneConstraint& c : there.planes) c.pi_w = Transform(T_vw, c.pi_w);
  const PoseSummary a = OptimisePose(here, Camera{}, {}), b = OptimisePose(there, Camera{}, {});
  RC_ASSERT(a.point_inliers == b.point_inliers);
  RC_ASSERT((a.T_cw.t - (b.T_cw * T_vw).t).norm() < 1e-5);
  RC_ASSERT(RotationAngle(a.T_cw, b.T_cw * T_vw) < 1e-5);
}

/// Planes seen head-on enough, with these normals in the world.
int PlaneNullity(const std::vector<Eigen::Vector3d>& normals_w, const Pose& T_cw) {
  PoseProblem problem;
  problem.T_cw = T_cw;
  for (const Eigen::Vector3d& n_w : normals_w) {
    PlaneConstraint c;
    c.pi_w = {n_w, AnyReal(-3, 3)};
    c.pi_c = Transform(T_cw, c.pi_w);
    c.centroid_c = ProjectOnto(c.pi_c, AnyPoint(2));
    problem.planes.push_back(c);
  }
  return OptimisePose(problem, Camera{}, {}).nullity;
}

RC_GTEST_PROP(PoseOptimiserEq13, ReportsTheDirectionsThatPlanesLeaveOpen, ()) {
  const Pose T_cw = AnyPose(3);
  const Eigen::Matrix3d R = AnyPose(1).R;
  const Eigen::Vector3d a = R.col(0);
  const Eigen::Vector3d b = (R.col(1) + AnyReal(-0.5, 0.5) * a).normalized();
  const Eigen::Vector3d c = (R.col(2) + AnyReal(-0.5, 0.5) * a).normalized();
  RC_ASSERT(PlaneNullity({}, T_cw) == 6);
  RC_ASSERT(PlaneNullity({a}, T_cw) == 3);
  RC_ASSERT(PlaneNullity({a, -a}, T_cw) == 3);
  RC_ASSERT(PlaneNullity({a, b}, T_cw) == 1);
  RC_ASSERT(PlaneNullity({a, b, (a + b).normalized()}, T_cw) == 1);
  RC_ASSERT(PlaneNullity({a, b, c}, T_cw) == 0);
}

RC_GTEST_PROP(PoseOptimiserEq13, NeverReturnsAPoseThatIsNotFinite, ()) {
  PoseProblem problem = ExactProblem(AnyPose(3), AnyInt(0, 4), AnyInt(0, 2));
  const double bad[] = {0.0, 1e300, -1e300, std::nan(""), INFINITY, 1e-300};
  for (PointConstraint& c : problem.points) {
    if (AnyInt(0, 1)) c.p_w[AnyInt(0, 2)] = bad[AnyInt(0, 5)];
    if (AnyInt(0, 1)) c.u_px[AnyInt(0, 1)] = bad[AnyInt(0, 5)];
    if (AnyInt(0, 3) == 0) c.sigma_px = bad[AnyInt(0, 5)];
  }
  for (PlaneConstraint& c : problem.planes) {
    if (AnyInt(0, 1)) c.pi_w.d = bad[AnyInt(0, 5)];
    if (AnyInt(0, 1)) c.pi_c.n[AnyInt(0, 2)] = bad[AnyInt(0, 5)];
    if (AnyInt(0, 1)) c.offset_sigma_m = bad[AnyInt(0, 5)];
  }
  const PoseSummary summary = OptimisePose(problem, Camera{}, {});
  RC_ASSERT(summary.T_cw.R.allFinite() && summary.T_cw.t.allFinite());
  RC_ASSERT((summary.T_cw.R * summary.T_cw.R.transpose()).isIdentity(1e-9));
}

}  // namespace
}  // namespace slam

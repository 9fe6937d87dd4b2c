#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "property_tests/generators/poses.h"
#include "slam/pose/held_directions.h"

namespace slam {
namespace {

constexpr double kMaxSine = 0.17;  // ten degrees

std::vector<PlaneConstraint> AnyPlanes() {
  std::vector<PlaneConstraint> planes(static_cast<std::size_t>(AnyInt(0, 4)));
  // Often panels: all normals near one plane.
  const Eigen::Vector3d up = AnyUnit();
  const double lean = AnyInt(0, 1) == 0 ? 1.0 : 0.1;
  for (PlaneConstraint& plane : planes) {
    Eigen::Vector3d n = AnyUnit();
    n -= (1 - lean) * n.dot(up) * up;
    RC_PRE(n.norm() > 1e-3);
    plane.pi_w.n = plane.pi_c.n = n.normalized();
  }
  return planes;
}

/// How much of the plane that tells most of a step.
double MostTold(const std::vector<PlaneConstraint>& planes, const Eigen::Vector3d& step_c) {
  double most = 0.0;
  for (const PlaneConstraint& plane : planes)
    most = std::max(most, std::abs(plane.pi_c.n.dot(step_c)));
  return most;
}

/// Of a pose, all of it correlated: metres and radians of some centimetres and degrees.
Matrix6d AnyPoseCovariance() {
  Matrix6d root;
  for (int i = 0; i < 36; ++i) root(i) = 0.03 * AnyReal(-1, 1);
  return root * root.transpose() + 1e-6 * Matrix6d::Identity();
}

std::vector<Eigen::Vector3d> AnySteps() {
  const Eigen::Matrix3d R = AnyPose(1).R;
  std::vector<Eigen::Vector3d> steps;
  for (int i = AnyInt(0, 3); i > 0; --i) steps.emplace_back(R.col(i - 1));
  return steps;
}

Vector6d Along(const Eigen::Vector3d& step_c) {
  Vector6d d = Vector6d::Zero();
  d.head<3>() = step_c;
  return d;
}

RC_GTEST_PROP(UnseenSteps, LieAlongAllPlanesAndAcrossEachOther, ()) {
  const auto planes = AnyPlanes();
  const auto steps = UnseenSteps(planes, Eigen::Matrix3d::Identity());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    RC_ASSERT(std::abs(steps[i].norm() - 1) < 1e-12);
    RC_ASSERT(MostTold(planes, steps[i]) <= kMaxSine);
    for (std::size_t j = 0; j < i; ++j) RC_ASSERT(std::abs(steps[i].dot(steps[j])) < 1e-9);
  }
  // Where some step across the planes is told by none, one at least is found.
  for (const PlaneConstraint& plane : planes) {
    const Eigen::Vector3d across = plane.pi_c.n.cross(AnyUnit());
    if (across.norm() > 1e-3 && MostTold(planes, across.normalized()) < 1e-3)
      RC_ASSERT(!steps.empty());
  }
}

RC_GTEST_PROP(UnseenSteps, TurnWithTheCamera, ()) {
  const auto planes = AnyPlanes();
  const Eigen::Matrix3d R = AnyPose(1).R;
  auto turned = planes;
  for (PlaneConstraint& plane : turned) plane.pi_c.n = (R * plane.pi_c.n).normalized();
  const auto steps = UnseenSteps(planes, Eigen::Matrix3d::Identity());
  const auto there = UnseenSteps(planes, R);
  // Neither side may hang on round-off.
  for (const Eigen::Vector3d& s : steps) RC_PRE(MostTold(planes, s) < kMaxSine - 1e-6);
  for (const Eigen::Vector3d& s : there) RC_PRE(MostTold(turned, s) < kMaxSine - 1e-6);
  RC_ASSERT(steps.size() == there.size());
  Eigen::Matrix3d span = Eigen::Matrix3d::Zero(), span_there = span;
  for (const Eigen::Vector3d& s : steps) span += R * s * s.transpose() * R.transpose();
  for (const Eigen::Vector3d& s : there) span_there += s * s.transpose();
  RC_ASSERT((span - span_there).norm() < 1e-3);
}

RC_GTEST_PROP(HeldAlong, KnowsTheStepsAndNothingElseLess, ()) {
  const UncertainPose predicted{AnyPose(3), AnyPoseCovariance()};
  const auto steps = AnySteps();
  const UncertainPose held = HeldAlong(predicted, steps);
  const double size = predicted.covariance.norm();
  RC_ASSERT(held.T_cw.t == predicted.T_cw.t && held.T_cw.R == predicted.T_cw.R);
  RC_ASSERT((held.covariance - held.covariance.transpose()).norm() < 1e-12 * size);
  for (const Eigen::Vector3d& step_c : steps) {
    const Vector6d d = Along(step_c);
    RC_ASSERT(d.dot(held.covariance * d) <= 1.1e-6 * d.dot(predicted.covariance * d));
    RC_ASSERT(d.dot(held.covariance * d) > 0);
  }
  const Eigen::SelfAdjointEigenSolver<Matrix6d> taken(predicted.covariance - held.covariance);
  RC_ASSERT(taken.eigenvalues().minCoeff() > -1e-9 * size);
  // What is left is what a measurement of the steps leaves.
  Matrix6d information = predicted.covariance.inverse();
  for (const Eigen::Vector3d& step_c : steps)
    information += 1e12 * Along(step_c) * Along(step_c).transpose();
  RC_ASSERT((held.covariance - information.inverse()).norm() < 1e-4 * size);
}

RC_GTEST_PROP(WithoutSteps, SaysNothingOfTheStepsAndTheSameOfAllOtherMotion, ()) {
  const Matrix6d information = AnyPoseCovariance().inverse();
  const auto steps = AnySteps();
  const Matrix6d left = WithoutSteps(information, steps);
  const double size = information.norm();
  Vector6d other;
  for (double& x : other) x = AnyReal(-1, 1);
  for (const Eigen::Vector3d& step_c : steps) {
    RC_ASSERT((left * Along(step_c)).norm() < 1e-12 * size);
    RC_ASSERT((left.transpose() * Along(step_c)).norm() < 1e-12 * size);
    other -= other.dot(Along(step_c)) * Along(step_c);
  }
  RC_ASSERT(std::abs(other.dot(left * other) - other.dot(information * other)) < 1e-10 * size);
}

RC_GTEST_PROP(WithoutSteps, LeaveThemAsUncertainAsPredicted, ()) {
  const auto steps = AnySteps();
  // A prediction in which the steps err for themselves.
  Matrix6d apart = Matrix6d::Identity();
  for (const Eigen::Vector3d& step_c : steps)
    apart -= Along(step_c) * Along(step_c).transpose();
  Matrix6d predicted = apart * AnyPoseCovariance() * apart;
  const double variance = AnyReal(1e-6, 1e-2);
  for (const Eigen::Vector3d& step_c : steps)
    predicted += variance * Along(step_c) * Along(step_c).transpose();
  const Matrix6d seen = WithoutSteps(AnyPoseCovariance().inverse(), steps);
  const Matrix6d known =
      (Matrix6d::Identity() + predicted * seen).partialPivLu().solve(predicted);
  for (const Eigen::Vector3d& step_c : steps)
    RC_ASSERT(std::abs(Along(step_c).dot(known * Along(step_c)) - variance) < 1e-6 * variance);
}

}  // namespace
}  // namespace slam

#include "slam/pose/held_directions.h"

#include <Eigen/Eigenvalues>

namespace slam {
namespace {

void AddAxes(const Eigen::Matrix3d& predicted, const Eigen::Matrix3d& estimated, bool turn,
             std::vector<MotionAxis>& axes) {
  constexpr double kMostOfIt = 0.5;  // of the variance
  // Along which functionals of the motion is most of the variance left?
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d> left(estimated, predicted);
  if (left.info() != Eigen::Success) return;
  for (int i = 2; i >= 0 && left.eigenvalues()[i] > kMostOfIt; --i) {
    // The functional's own direction of motion.
    axes.push_back({turn, (predicted * left.eigenvectors().col(i)).normalized()});
  }
}

}  // namespace

std::vector<MotionAxis> HeldByPrediction(const Matrix6d& predicted, const Matrix6d& estimated) {
  std::vector<MotionAxis> axes;
  AddAxes(predicted.topLeftCorner<3, 3>(), estimated.topLeftCorner<3, 3>(), false, axes);
  AddAxes(predicted.bottomRightCorner<3, 3>(), estimated.bottomRightCorner<3, 3>(), true, axes);
  return axes;
}

}  // namespace slam

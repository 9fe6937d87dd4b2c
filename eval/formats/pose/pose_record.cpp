#include "eval/formats/pose/pose_record.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>

#include "io/number_text.h"

namespace eval {
namespace {

// Four decimals, as TUM prints them, are off by up to 5e-5 each: the norm by at most 1e-4.
constexpr double kUnitQuaternion = 1e-3;
// Of a rotation printed with four decimals, each entry of R R^T is off by at most 2e-4.
constexpr double kOrthogonal = 1e-3;

bool IsNear(const RecordPlace& place, const Eigen::Vector3d& t) {
  if (t.cwiseAbs().maxCoeff() <= kMaxCoordinate_m) return true;
  place.folder.Tell(
      place.file, place.line,
      fmt::format("expected a position within {:g} m of the origin, found {:g} {:g} {:g}",
                  kMaxCoordinate_m, t.x(), t.y(), t.z()),
      "write metres, in a world whose origin is near");
  return false;
}

}  // namespace

std::optional<std::vector<double>> NumbersOf(const io::TextRecord& record) {
  std::vector<double> numbers;
  numbers.reserve(record.fields.size());
  for (const std::string& field : record.fields) {
    const auto number = io::ParseNumber(field);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

std::optional<Pose> PoseFrom(const RecordPlace& place, const Eigen::Vector3d& t,
                             const Eigen::Vector4d& q_xyzw) {
  if (!IsNear(place, t)) return std::nullopt;
  const double length = q_xyzw.norm();
  if (!(std::abs(length - 1) <= kUnitQuaternion)) {
    place.folder.Tell(
        place.file, place.line,
        fmt::format("expected a unit quaternion, found one of length {:.6f}", length),
        "normalise qx qy qz qw (in this order)");
    return std::nullopt;
  }
  return Pose{RotationOf(q_xyzw.x(), q_xyzw.y(), q_xyzw.z(), q_xyzw.w()), t};
}

std::optional<Pose> PoseFrom(const RecordPlace& place, const Eigen::Vector3d& t,
                             const Eigen::Matrix3d& R) {
  if (!IsNear(place, t)) return std::nullopt;
  const double error = (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(error <= kOrthogonal) || !(R.determinant() > 0.0)) {
    place.folder.Tell(place.file, place.line,
                      fmt::format("expected a rotation in the first three columns, found a "
                                  "matrix with R R^T off the identity by {:.6f} and "
                                  "determinant {:.6f}",
                                  error, R.determinant()),
                      "write r11 r12 r13 tx r21 r22 r23 ty r31 r32 r33 tz");
    return std::nullopt;
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return Pose{svd.matrixU() * svd.matrixV().transpose(), t};
}

}  // namespace eval

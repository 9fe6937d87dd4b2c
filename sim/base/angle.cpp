#include "sim/base/angle.h"

#include <algorithm>
#include <cmath>

namespace sim {
namespace {

/// Taylor polynomials on [-pi/4, pi/4]; the first omitted terms are below 1e-17.
SinCos SinCosSmall(double x) {
  const double x2 = x * x;
  double sine = 0, cosine = 0;
  for (int k = 17; k >= 3; k -= 2) sine = -x2 / (k * (k - 1)) * (1 + sine);
  for (int k = 18; k >= 2; k -= 2) cosine = -x2 / (k * (k - 1)) * (1 + cosine);
  return {x * (1 + sine), 1 + cosine};
}

/// atan of t in [0, 1]: halved twice, then its series; |t| < 0.2 there.
double AtanUnit(double t) {
  for (int i = 0; i < 2; ++i) t = t / (1 + std::sqrt(1 + t * t));
  double series = 0;
  for (int k = 21; k >= 1; k -= 2) series = 1.0 / k - t * t * series;
  return 4 * t * series;
}

}  // namespace

double Atan2Rad(double y, double x) {
  const double ax = std::abs(x), ay = std::abs(y);
  if (!(ax + ay > 0)) return 0;
  double angle = ay <= ax ? AtanUnit(ay / ax) : kPi / 2 - AtanUnit(ax / ay);
  if (x < 0) angle = kPi - angle;
  return y < 0 ? -angle : angle;
}

double AsinRad(double sine) {
  const double s = std::clamp(sine, -1.0, 1.0);
  return Atan2Rad(s, std::sqrt((1 - s) * (1 + s)));
}

SinCos SinCosDeg(double angle_deg) {
  const double rest_deg = std::remainder(angle_deg, 90.0);  // exact, in [-45, 45]
  const double turns = std::remainder(angle_deg - rest_deg, 360.0) / 90.0;
  const SinCos small = SinCosSmall(DegToRad(rest_deg));
  switch ((static_cast<int>(std::lround(turns)) + 4) % 4) {
    case 0:
      return small;
    case 1:
      return {small.cos, -small.sin};
    case 2:
      return {-small.sin, -small.cos};
    default:
      return {-small.cos, small.sin};
  }
}

Eigen::Quaterniond QuaternionFromRpyDeg(const Eigen::Vector3d& rpy_deg) {
  const SinCos r = SinCosDeg(rpy_deg.x() / 2);
  const SinCos p = SinCosDeg(rpy_deg.y() / 2);
  const SinCos y = SinCosDeg(rpy_deg.z() / 2);
  return {r.cos * p.cos * y.cos + r.sin * p.sin * y.sin,
          r.sin * p.cos * y.cos - r.cos * p.sin * y.sin,
          r.cos * p.sin * y.cos + r.sin * p.cos * y.sin,
          r.cos * p.cos * y.sin - r.sin * p.sin * y.cos};
}

Eigen::Vector3d RpyDegFromQuaternion(const Eigen::Quaterniond& q) {
  const Eigen::Matrix3d R = q.toRotationMatrix();
  const double pitch = AsinRad(-R(2, 0));
  return {RadToDeg(Atan2Rad(R(2, 1), R(2, 2))), RadToDeg(pitch),
          RadToDeg(Atan2Rad(R(1, 0), R(0, 0)))};
}

}  // namespace sim

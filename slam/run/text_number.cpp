#include "slam/run/text_number.h"

#include <Eigen/Geometry>
#include <charconv>
#include <cmath>

#include "io/number_text.h"
#include "slam/base/require.h"

namespace slam {

std::string FiniteNumberText(double x) {
  Require(std::isfinite(x), "a number to write is not finite");
  return io::NumberText(x == 0 ? 0.0 : x);
}

std::string StampText(double timestamp_s) {
  Require(std::isfinite(timestamp_s), "a timestamp to write is not finite");
  char buffer[400];  // 1e308 without exponent
  auto [end, error] =
      std::to_chars(buffer, buffer + sizeof buffer, timestamp_s, std::chars_format::fixed, 6);
  double back = 0;
  std::from_chars(buffer, end, back);
  if (back != timestamp_s)
    end = std::to_chars(buffer, buffer + sizeof buffer, timestamp_s, std::chars_format::fixed)
              .ptr;
  return {buffer, end};
}

std::string TrajectoryLine(double timestamp_s, const Pose& T_cw) {
  const Pose T_wc = Inverse(T_cw);
  Eigen::Quaterniond q(T_wc.R);
  q.normalize();
  if (q.w() < 0) q.coeffs() *= -1;
  std::string line = StampText(timestamp_s);
  for (const double x : {T_wc.t.x(), T_wc.t.y(), T_wc.t.z(), q.x(), q.y(), q.z(), q.w()})
    line.append(" ").append(FiniteNumberText(x));
  return line + '\n';
}

std::string CovarianceLine(double timestamp_s, const Matrix6d& covariance) {
  std::string line = StampText(timestamp_s);
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) line.append(" ").append(FiniteNumberText(covariance(i, j)));
  }
  return line + '\n';
}

}  // namespace slam

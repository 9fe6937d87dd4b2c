#include "sim/camera/lens.h"

#include <Eigen/LU>
#include <cmath>

namespace sim {
namespace {

constexpr int kMaxSteps = 50;
constexpr double kConverged = 1e-15;  ///< last step of Newton; its error is the square
constexpr double kGoodEnough = 1e-13;

struct Bent {
  Eigen::Vector2d value;
  Eigen::Matrix2d derivative;
};

Bent Polynomial(const Lens& lens, const Eigen::Vector2d& ray) {
  const double x = ray.x(), y = ray.y(), r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3));
  const double slope = lens.k1 + r2 * (2.0 * lens.k2 + r2 * 3.0 * lens.k3);  // by r^2
  Bent bent;
  bent.value = {x * radial + 2.0 * lens.p1 * x * y + lens.p2 * (r2 + 2.0 * x * x),
                y * radial + lens.p1 * (r2 + 2.0 * y * y) + 2.0 * lens.p2 * x * y};
  const double cross = 2.0 * x * y * slope + 2.0 * lens.p1 * x + 2.0 * lens.p2 * y;
  bent.derivative << radial + 2.0 * x * x * slope + 2.0 * lens.p1 * y + 6.0 * lens.p2 * x,
      cross, cross, radial + 2.0 * y * y * slope + 6.0 * lens.p1 * y + 2.0 * lens.p2 * x;
  return bent;
}

}  // namespace

Eigen::Vector2d Lens::Distort(const Eigen::Vector2d& ray) const {
  const double r = ray.norm();
  if (!(r > reach)) return Polynomial(*this, ray).value;
  return Polynomial(*this, ray * (reach / r)).value * (r / reach);
}

Eigen::Vector2d Lens::Undistort(const Eigen::Vector2d& distorted) const {
  Eigen::Vector2d ray = distorted;
  double last_step = 0;
  for (int i = 0; i < kMaxSteps; ++i) {
    const Bent bent = Polynomial(*this, ray);
    const Eigen::Vector2d step = bent.derivative.inverse() * (bent.value - distorted);
    ray -= step;
    last_step = step.norm();
    if (!(last_step > kConverged)) break;
  }
  if (last_step < kGoodEnough && ray.norm() <= reach) return ray;
  return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace sim

#include "slam/geometry/plane_sums.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <vector>

namespace slam {
namespace {

// A wall that is faced: n pixels know its depth sqrt(n) times as well as one, near and far.
TEST(PlaneSigmas, OfAWallAreThoseOfTheMeanOfItsDepths) {
  DepthNoise noise;
  noise.correlated_px = 4.0;
  constexpr double kScale = 1.5;
  for (const double z_m : {0.5, 1.0, 3.0}) {
    const double sigma_m = noise.Sigma(z_m);
    const double weight = std::pow(z_m * z_m / sigma_m, 2);
    PlaneSums sums;
    double spread2 = 0.0;
    for (int v = -10; v <= 10; ++v) {
      for (int u = -10; u <= 10; ++u) {
        sums.Add(0.1 + 0.02 * u, -0.2 + 0.02 * v, 1 / z_m, weight);
        spread2 += std::pow(0.02 * u * z_m, 2);
      }
    }
    const PlaneSigmas found = Sigmas(sums, {0, 0, 1 / z_m}, noise, kScale);
    const double pixel_m = kScale * std::sqrt(noise.correlated_px) * sigma_m;
    EXPECT_NEAR(found.offset_m, pixel_m / 21, 1e-9) << z_m;
    // A line through points that are spread so far.
    EXPECT_NEAR(found.angle_rad, pixel_m / std::sqrt(spread2), 1e-9) << z_m;
  }
}

struct SeenPixel {
  double x, y, q, sigma_q;
};

/// A strip of a slanted plane beside the axis, longer than wide and askew to both.
std::vector<SeenPixel> StripOf(const Plane& pi_c, const DepthNoise& noise) {
  std::vector<SeenPixel> pixels;
  const InverseDepthPlane along_rays = SeenAlongRays(pi_c);
  for (int i = 0; i < 24; ++i) {
    for (int k = 0; k < 5; ++k) {
      const double x = 0.12 + 0.02 * i - 0.004 * k, y = -0.3 + 0.006 * i + 0.02 * k;
      const double q = along_rays.InverseDepth(x, y);
      pixels.push_back({x, y, q, noise.Sigma(1 / q) * q * q});
    }
  }
  return pixels;
}

PlaneSums SumsOf(const std::vector<SeenPixel>& pixels) {
  PlaneSums sums;
  for (const SeenPixel& p : pixels) sums.Add(p.x, p.y, p.q, 1 / (p.sigma_q * p.sigma_q));
  return sums;
}

// Each pixel's error by itself moves the fit: what all of them do together is the sum of squares.
TEST(PlaneSigmas, AreWhatTheErrorsOfThePixelsMoveTheFitBy) {
  DepthNoise noise;
  noise.correlated_px = 9.0;
  constexpr double kScale = 1.3, kPart = 1e-3;  // of a sigma, so that what moves is linear
  for (const Eigen::Vector3d& n :
       {Eigen::Vector3d(0.5, -0.4, -0.7), Eigen::Vector3d(-0.3, 0.6, -0.8)}) {
    const Plane pi_c{n.normalized(), 1.1};
    std::vector<SeenPixel> pixels = StripOf(pi_c, noise);
    const PlaneSums sums = SumsOf(pixels);
    const Eigen::Vector3d ray(sums.wx / sums.w, sums.wy / sums.w, 1.0);
    const Eigen::Vector3d centroid_c = -pi_c.d / pi_c.n.dot(ray) * ray;
    double offset2 = 0.0;
    Eigen::Matrix3d turned = Eigen::Matrix3d::Zero(), moved = turned;
    for (SeenPixel& pixel : pixels) {
      const double exact_q = pixel.q;
      pixel.q += kPart * pixel.sigma_q;
      const InverseDepthPlane fit = Fit(SumsOf(pixels))->plane;
      pixel.q = exact_q;
      const InverseDepthPlane truth = SeenAlongRays(pi_c);
      const Eigen::Vector3d by_n = (fit.Hessian().n - pi_c.n) / kPart;
      const Eigen::Vector3d by(fit.a - truth.a, fit.b - truth.b, fit.c - truth.c);
      offset2 += std::pow(SignedDistance(fit.Hessian(), centroid_c) / kPart, 2);
      turned += by_n * by_n.transpose();
      moved += by * by.transpose() / (kPart * kPart);
    }
    const double worst2 =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(turned).eigenvalues().maxCoeff();
    const double times = kScale * std::sqrt(noise.correlated_px);
    const PlaneSigmas found = Sigmas(sums, SeenAlongRays(pi_c), noise, kScale);
    EXPECT_NEAR(found.offset_m, times * std::sqrt(offset2), 1e-4 * found.offset_m);
    EXPECT_NEAR(found.angle_rad, times * std::sqrt(worst2), 1e-3 * found.angle_rad);
    EXPECT_LT((found.covariance - times * times * moved).norm(),
              1e-4 * found.covariance.norm());
  }
}

TEST(PlaneFit, ErrsByTheSquaresThatAreLeftInSigmasOfThePixels) {
  const DepthNoise noise;
  std::vector<SeenPixel> pixels =
      StripOf({Eigen::Vector3d(0.5, -0.4, -0.7).normalized(), 1.1}, noise);
  for (std::size_t k = 0; k < pixels.size(); ++k)
    pixels[k].q += 2.0 * std::sin(2.4 * static_cast<double>(k)) * pixels[k].sigma_q;
  const std::optional<PlaneFit> fit = Fit(SumsOf(pixels));
  ASSERT_TRUE(fit);
  double left = 0.0;
  for (const SeenPixel& p : pixels)
    left += std::pow((p.q - fit->plane.InverseDepth(p.x, p.y)) / p.sigma_q, 2);
  EXPECT_NEAR(fit->error, left, 1e-6 * left);
  // Nothing beside it fits better.
  for (const Eigen::Vector3d& by : {Eigen::Vector3d(1e-3, 0, 0), Eigen::Vector3d(0, 1e-3, 0),
                                    Eigen::Vector3d(0, 0, 1e-3)}) {
    for (const double side : {-1.0, 1.0}) {
      const InverseDepthPlane beside{fit->plane.a + side * by.x(), fit->plane.b + side * by.y(),
                                     fit->plane.c + side * by.z()};
      double more = 0.0;
      for (const SeenPixel& p : pixels)
        more += std::pow((p.q - beside.InverseDepth(p.x, p.y)) / p.sigma_q, 2);
      EXPECT_GT(more, left);
    }
  }
}

TEST(PlaneFit, OfPartsIsThatOfTheirUnionAndOfAWholeLessAPartThatOfTheRest) {
  const DepthNoise noise;
  std::vector<SeenPixel> pixels =
      StripOf({Eigen::Vector3d(0.5, -0.4, -0.7).normalized(), 1.1}, noise);
  for (std::size_t k = 0; k < pixels.size(); ++k)
    pixels[k].q += std::cos(1.7 * static_cast<double>(k)) * pixels[k].sigma_q;
  const std::vector<SeenPixel> first(pixels.begin(), pixels.begin() + 45),
      rest(pixels.begin() + 45, pixels.end());
  PlaneSums together = SumsOf(first), less = SumsOf(pixels);
  together += SumsOf(rest);
  less -= SumsOf(first);
  for (const auto& [sums, of] : {std::pair(together, pixels), std::pair(less, rest)}) {
    const PlaneFit fit = Fit(sums).value(), direct = Fit(SumsOf(of)).value();
    EXPECT_NEAR(fit.plane.a, direct.plane.a, 1e-9);
    EXPECT_NEAR(fit.plane.b, direct.plane.b, 1e-9);
    EXPECT_NEAR(fit.plane.c, direct.plane.c, 1e-9);
    EXPECT_NEAR(fit.error, direct.error, 1e-6 * direct.error);
    EXPECT_EQ(sums.n, static_cast<double>(of.size()));
  }
}

}  // namespace
}  // namespace slam

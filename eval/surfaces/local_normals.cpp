#include "eval/surfaces/local_normals.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace eval {
namespace {

constexpr double kWindowRadius = 7.0 / 640;  // of the width: 7 cm at 2.5 m; noise averages out
constexpr double kMinFilled = 0.5;           // share of a window that must have depth

/// Sums over rectangles of the image of what a fit needs, for each pixel with depth.
enum Moment { kOne, kX, kY, kXX, kXY, kYY, kQ, kXQ, kYQ, kQQ, kMoments };
using Moments = cv::Vec<double, kMoments>;

cv::Mat_<Moments> IntegralMoments(const cv::Mat1f& depth_m, const cv::Mat2d& rays) {
  cv::Mat_<Moments> sums(depth_m.rows + 1, depth_m.cols + 1, Moments::all(0.0));
  for (int v = 0; v < depth_m.rows; ++v) {
    Moments row = Moments::all(0.0);
    for (int u = 0; u < depth_m.cols; ++u) {
      const double z = depth_m(v, u);
      if (z > 0) {
        const double x = rays(v, u)[0], y = rays(v, u)[1], q = 1 / z;
        const std::array<double, kMoments> terms{1,     x, y,     x * x, x * y,
                                                 y * y, q, x * q, y * q, q * q};
        for (int i = 0; i < kMoments; ++i) row[i] += terms[std::size_t(i)];
      }
      sums(v + 1, u + 1) = sums(v, u + 1) + row;
    }
  }
  return sums;
}

struct InverseDepthFit {
  Eigen::Vector3d abc;  ///< 1/z = a x + b y + c
  double rms_per_m = 0.0;
};

/// Least squares about the window's mean, which keeps the digits.
bool Fit(const Moments& m, InverseDepthFit& fit) {
  const double n = m[kOne], x = m[kX] / n, y = m[kY] / n, q = m[kQ] / n;
  const double xx = m[kXX] / n - x * x, xy = m[kXY] / n - x * y, yy = m[kYY] / n - y * y;
  const double xq = m[kXQ] / n - x * q, yq = m[kYQ] / n - y * q, qq = m[kQQ] / n - q * q;
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > 0.0)) return false;
  const double a = (yy * xq - xy * yq) / determinant, b = (xx * yq - xy * xq) / determinant;
  fit.abc = {a, b, q - a * x - b * y};
  fit.rms_per_m = std::sqrt(std::max(0.0, qq - a * xq - b * yq));
  return true;
}

/// From ray to ray, about the middle of the image.
double RaySpacing(const cv::Mat2d& rays) {
  const int v = rays.rows / 2, u = rays.cols / 2;
  return rays(v, u)[0] - rays(v, u - 1)[0];
}

}  // namespace

LocalNormals FitLocalNormals(const cv::Mat1f& depth_m, const cv::Mat2d& rays, int stride) {
  const cv::Mat_<Moments> sums = IntegralMoments(depth_m, rays);
  const int radius = std::max(1, int(std::lround(kWindowRadius * depth_m.cols)));
  const double min_pixels = kMinFilled * (2 * radius + 1) * (2 * radius + 1);
  LocalNormals local{cv::Mat3f(depth_m.size(), cv::Vec3f(0, 0, 0)),
                     cv::Mat1f(depth_m.size(), 0.0F), radius * RaySpacing(rays)};
  for (int v = 0; v < depth_m.rows; v += stride) {
    const int v0 = std::max(0, v - radius), v1 = std::min(depth_m.rows, v + radius + 1);
    for (int u = 0; u < depth_m.cols; u += stride) {
      if (!(depth_m(v, u) > 0)) continue;
      const int u0 = std::max(0, u - radius), u1 = std::min(depth_m.cols, u + radius + 1);
      const Moments m = sums(v1, u1) - sums(v0, u1) - sums(v1, u0) + sums(v0, u0);
      InverseDepthFit fit;
      if (m[kOne] < min_pixels || !Fit(m, fit)) continue;
      const Eigen::Vector3d ray(rays(v, u)[0], rays(v, u)[1], 1.0);
      if (!(fit.abc.dot(ray) > 0)) continue;  // a fit that is no surface seen from the front
      const Eigen::Vector3d n_c = -fit.abc.normalized();
      local.normals_c(v, u) = {float(n_c.x()), float(n_c.y()), float(n_c.z())};
      local.rms_per_m(v, u) = float(fit.rms_per_m);
    }
  }
  return local;
}

double NoiseOf(const LocalNormals& local) {
  std::vector<float> rms;
  for (int v = 0; v < local.rms_per_m.rows; ++v) {
    for (int u = 0; u < local.rms_per_m.cols; ++u) {
      if (HasNormal(local, v, u)) rms.push_back(local.rms_per_m(v, u));
    }
  }
  if (rms.empty()) return 0.0;
  const auto middle = rms.begin() + std::ptrdiff_t(rms.size() / 2);
  std::nth_element(rms.begin(), middle, rms.end());
  return *middle;
}

bool SpeaksAgainst(const LocalNormals& local, int v, int u, double depth_m,
                   const Eigen::Vector3d& n_c, double noise_per_m) {
  if (!IsSmooth(local, v, u, noise_per_m)) return false;
  constexpr double kMinAngle_rad = 0.52;  // 30 deg: a bend and the rim of an edge turn it less
  constexpr double kIndependent = 4;  // of a window's parts: noise of stereo comes in patches
  constexpr double kSigmas = 3;       // 1 in 370 beyond
  const double slope_sigma =
      noise_per_m * depth_m / local.half_window / std::sqrt(kIndependent);
  const double max_angle_rad = std::max(kMinAngle_rad, kSigmas * slope_sigma);
  const cv::Vec3f& n = local.normals_c(v, u);
  const double cosine = n_c.dot(Eigen::Vector3d(n[0], n[1], n[2]));
  return std::acos(std::clamp(cosine, -1.0, 1.0)) > max_angle_rad;
}

}  // namespace eval

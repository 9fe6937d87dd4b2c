#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace eval {

/// Planes that were fitted to the neighbourhood of pixels.
struct LocalNormals {
  cv::Mat3f normals_c;  ///< unit, towards the camera; zero where there is no depth
  cv::Mat1f rms_per_m;  ///< of the inverse depths about the fit; meaningless without a normal
  double half_window = 0.0;  ///< of the windows, in x of the rays
};

/// Fits a plane to the window around each pixel that has depth. In inverse depth a plane is
/// linear in the ray, 1/z = a x + b y + c, and noise of disparity is equal everywhere.
/// @param rays    (x, y) of each pixel's ray (x, y, 1)
/// @param stride  only pixels whose row and column are multiples of it are fitted
LocalNormals FitLocalNormals(const cv::Mat1f& depth_m, const cv::Mat2d& rays, int stride);

inline bool HasNormal(const LocalNormals& local, int v, int u) {
  return local.normals_c(v, u) != cv::Vec3f(0, 0, 0);
}

/// The noise of one pixel's inverse depth, 1/m: the median of the fits' residuals, since most
/// windows of most images lie on something smooth. Nothing (0) without any fit.
double NoiseOf(const LocalNormals& local);

/// Whether the fit at a pixel is of one smooth thing: a window over an edge is not.
inline bool IsSmooth(const LocalNormals& local, int v, int u, double noise_per_m) {
  // Balances: windows over edges have ten times the noise and more.
  constexpr double kMaxRms = 2.5;
  return HasNormal(local, v, u) && local.rms_per_m(v, u) <= kMaxRms * noise_per_m;
}

/// Whether the fit at a pixel speaks against a plane: its place is smooth and faces another way.
/// Near, noise and bend turn a normal by some degrees and another face of a thing by far more;
/// far away noise turns it by any angle, and it says nothing.
bool SpeaksAgainst(const LocalNormals& local, int v, int u, double depth_m,
                   const Eigen::Vector3d& n_c, double noise_per_m);

}  // namespace eval

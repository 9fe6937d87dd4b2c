#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

/// A second renderer for comparison: OpenGL in software (OSMesa), fed with triangles and a
/// projection matrix made here from a pinhole camera. It shares no code with sim/.
namespace gl_raster {

/// Pixel centres at integers, x right, y down, z forward, as in the project's formats.
struct PinholeCamera {
  int width = 0, height = 0;
  double fx = 0, fy = 0, cx = 0, cy = 0;  ///< pixels
};

struct IdTriangle {
  std::array<Eigen::Vector3d, 3> corners_c;  ///< camera frame, metres
  int id = 0;                                ///< 1 to 2^24 - 1
};

struct Raster {
  cv::Mat1d depth_m;  ///< planar z, 0 where nothing is
  cv::Mat1i id;       ///< 0 where nothing is
};

/// Of a depth z: half a step of the 24-bit buffer, which is finest near the camera, three times
/// over for what GL rounds before.
double DepthTolerance(double z_m, double near_m, double far_m);

/// An off-screen context of a fixed image size. One at a time in a thread.
class GlRaster {
 public:
  /// @throws std::runtime_error when there is no context to be had.
  GlRaster(int width, int height);
  ~GlRaster();
  GlRaster(const GlRaster&) = delete;
  GlRaster& operator=(const GlRaster&) = delete;

  /// @pre camera of the context's size
  Raster Draw(const std::vector<IdTriangle>& triangles, const PinholeCamera& camera,
              double near_m, double far_m);

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

}  // namespace gl_raster

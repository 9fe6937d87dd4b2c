#pragma once

#include <Eigen/Core>
#include <cstdint>

// What a view does to every pixel and a print to every texel, by rows of `count`. Same bits on
// every processor.
namespace sim {

/// (dx, dy, dz) = R (x, y, 1).
void TurnRays(const Eigen::Matrix3d& R, const double* x, const double* y, int count, double* dx,
              double* dy, double* dz);

void ToSingle(const double* in, int count, float* out);

/// Rays of pixels, and what is worked out of the plane they meet.
struct PixelRow {
  const double *x, *y;                    ///< ray (x, y, 1), camera frame
  const double *dx, *dy, *dz;             ///< the same, world frame
  double* depth_m;                        ///< planar z
  float* cosine;                          ///< |cos| between ray and normal; null: not asked
  float *start_x, *start_y, *start_z;     ///< where second rays begin, world frame
  float *to_eye_x, *to_eye_y, *to_eye_z;  ///< from there; null: not asked
};

/// A plane as one view sees it.
struct PlaneSeen {
  Eigen::Vector3d inverse_depth;  ///< 1/z = inverse_depth . ray
  Eigen::Vector3d n_c;            ///< unit normal, camera frame
  Eigen::Vector3d start;          ///< second rays start here + z (dx, dy, dz)
  Eigen::Vector3d eye;            ///< and may go here
};

void MeetPlane(const PlaneSeen& plane, int first, int last, const PixelRow& row);

/// |cos| between a plane's normal and the direction half way between the camera and a projector, of
/// the pixels from first to last.
void MirrorCosines(const Eigen::Vector3d& n_c, const Eigen::Vector3d& projector_c,
                   const double* x, const double* y, const double* depth_m, int first, int last,
                   float* cosine);

/// uv = z (uv_over_depth (x, y, 1)) of the pixels from first to last.
void PlaceOnPrint(const Eigen::Matrix<float, 2, 3>& uv_over_depth, const double* x,
                  const double* y, const double* depth_m, int first, int last, float* u,
                  float* v);

/// Lowers height[i] to n . (x, y, 1) of pixel i where that is less.
void LowerToPlane(const Eigen::Vector3d& n, const double* x, const double* y, int count,
                  double* height);

/// Square roots of values in [0, 1], as bytes.
void RootBytes(const float* values, int count, std::uint8_t* roots);

/// `count` texels of four such bytes from two rows of twice as many: of each four the root of the
/// mean of what they stand for.
void HalveTexels(const std::uint8_t* upper, const std::uint8_t* lower, int count,
                 std::uint8_t* coarse);

}  // namespace sim

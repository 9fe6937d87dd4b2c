#include "sim/trace/pixel_rows.h"

#include <cmath>

#include "sim/trace/lanes.h"

namespace sim {

SIM_LANES void TurnRays(const Eigen::Matrix3d& R, const double* __restrict x,
                        const double* __restrict y, int count, double* __restrict dx,
                        double* __restrict dy, double* __restrict dz) {
  double* const out[3] = {dx, dy, dz};
  for (int row = 0; row < 3; ++row) {
    const double a = R.data()[row], b = R.data()[row + 3], c = R.data()[row + 6];
    double* __restrict d = out[row];
    for (int i = 0; i < count; ++i) d[i] = a * x[i] + b * y[i] + c;
  }
}

SIM_LANES void ToSingle(const double* __restrict in, int count, float* __restrict out) {
  for (int i = 0; i < count; ++i) out[i] = static_cast<float>(in[i]);
}

SIM_LANES void MeetPlane(const PlaneSeen& plane, int first, int last, const PixelRow& row) {
  const double ax = plane.inverse_depth.data()[0], ay = plane.inverse_depth.data()[1],
               az = plane.inverse_depth.data()[2];
  const double nx = plane.n_c.data()[0], ny = plane.n_c.data()[1], nz = plane.n_c.data()[2];
  const double* __restrict x = row.x;
  const double* __restrict y = row.y;
  double* __restrict depth = row.depth_m;
  float* __restrict cosine = row.cosine;
  for (int i = first; i < last; ++i) depth[i] = 1.0 / (ax * x[i] + ay * y[i] + az);
  for (int i = first; cosine != nullptr && i < last; ++i) {
    cosine[i] = static_cast<float>(std::abs(nx * x[i] + ny * y[i] + nz) /
                                   std::sqrt(x[i] * x[i] + y[i] * y[i] + 1.0));
  }
  const double* const ways[3] = {row.dx, row.dy, row.dz};
  float* const starts[3] = {row.start_x, row.start_y, row.start_z};
  float* const to_eyes[3] = {row.to_eye_x, row.to_eye_y, row.to_eye_z};
  for (int axis = 0; axis < 3; ++axis) {
    const double from = plane.start.data()[axis], eye = plane.eye.data()[axis];
    const double* __restrict way = ways[axis];
    float* __restrict start = starts[axis];
    float* __restrict to_eye = to_eyes[axis];
    if (to_eye == nullptr) {
      for (int i = first; i < last; ++i) {
        start[i] = static_cast<float>(from + depth[i] * way[i]);
      }
      continue;
    }
    for (int i = first; i < last; ++i) {
      const double p = from + depth[i] * way[i];
      start[i] = static_cast<float>(p);
      to_eye[i] = static_cast<float>(eye - p);
    }
  }
}

SIM_LANES void MirrorCosines(const Eigen::Vector3d& n_c, const Eigen::Vector3d& projector_c,
                             const double* __restrict x, const double* __restrict y,
                             const double* __restrict depth_m, int first, int last,
                             float* __restrict cosine) {
  const double nx = n_c.data()[0], ny = n_c.data()[1], nz = n_c.data()[2];
  const double px = projector_c.data()[0], py = projector_c.data()[1],
               pz = projector_c.data()[2];
  for (int i = first; i < last; ++i) {
    // Unit vectors to the camera and to the projector; their sum is half way between them.
    const double z = depth_m[i], cx = -z * x[i], cy = -z * y[i], cz = -z;
    const double ex = px + cx, ey = py + cy, ez = pz + cz;
    const double a = 1.0 / std::sqrt(cx * cx + cy * cy + cz * cz);
    const double b = 1.0 / std::sqrt(ex * ex + ey * ey + ez * ez);
    const double hx = a * cx + b * ex, hy = a * cy + b * ey, hz = a * cz + b * ez;
    cosine[i] = static_cast<float>(std::abs(nx * hx + ny * hy + nz * hz) /
                                   std::sqrt(hx * hx + hy * hy + hz * hz));
  }
}

SIM_LANES void PlaceOnPrint(const Eigen::Matrix<float, 2, 3>& uv_over_depth,
                            const double* __restrict x, const double* __restrict y,
                            const double* __restrict depth_m, int first, int last,
                            float* __restrict u, float* __restrict v) {
  const float* m = uv_over_depth.data();  // column by column
  const float u0 = m[0], u1 = m[2], u2 = m[4], v0 = m[1], v1 = m[3], v2 = m[5];
  for (int i = first; i < last; ++i) {
    const auto fx = static_cast<float>(x[i]), fy = static_cast<float>(y[i]);
    const auto z = static_cast<float>(depth_m[i]);
    u[i] = z * (u0 * fx + u1 * fy + u2);
    v[i] = z * (v0 * fx + v1 * fy + v2);
  }
}

SIM_LANES void LowerToPlane(const Eigen::Vector3d& n, const double* __restrict x,
                            const double* __restrict y, int count, double* __restrict height) {
  const double nx = n.data()[0], ny = n.data()[1], nz = n.data()[2];
  for (int i = 0; i < count; ++i) {
    const double over = nx * x[i] + ny * y[i] + nz;
    height[i] = over < height[i] ? over : height[i];
  }
}

SIM_LANES void RootBytes(const float* __restrict values, int count,
                         std::uint8_t* __restrict roots) {
  for (int i = 0; i < count; ++i) {
    roots[i] = static_cast<std::uint8_t>(std::sqrt(values[i]) * 255.0F + 0.5F);
  }
}

SIM_LANES void HalveTexels(const std::uint8_t* __restrict upper,
                           const std::uint8_t* __restrict lower, int count,
                           std::uint8_t* __restrict coarse) {
  const auto square = [](std::uint8_t root) { return static_cast<int>(root) * root; };
  for (int i = 0; i < count; ++i, upper += 8, lower += 8, coarse += 4) {
    for (int k = 0; k < 4; ++k) {
      const int sum =
          square(upper[k]) + square(upper[k + 4]) + square(lower[k]) + square(lower[k + 4]);
      coarse[k] = static_cast<std::uint8_t>(std::sqrt(0.25F * static_cast<float>(sum)) + 0.5F);
    }
  }
}

}  // namespace sim

#include "sim/write/carry_rows.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "sim/trace/lanes.h"

namespace sim {
namespace {

constexpr int kFractionBits = 16;  ///< places in the view are whole multiples of 2^-16 px
constexpr double kPlaces_per_px = 1 << kFractionBits;
/// Linear between pixels, taps a pixel apart smear evenly; measured: with 2 a pixel no nearer
/// to many renderings.
constexpr double kTaps_per_px = 1.0;
constexpr double kMaxTaps_count = 64;  ///< bounds the cost where a recorded camera jumps
/// z in the view over z in the row's camera: keeps before the camera what a turn of some 80
/// degrees takes behind it.
constexpr double kMinStretch_ratio = 0.1;

using Eight = float __attribute__((vector_size(32)));  ///< two pixels of a LitView

[[gnu::always_inline]] inline Eight PixelPair(const float* pixels) {
  Eight pair;
  std::memcpy(&pair, pixels, sizeof(pair));
  return pair;
}

inline std::int32_t NearestPlace(double px) {
  const double places = px * kPlaces_per_px;
  return static_cast<std::int32_t>(places < 0 ? places - 0.5 : places + 0.5);
}

inline double Inside(double x, double low, double high) {
  const double above = x > low ? x : low;
  return above < high ? above : high;
}

/// As Lens::Distort up to its reach, which no pixel of the image is beyond.
inline void Distort(const Lens& lens, double reach2, double& x, double& y) {
  const double r2 = x * x + y * y, inner2 = r2 < reach2 ? r2 : reach2;
  const double radial = 1.0 + inner2 * (lens.k1 + inner2 * (lens.k2 + inner2 * lens.k3));
  const double bent_x = x * radial + 2.0 * lens.p1 * x * y + lens.p2 * (r2 + 2.0 * x * x);
  y = y * radial + lens.p1 * (r2 + 2.0 * y * y) + 2.0 * lens.p2 * x * y;
  x = bent_x;
}

template <bool kLens>
[[gnu::always_inline]] inline void Carry(const Pose& T_vr, const Camera& camera,
                                         const CarriedRow& row) {
  const double* R = T_vr.R.data();  // column by column
  const double* t = T_vr.t.data();
  const double r00 = R[0], r10 = R[1], r20 = R[2], r01 = R[3], r11 = R[4], r21 = R[5],
               r02 = R[6], r12 = R[7], r22 = R[8], t0 = t[0], t1 = t[1], t2 = t[2];
  const double fx = camera.fx, fy = camera.fy, cx = camera.cx, cy = camera.cy;
  const Lens lens = camera.lens;
  const double reach2 = lens.reach * lens.reach;
  const double width = camera.width, height = camera.height;
  const double* __restrict x = row.x;
  const double* __restrict y = row.y;
  const double* __restrict w = row.inverse_z;
  double* __restrict u = row.u;
  double* __restrict v = row.v;
  const int count = camera.width;
  for (int i = 0; i < count; ++i) {
    const double ahead = r20 * x[i] + r21 * y[i] + r22 + w[i] * t2;
    const double h = ahead > kMinStretch_ratio ? ahead : kMinStretch_ratio;
    const double share = 1.0 / h;
    double px = (r00 * x[i] + r01 * y[i] + r02 + w[i] * t0) * share;
    double py = (r10 * x[i] + r11 * y[i] + r12 + w[i] * t1) * share;
    if (kLens) Distort(lens, reach2, px, py);
    // Far outside, a place only has to stay there.
    u[i] = Inside(fx * px + cx, -width, 2.0 * width);
    v[i] = Inside(fy * py + cy, -height, 2.0 * height);
  }
}

}  // namespace

SIM_LANES void LightRow(const float* __restrict radiance, const double* __restrict depth_m,
                        int width, float* __restrict lit) {
  for (int u = 0; u < width; ++u) {
    for (int k = 0; k < 3; ++k) lit[4 * u + k] = radiance[3 * u + k];
    lit[4 * u + 3] = depth_m[u] > 0 ? static_cast<float>(1.0 / depth_m[u]) : 0.0F;
  }
  for (int k = 0; k < 4; ++k) lit[4 * width + k] = lit[4 * (width - 1) + k];
}

void RaiseBlocks(const float* lit, int width, int block_px, float* nearest) {
  for (int first = 0; first < width; first += block_px, ++nearest) {
    const int last = std::min(first + block_px, width);
    for (int u = first; u < last; ++u) *nearest = std::max(*nearest, lit[4 * u + 3]);
  }
}

SIM_LANES void CarryRow(const Pose& T_vr, const Camera& camera, const CarriedRow& row) {
  if (camera.lens.IsNone()) {
    Carry<false>(T_vr, camera, row);
  } else {
    Carry<true>(T_vr, camera, row);
  }
}

SIM_LANES void LookNearer(const LitView& view, const Pose& T_vr, const CarriedRow& row) {
  const double last_u = view.width - 1, last_v = view.height - 1;
  const int stride = view.Stride(), count = view.width;
  const double *R = T_vr.R.data(), r20 = R[2], r21 = R[5], r22 = R[8];
  for (int i = 0; i < count; ++i) {
    const auto u = static_cast<int>(Inside(row.u[i], 0.0, last_u) + 0.5);
    const auto v = static_cast<int>(Inside(row.v[i], 0.0, last_v) + 0.5);
    const auto there = static_cast<double>(view.pixels[v * stride + 4 * u + 3]);
    const double inverse_z = there * (r20 * row.x[i] + r21 * row.y[i] + r22);
    row.inverse_z[i] = inverse_z > row.inverse_z[i] ? inverse_z : row.inverse_z[i];
  }
}

SIM_LANES void PlaceTaps(const double* __restrict begin_u, const double* __restrict begin_v,
                         const double* __restrict end_u, const double* __restrict end_v,
                         int width, const TapRow& taps) {
  std::int32_t* __restrict u = taps.u, * __restrict v = taps.v, * __restrict count = taps.count;
  std::int32_t* __restrict step_u = taps.step_u, * __restrict step_v = taps.step_v;
  for (int i = 0; i < width; ++i) {
    const double way_u = end_u[i] - begin_u[i], way_v = end_v[i] - begin_v[i];
    const double length = std::sqrt(way_u * way_u + way_v * way_v) * kTaps_per_px;
    const auto taps_in = static_cast<std::int32_t>(Inside(length + 1.0, 1.0, kMaxTaps_count));
    const double n = taps_in, gap_u = way_u / n, gap_v = way_v / n;
    // Each tap stands for an equal part of the way, and lies in its middle.
    u[i] = NearestPlace(begin_u[i] + 0.5 * gap_u);
    v[i] = NearestPlace(begin_v[i] + 0.5 * gap_v);
    step_u[i] = NearestPlace(gap_u);
    step_v[i] = NearestPlace(gap_v);
    count[i] = taps_in;
  }
}

SIM_LANES void MeanOfTaps(const LitView& view, const TapRow& taps, float* radiance) {
  constexpr std::int32_t kFraction = (1 << kFractionBits) - 1;
  constexpr float kPlace_px = 1.0F / (1 << kFractionBits);
  constexpr Eight kLeft{1, 1, 1, 1, 0, 0, 0, 0}, kToRight{-1, -1, -1, -1, 1, 1, 1, 1};
  const std::int32_t last_u = (view.width - 1) << kFractionBits;
  const std::int32_t last_v = (view.height - 1) << kFractionBits;
  const std::ptrdiff_t stride = view.Stride();
  for (int i = 0; i < view.width; ++i, radiance += 3) {
    const std::int32_t count = taps.count[i], step_u = taps.step_u[i], step_v = taps.step_v[i];
    std::int32_t u = taps.u[i], v = taps.v[i];
    Eight sum{};
    for (std::int32_t k = 0; k < count; ++k, u += step_u, v += step_v) {
      const std::int32_t at_u = std::min(std::max(u, 0), last_u);
      const std::int32_t at_v = std::min(std::max(v, 0), last_v);
      const float* upper = view.pixels + (at_v >> kFractionBits) * stride +
                           4 * static_cast<std::ptrdiff_t>(at_u >> kFractionBits);
      const float right = static_cast<float>(at_u & kFraction) * kPlace_px;
      const float down = static_cast<float>(at_v & kFraction) * kPlace_px;
      const Eight above = PixelPair(upper), below = PixelPair(upper + stride);
      sum += (above + down * (below - above)) * (kLeft + right * kToRight);
    }
    const float share = 1.0F / static_cast<float>(count);
    for (int c = 0; c < 3; ++c) radiance[c] = (sum[c] + sum[c + 4]) * share;
  }
}

}  // namespace sim

#include "slam/segment/roughness.h"

#include <array>
#include <cstddef>
#include <cstring>

#include "slam/base/lane_math.h"
#include "slam/base/require.h"
#include "slam/segment/pixels/block_pixels.h"

namespace slam {
namespace {

constexpr int kApart_px = kLanes;  // so the right pixels of eight are the next eight
constexpr int kMinPairs = 30;  // the mean square is then known to about a quarter: sqrt(2 / 30)
constexpr int kMaxStep_px = 64;  // pixels; bounds the table of columns

using EightMarks = signed char __attribute__((vector_size(8)));  // -1 or 0
using EightLabels = std::uint8_t __attribute__((vector_size(8)));

SLAM_INLINE EightMarks Equal(const std::uint8_t* labels, std::uint8_t label) {
  EightLabels eight;
  std::memcpy(&eight, labels, sizeof eight);
  return (EightMarks)(eight == label);
}

SLAM_INLINE bool AnyOf(EightMarks marks) {
  std::uint64_t bits;
  std::memcpy(&bits, &marks, sizeof bits);
  return bits != 0;
}

/// Squared differences, of a row: few enough to be added in float.
struct Pairs {
  FloatLanes squares{};
  IntLanes count{};

  SLAM_INLINE void Add(FloatLanes by, EightMarks marks) {
    const IntLanes used = __builtin_convertvector(marks, IntLanes);
    squares += (FloatLanes)((IntLanes)(by * by) & used);
    count -= used;
  }
};

/// Where the segment is and which of its pixels are looked at.
struct Looked {
  const cv::Mat1b& labels;
  const cv::Rect& bounds;
  std::uint8_t label;
  int step_px;
  /// -1 for every step-th column, beginning with one.
  std::array<signed char, kMaxStep_px + kLanes> columns{};

  Looked(const cv::Mat1b& labels_in, const cv::Rect& bounds_in, std::uint8_t label_in, int step)
      : labels(labels_in), bounds(bounds_in), label(label_in), step_px(step) {
    for (int k = 0; k < step + kLanes; k += step) columns[static_cast<std::size_t>(k)] = -1;
  }
};

SLAM_INLINE FloatLanes Residuals(const DepthGrid& grid, std::size_t i, const PixelPlane& p) {
  const FloatLanes x = Lanes(grid.x.data() + i), y = Lanes(grid.y.data() + i);
  return (Lanes(grid.q.data() + i) - (p.a * x + p.b * y + p.c)) * Lanes(grid.g.data() + i);
}

}  // namespace

/// Sums the pairs of the pixels of a row, eight at a time as far as the image has two times
/// eight more. @returns the first column that is left
SLAM_LANES static int AddRow(const DepthGrid& grid, const PixelPlane& of, const Looked& looked,
                             int v, double& squares, int& count) {
  const PixelPlane plane = of;
  Pairs pairs;
  const std::uint8_t* row = looked.labels[v];
  const bool has_below = v + kApart_px < looked.labels.rows;
  const std::uint8_t* below = has_below ? looked.labels[v + kApart_px] : nullptr;
  const int end = looked.bounds.x + looked.bounds.width;
  FloatLanes next{};
  int next_u = -1;  // where `next` was taken
  int u = looked.bounds.x, offset = 0;
  for (; u < end && u + 2 * kLanes <= looked.labels.cols; u += kLanes) {
    EightMarks here;
    std::memcpy(&here, looked.columns.data() + offset, sizeof here);
    here &= Equal(row + u, looked.label);
    offset += kLanes % looked.step_px;
    if (offset >= looked.step_px) offset -= looked.step_px;
    if (!AnyOf(here)) continue;
    const auto i = static_cast<std::size_t>(grid.Index(u, v));
    const FloatLanes residuals = next_u == u ? next : Residuals(grid, i, plane);
    next = Residuals(grid, i + kApart_px, plane), next_u = u + kLanes;
    pairs.Add(residuals - next, here & Equal(row + u + kApart_px, looked.label));
    if (!has_below) continue;
    const std::size_t under = i + static_cast<std::size_t>(grid.Index(0, kApart_px));
    pairs.Add(residuals - Residuals(grid, under, plane), here & Equal(below + u, looked.label));
  }
  for (int k = 0; k < kLanes; ++k) squares += static_cast<double>(pairs.squares[k]);
  count += SumOf(pairs.count);
  return u;
}

double MeasureRoughness(const DepthGrid& grid, const cv::Mat1b& labels, const cv::Rect& bounds,
                        std::uint8_t label, const InverseDepthPlane& plane,
                        const DepthNoise& noise, int step_px) {
  Require(step_px >= 1 && step_px <= kMaxStep_px, "MeasureRoughness: step_px outside [1, 64]");
  const PixelPlane unslanted(LabelPlane{plane, 1.0});
  const Looked looked(labels, bounds, label, step_px);
  double squares = 0.0;
  int count = 0;

  // Adds the difference from a pixel's residual to that of another, if the segment has it.
  const auto add = [&](float here, int u, int v) {
    if (u >= labels.cols || v >= labels.rows || labels(v, u) != label) return;
    const auto i = static_cast<std::size_t>(grid.Index(u, v));
    const float by = here - ResidualSigmas(grid, i, unslanted);
    squares += static_cast<double>(by * by), ++count;
  };

  // Each pixel that is looked at, with the one to its right and the one below.
  for (int v = bounds.y; v < bounds.y + bounds.height; v += step_px) {
    for (int u = AddRow(grid, unslanted, looked, v, squares, count);
         u < bounds.x + bounds.width; ++u) {
      if ((u - bounds.x) % step_px != 0 || labels(v, u) != label) continue;
      const auto i = static_cast<std::size_t>(grid.Index(u, v));
      const float here = ResidualSigmas(grid, i, unslanted);
      add(here, u + kApart_px, v);
      add(here, u, v + kApart_px);
    }
  }

  // A difference has the noise of two pixels, as seen at the slant in the segment's middle.
  if (count < kMinPairs) return 0.0;
  const int u = bounds.x + bounds.width / 2, v = bounds.y + bounds.height / 2;
  const auto i = static_cast<std::size_t>(grid.Index(u, v));
  const auto x = static_cast<double>(grid.x[i]), y = static_cast<double>(grid.y[i]);
  const double q = plane.InverseDepth(x, y);
  const double grazing = q > 0 ? noise.GrazingFactor(1.0 / q, plane.Cosine(x, y)) : 1.0;
  return squares / (2.0 * count * grazing * grazing);
}

}  // namespace slam

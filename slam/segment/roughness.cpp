#include "slam/segment/roughness.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

#include "slam/base/index.h"
#include "slam/base/lane_math.h"
#include "slam/base/require.h"
#include "slam/geometry/sensor_model.h"
#include "slam/segment/pixels/block_pixels.h"

namespace slam {
namespace {

constexpr int kMaxApart_px = 8;
constexpr double kApartBends = 1.0 / 3.0;  // of a bend's length: depth varies little across it
static_assert(kMaxApart_px <= kLanes, "AddRow looks one lane further");
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

/// Squared differences of pixels so far apart.
struct Pairs {
  double squares = 0.0;
  int count = 0;

  double HalfMean() const { return count < kMinPairs ? 0.0 : squares / (2.0 * count); }
};

/// The same of a row, few enough to be added in float.
struct RowPairs {
  FloatLanes squares{};
  IntLanes count{};

  SLAM_INLINE void Add(FloatLanes by, EightMarks marks) {
    const IntLanes used = __builtin_convertvector(marks, IntLanes);
    squares += (FloatLanes)((IntLanes)(by * by) & used);
    count -= used;
  }
  SLAM_INLINE void AddTo(Pairs& pairs) const {
    for (int k = 0; k < kLanes; ++k) pairs.squares += static_cast<double>(squares[k]);
    pairs.count += SumOf(count);
  }
};

/// How far apart two pixels are compared: nearer in small images, where bends are shorter.
int ApartPx(const DepthGrid& grid) {
  if (grid.width < 2) return kMaxApart_px;
  const auto i = static_cast<std::size_t>(grid.Index(grid.width / 2, grid.height / 2));
  const auto pixel_rad = static_cast<double>(grid.x[i] - grid.x[i - 1]);
  return std::clamp(static_cast<int>(kApartBends * kBendLength_rad / pixel_rad), 2,
                    kMaxApart_px);
}

/// Where the segment is and which of its pixels are looked at.
struct Looked {
  const cv::Mat1b& labels;
  const cv::Rect& bounds;
  std::uint8_t label;
  int step_px;
  int apart_px;
  /// -1 for every step-th column, beginning with one.
  std::array<signed char, kMaxStep_px + kLanes> columns{};

  Looked(const cv::Mat1b& labels_in, const cv::Rect& bounds_in, std::uint8_t label_in, int step,
         int apart)
      : labels(labels_in), bounds(bounds_in), label(label_in), step_px(step), apart_px(apart) {
    for (int k = 0; k < step + kLanes; k += step) columns[Index(k)] = -1;
  }
};

SLAM_INLINE FloatLanes Residuals(const DepthGrid& grid, std::size_t i, const PixelPlane& p) {
  const FloatLanes x = Lanes(grid.x.data() + i), y = Lanes(grid.y.data() + i);
  return (Lanes(grid.q.data() + i) - (p.a * x + p.b * y + p.c)) * Lanes(grid.g.data() + i);
}

/// Adds the pairs of eight pixels with the eight from (u, v) on, which the image may not have.
SLAM_INLINE void AddEight(const DepthGrid& grid, const PixelPlane& plane, const Looked& looked,
                          FloatLanes residuals, EightMarks here, int u, int v,
                          RowPairs& pairs) {
  if (v >= looked.labels.rows) return;
  const auto i = static_cast<std::size_t>(grid.Index(u, v));
  pairs.Add(residuals - Residuals(grid, i, plane),
            here & Equal(looked.labels[v] + u, looked.label));
}

}  // namespace

/// Adds the pairs of the pixels of a row, eight at a time as far as the image has two times
/// eight more. @returns the first column that is left
SLAM_LANES static int AddRow(const DepthGrid& grid, const PixelPlane& of, const Looked& looked,
                             int v, Pairs& fine, Pairs& coarse) {
  const PixelPlane plane = of;
  RowPairs row_fine, row_coarse;
  const cv::Mat1b& labels = looked.labels;
  const int end = looked.bounds.x + looked.bounds.width;
  int u = looked.bounds.x, offset = 0;
  for (; u < end && u + 2 * kLanes <= labels.cols; u += kLanes) {
    EightMarks here;
    std::memcpy(&here, looked.columns.data() + offset, sizeof here);
    here &= Equal(labels[v] + u, looked.label);
    offset += kLanes % looked.step_px;
    if (offset >= looked.step_px) offset -= looked.step_px;
    if (!AnyOf(here)) continue;
    const FloatLanes residuals =
        Residuals(grid, static_cast<std::size_t>(grid.Index(u, v)), plane);
    AddEight(grid, plane, looked, residuals, here, u + 1, v, row_fine);
    AddEight(grid, plane, looked, residuals, here, u, v + 1, row_fine);
    AddEight(grid, plane, looked, residuals, here, u + looked.apart_px, v, row_coarse);
    AddEight(grid, plane, looked, residuals, here, u, v + looked.apart_px, row_coarse);
  }
  row_fine.AddTo(fine);
  row_coarse.AddTo(coarse);
  return u;
}

Roughness MeasureRoughness(const DepthGrid& grid, const cv::Mat1b& labels,
                           const cv::Rect& bounds, std::uint8_t label,
                           const InverseDepthPlane& plane, const DepthNoise& noise,
                           int step_px) {
  Require(step_px >= 1 && step_px <= kMaxStep_px, "MeasureRoughness: step_px outside [1, 64]");
  const PixelPlane unslanted(LabelPlane{plane, 1.0});
  const Looked looked(labels, bounds, label, step_px, ApartPx(grid));
  Pairs fine, coarse;

  // Adds the difference from a pixel's residual to that of another, if the segment has it.
  const auto add = [&](Pairs& pairs, float here, int u, int v) {
    if (u >= labels.cols || v >= labels.rows || labels(v, u) != label) return;
    const auto i = static_cast<std::size_t>(grid.Index(u, v));
    const float by = here - ResidualSigmas(grid, i, unslanted);
    pairs.squares += static_cast<double>(by * by), ++pairs.count;
  };

  // Each pixel that is looked at, with those to its right and those below.
  for (int v = bounds.y; v < bounds.y + bounds.height; v += step_px) {
    for (int u = AddRow(grid, unslanted, looked, v, fine, coarse); u < bounds.x + bounds.width;
         ++u) {
      if ((u - bounds.x) % step_px != 0 || labels(v, u) != label) continue;
      const auto i = static_cast<std::size_t>(grid.Index(u, v));
      const float here = ResidualSigmas(grid, i, unslanted);
      add(fine, here, u + 1, v);
      add(fine, here, u, v + 1);
      add(coarse, here, u + looked.apart_px, v);
      add(coarse, here, u, v + looked.apart_px);
    }
  }

  // A difference has the noise of two pixels, as seen at the slant in the segment's middle.
  const int u = bounds.x + bounds.width / 2, v = bounds.y + bounds.height / 2;
  const auto i = static_cast<std::size_t>(grid.Index(u, v));
  const auto x = static_cast<double>(grid.x[i]), y = static_cast<double>(grid.y[i]);
  const double q = plane.InverseDepth(x, y);
  const double grazing = q > 0 ? noise.GrazingFactor(1.0 / q, plane.Cosine(x, y)) : 1.0;
  return {fine.HalfMean() / (grazing * grazing), coarse.HalfMean() / (grazing * grazing)};
}

}  // namespace slam

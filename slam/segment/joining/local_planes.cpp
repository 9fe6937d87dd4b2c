#include "slam/segment/joining/local_planes.h"

#include <algorithm>
#include <cstddef>
#include <opencv2/core/types.hpp>

#include "slam/base/index.h"

namespace slam {
namespace {

constexpr int kAround_blocks = 1;  // of a tile: a fit is short against the bend

/// The plane through some pixels near that of their surface.
InverseDepthPlane FitNear(const PlaneSums& s, const InverseDepthPlane& p, double correlated,
                          const JoinConfig& config) {
  // Sums of residuals and of rays about the pixels' middle.
  const double x = s.wx / s.w, y = s.wy / s.w;
  const double wr = s.wq - (p.a * s.wx + p.b * s.wy + p.c * s.w);
  const double wrx = s.wqx - (p.a * s.wxx + p.b * s.wxy + p.c * s.wx) - x * wr;
  const double wry = s.wqy - (p.a * s.wxy + p.b * s.wyy + p.c * s.wy) - y * wr;
  const double cxx = s.wxx - x * s.wx, cxy = s.wxy - x * s.wy, cyy = s.wyy - y * s.wy;

  // A bend has so much information on value and slope beside that of the pixels.
  const double value = config.bend_ratio * s.wq / s.w, slope = value / config.bend_length_rad;
  const double at_value = correlated / (value * value), at_slope = correlated / (slope * slope);
  const double dv = wr / (s.w + at_value);
  const double xx = cxx + at_slope, yy = cyy + at_slope, det = xx * yy - cxy * cxy;
  const double da = (yy * wrx - cxy * wry) / det, db = (xx * wry - cxy * wrx) / det;
  return {p.a + da, p.b + db, p.c + dv - da * x - db * y};
}

/// The tiles that a label's parts can tell of.
cv::Rect TilesOf(const PartsOnBlocks& on, const std::vector<int>& into, int label) {
  cv::Rect blocks;
  for (int block = 0; block < on.cols * on.rows; ++block) {
    const auto b = static_cast<std::size_t>(block);
    for (std::size_t k = on.first[b]; k < on.first[b + 1]; ++k)
      if (into[Index(on.parts[k].label)] == label)
        blocks |= cv::Rect(block % on.cols, block / on.cols, 1, 1);
  }
  const int left = std::max(blocks.x - kAround_blocks, 0) / kTile_blocks,
            top = std::max(blocks.y - kAround_blocks, 0) / kTile_blocks;
  const int right = TileCount(blocks.x + blocks.width + kAround_blocks),
            bottom = TileCount(blocks.y + blocks.height + kAround_blocks);
  return {left, top, right - left, bottom - top};
}

}  // namespace

std::vector<LabelPlane> FitLocally(const PartsOnBlocks& on, const std::vector<int>& into,
                                   int label, const LabelPlane& plane, const DepthNoise& noise,
                                   const JoinConfig& config) {
  const int cols = TileCount(on.cols), rows = TileCount(on.rows);
  std::vector<LabelPlane> planes(static_cast<std::size_t>(cols * rows), plane);
  const double correlated = noise.correlated_px * plane.grazing * plane.grazing;
  const cv::Rect own = TilesOf(on, into, label);
  for (int r = own.y; r < std::min(own.y + own.height, rows); ++r) {
    for (int c = own.x; c < std::min(own.x + own.width, cols); ++c) {
      PlaneSums sums;
      on.VisitWindow(kTile_blocks * c - kAround_blocks, kTile_blocks * r - kAround_blocks,
                     kTile_blocks * (c + 1) - 1 + kAround_blocks,
                     kTile_blocks * (r + 1) - 1 + kAround_blocks, [&](const BlockPart& part) {
                       if (into[Index(part.label)] == label) sums += part.sums;
                     });
      if (!(sums.w > 0)) continue;
      planes[Index(r * cols + c)].plane = FitNear(sums, plane.plane, correlated, config);
    }
  }
  return planes;
}

}  // namespace slam

#pragma once

#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace slam {

/// The sides of near things, as seen in the image.
enum class NearSide { kLeft, kRight, kTop, kBottom };
inline constexpr int kNearSides = 4;

/// Where a near thing ends before something farther.
struct DepthEdge {
  float u_px = 0.0f, v_px = 0.0f;  ///< half-way between its last pixel and the next
  float z_m = 0.0f;                ///< of its last pixel
};

/// Edges by the side of the near thing.
using DepthEdges = std::array<std::vector<DepthEdge>, kNearSides>;

/// Depth edges that run nearly along the columns or the rows of the image, in every other row or
/// column: what lies beyond is farther by 6 % or more, with at most ten pixels without depth in
/// between, and so it is four pixels up and down the edge, too.
DepthEdges FindDepthEdges(const cv::Mat1f& depth_m);

}  // namespace slam

#include "slam/calibrate/depth_edges.h"

#include <cmath>
#include <opencv2/core.hpp>
#include <utility>

namespace slam {
namespace {

// More than any slanted surface and any bend of the sensor does from pixel to pixel.
constexpr float kMinStepRatio = 0.06f;
// Beside near things lies a shadow without depth: the far side of a wide one is elsewhere.
constexpr int kMaxGap_px = 10;
constexpr int kRowStep_px = 2;   // of rows that are looked at: neighbours say the same
constexpr int kSupport_px = 4;   // up and down the edge
constexpr int kMaxSlant_px = 1;  // over these
constexpr signed char kNoEdge = 0, kNearBefore = 1, kNearAfter = 2;

/// For each pixel whether the next measured one in its row is an edge, of `lines` read along
/// rows; where the near thing is on the side of the pixel with the lower index (kNearBefore),
/// it is marked there, else at the last pixel before the near thing.
cv::Mat1b MarkAlongRows(const cv::Mat1f& depth_m) {
  cv::Mat1b marks(depth_m.size(), kNoEdge);
  for (int v = 0; v < depth_m.rows; v += kRowStep_px) {
    const float* z = depth_m[v];
    int last = -1;  // measured
    for (int u = 0; u < depth_m.cols; ++u) {
      if (!(z[u] > 0.0f)) continue;
      if (last >= 0 && u - last <= kMaxGap_px + 1) {
        const float step = z[u] - z[last];
        if (step > kMinStepRatio * z[last]) marks(v, last) = kNearBefore;
        if (-step > kMinStepRatio * z[u]) marks(v, u - 1) = kNearAfter;
      }
      last = u;
    }
  }
  return marks;
}

bool HasNear(const cv::Mat1b& marks, int v, int u, unsigned char mark) {
  for (int k = -kMaxSlant_px; k <= kMaxSlant_px; ++k)
    if (marks(v, u + k) == mark) return true;
  return false;
}

/// Adds the marked edges that go on up and down. @param transposed  rows are the image's columns
void AddEdges(const cv::Mat1f& depth_m, bool transposed, std::vector<DepthEdge>& before,
              std::vector<DepthEdge>& after) {
  const cv::Mat1b marks = MarkAlongRows(depth_m);
  for (int v = kSupport_px; v + kSupport_px < marks.rows; v += kRowStep_px) {
    for (int u = kMaxSlant_px; u + kMaxSlant_px + 1 < marks.cols; ++u) {
      const unsigned char mark = marks(v, u);
      if (mark == kNoEdge || !HasNear(marks, v - kSupport_px, u, mark) ||
          !HasNear(marks, v + kSupport_px, u, mark))
        continue;
      const auto along = static_cast<float>(u) + 0.5f, across = static_cast<float>(v);
      const float z_m = depth_m(v, mark == kNearBefore ? u : u + 1);
      DepthEdge edge{along, across, z_m};
      if (transposed) std::swap(edge.u_px, edge.v_px);
      (mark == kNearBefore ? before : after).push_back(edge);
    }
  }
}

}  // namespace

DepthEdges FindDepthEdges(const cv::Mat1f& depth_m) {
  DepthEdges edges;
  const auto of = [&](NearSide side) -> auto& { return edges[static_cast<std::size_t>(side)]; };
  AddEdges(depth_m, false, of(NearSide::kRight), of(NearSide::kLeft));
  cv::Mat1f columns;
  cv::transpose(depth_m, columns);
  AddEdges(columns, true, of(NearSide::kBottom), of(NearSide::kTop));
  return edges;
}

}  // namespace slam

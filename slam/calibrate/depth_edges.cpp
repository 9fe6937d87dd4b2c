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

/// Pixels after which the next measured one in their row is an edge, as an image and one after the
/// other.
struct Marks {
  cv::Mat1b image;
  std::vector<cv::Point> pixels;
};

/// Where the near thing is on the side of the pixel with the lower index (kNearBefore), the edge
/// is marked there, else at the last pixel before the near thing.
Marks MarkAlongRows(const cv::Mat1f& depth_m) {
  Marks marks{cv::Mat1b(depth_m.size(), kNoEdge), {}};
  const auto mark = [&](int v, int u, unsigned char as) {
    marks.image(v, u) = as;
    marks.pixels.emplace_back(u, v);
  };
  for (int v = 0; v < depth_m.rows; v += kRowStep_px) {
    const float* z = depth_m[v];
    int last = -1;  // measured
    for (int u = 0; u < depth_m.cols; ++u) {
      if (!(z[u] > 0.0f)) continue;
      if (last >= 0 && u - last <= kMaxGap_px + 1) {
        const float step = z[u] - z[last];
        if (step > kMinStepRatio * z[last]) mark(v, last, kNearBefore);
        if (-step > kMinStepRatio * z[u]) mark(v, u - 1, kNearAfter);
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
  const Marks marks = MarkAlongRows(depth_m);
  const cv::Rect inner(kMaxSlant_px, kSupport_px, depth_m.cols - 2 * kMaxSlant_px - 1,
                       depth_m.rows - 2 * kSupport_px);
  for (const cv::Point& at : marks.pixels) {
    const unsigned char mark = marks.image(at);
    if (!inner.contains(at) || !HasNear(marks.image, at.y - kSupport_px, at.x, mark) ||
        !HasNear(marks.image, at.y + kSupport_px, at.x, mark))
      continue;
    const auto along = static_cast<float>(at.x) + 0.5f, across = static_cast<float>(at.y);
    const float z_m = depth_m(at.y, mark == kNearBefore ? at.x : at.x + 1);
    DepthEdge edge{along, across, z_m};
    if (transposed) std::swap(edge.u_px, edge.v_px);
    (mark == kNearBefore ? before : after).push_back(edge);
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

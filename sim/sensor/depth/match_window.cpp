#include "sim/sensor/depth/match_window.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "sim/sensor/depth/blob_noise.h"
#include "sim/sensor/depth/depth_effects.h"
#include "sim/sensor/depth/window_rows.h"

namespace sim {
namespace {

/// The work of one frame. Its memory is kept from one frame to the next.
class WindowMatcher {
 public:
  void Start(const Rendering& rendering, const MatchWindow& model, double disparity_m_steps) {
    model_ = model;
    reach_ = model.side_px / 2;
    size_ = rendering.depth_m.size();
    view_.stride = size_.width + 2 * reach_ + WindowCounts::kWindows;
    view_.max_apart_steps = static_cast<float>(model.max_apart_steps);
    const auto pixels = static_cast<std::size_t>(view_.stride * (size_.height + 2 * reach_));
    steps_.assign(pixels, 0.0F);
    surface_.assign(pixels, 0);
    const std::ptrdiff_t first = reach_ * view_.stride + reach_;
    view_.steps = steps_.data() + first;
    view_.surface = surface_.data() + first;
    for (int v = 0; v < size_.height; ++v) {
      Load(rendering, v, disparity_m_steps, first + v * view_.stride);
    }
  }

  /// 255 where a window holds a border between surfaces that do not match as one.
  cv::Mat1b NearBorders() const {
    cv::Mat1b border(size_, uchar{0});
    for (int v = 0; v < size_.height; ++v) {
      const std::ptrdiff_t row = v * view_.stride;
      for (const int side : {0, 1}) {
        MarkApart(view_, row, row + 1, size_.width - 1, border[v] + side);
        if (v + 1 == size_.height) continue;
        MarkApart(view_, row, row + view_.stride, size_.width, border[v + side]);
      }
    }
    cv::dilate(border, border, cv::Mat1b::ones(2 * reach_ + 1, 2 * reach_ + 1));
    return border;
  }

  /// Marks (255) those of row v that fail, of the pixels that are asked about.
  void MarkRow(int v, const uchar* ask, const BlobNoise& dots, uchar* lost) const {
    for (int first = 0; first < size_.width; first += WindowCounts::kWindows) {
      const int last = std::min(first + WindowCounts::kWindows, size_.width);
      if (std::all_of(ask + first, ask + last, [](uchar asked) { return asked == 0; }))
        continue;
      const WindowCounts counts = CountWindows(view_, first, v, reach_);
      for (int u = first; u < last; ++u) {
        const auto i = static_cast<std::size_t>(u - first);
        if (ask[u] != 0 && Fails(u, v, counts.same[i], counts.nearer[i], dots)) lost[u] = 255;
      }
    }
  }

 private:
  bool Fails(int u, int v, int same, int nearer, const BlobNoise& dots) const {
    const cv::Rect window =
        cv::Rect(u - reach_, v - reach_, 2 * reach_ + 1, 2 * reach_ + 1) & cv::Rect({}, size_);
    if (!(view_.steps[v * view_.stride + u] > 0)) return false;
    // The share of dots that fell on the own surface: of n at random its variance is p (1 - p) / n.
    const double share = same / static_cast<double>(window.area());
    const double sd = model_.dots > 0 ? std::sqrt(share * (1.0 - share) / model_.dots) : 0.0;
    // Dots that one surface has too many of, the other lacks: near and far are never lost at once.
    const bool far = 2 * nearer > window.area() - same;
    return share + (far ? -sd : sd) * dots.At(u, v) < model_.min_share;
  }

  /// Where no light of the projector falls there is nothing to match: 0 steps.
  void Load(const Rendering& rendering, int v, double disparity_m_steps, std::ptrdiff_t first) {
    const uchar* lit = rendering.projector_lit.empty() ? nullptr : rendering.projector_lit[v];
    DisparitySteps(rendering.depth_m[v], lit, disparity_m_steps, size_.width,
                   steps_.data() + first);
    const ushort *plane = rendering.plane_id[v], *object = rendering.object_id[v];
    std::int32_t* surface = surface_.data() + first;
    for (int u = 0; u < size_.width; ++u) {
      surface[u] =
          static_cast<std::int32_t>(static_cast<std::uint32_t>(plane[u]) << 16 | object[u]);
    }
  }

  MatchWindow model_;
  int reach_ = 0;
  cv::Size size_;
  MatchView view_;
  std::vector<float> steps_;
  std::vector<std::int32_t> surface_;
};

}  // namespace

void MarkMixedWindows(const Rendering& rendering, const MatchWindow& model,
                      double disparity_m_steps, const PixelNoise& noise, cv::Mat1b& lost) {
  if (model.side_px == 0) return;
  thread_local WindowMatcher matcher;  // memory only
  matcher.Start(rendering, model, disparity_m_steps);
  const BlobNoise dots(rendering.depth_m.size(), noise, kWindowDraw);
  const cv::Mat1b near = matcher.NearBorders();
  for (int v = 0; v < lost.rows; ++v) matcher.MarkRow(v, near[v], dots, lost[v]);
}

}  // namespace sim

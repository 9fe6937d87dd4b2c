#include "sim/sensor/match_window.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "sim/sensor/blob_noise.h"
#include "sim/sensor/depth_effects.h"

namespace sim {
namespace {

class WindowMatcher {
 public:
  WindowMatcher(const Rendering& rendering, const MatchWindow& model, double disparity_m_steps,
                const PixelNoise& noise)
      : model_(model),
        dots_(rendering.depth_m.size(), noise, kWindowDraw),
        reach_(model.side_px / 2),
        apart_(static_cast<float>(model.max_apart_steps)),
        surface_(rendering.depth_m.size()),
        steps_(rendering.depth_m.size()) {
    for (int v = 0; v < steps_.rows; ++v) Load(rendering, v, disparity_m_steps);
  }

  /// 255 where a window holds a border between surfaces that do not match as one.
  cv::Mat1b NearBorders() const {
    cv::Mat1b border(steps_.size(), uchar{0});
    for (int v = 0; v < steps_.rows; ++v) {
      const int below = std::min(v + 1, steps_.rows - 1);
      for (int u = 0; u < steps_.cols; ++u) {
        const int right = std::min(u + 1, steps_.cols - 1);
        if (!Same(v, u, v, right)) border(v, u) = border(v, right) = 255;
        if (!Same(v, u, below, u)) border(v, u) = border(below, u) = 255;
      }
    }
    cv::dilate(border, border, cv::Mat1b::ones(2 * reach_ + 1, 2 * reach_ + 1));
    return border;
  }

  bool Fails(int u, int v) const {
    const cv::Rect window = cv::Rect(u - reach_, v - reach_, 2 * reach_ + 1, 2 * reach_ + 1) &
                            cv::Rect({}, steps_.size());
    const int own_surface = surface_(v, u);
    const float own = steps_(v, u);
    int same = 0, nearer = 0;
    for (int y = window.y; y < window.br().y; ++y) {
      const int* surface = surface_[y] + window.x;
      const float* steps = steps_[y] + window.x;
      for (int i = 0; i < window.width; ++i) {
        same += static_cast<int>((steps[i] > 0) & ((surface[i] == own_surface) |
                                                   (std::abs(steps[i] - own) <= apart_)));
        nearer += static_cast<int>(steps[i] > own + apart_);
      }
    }
    if (!(own > 0)) return false;
    // The share of dots that fell on the own surface: of n at random its variance is p (1 - p) / n.
    const double share = same / static_cast<double>(window.area());
    const double sd = model_.dots > 0 ? std::sqrt(share * (1.0 - share) / model_.dots) : 0.0;
    // Dots that one surface has too many of, the other lacks: near and far are never lost at once.
    const bool far = 2 * nearer > window.area() - same;
    return share + (far ? -sd : sd) * dots_.At(u, v) < model_.min_share;
  }

 private:
  /// Where no light of the projector falls there is nothing to match: 0 steps.
  void Load(const Rendering& rendering, int v, double disparity_m_steps) {
    const uchar* lit = rendering.projector_lit.empty() ? nullptr : rendering.projector_lit[v];
    for (int u = 0; u < steps_.cols; ++u) {
      const double z = rendering.depth_m(v, u);
      const bool shown = z > 0 && (lit == nullptr || lit[u] != 0);
      steps_(v, u) = shown ? static_cast<float>(disparity_m_steps / z) : 0.0F;
      surface_(v, u) =
          static_cast<int>(static_cast<std::uint32_t>(rendering.plane_id(v, u)) << 16 |
                           rendering.object_id(v, u));
    }
  }

  bool Same(int v, int u, int to_v, int to_u) const {
    const float a = steps_(v, u), b = steps_(to_v, to_u);
    if ((a > 0) != (b > 0)) return false;
    return surface_(v, u) == surface_(to_v, to_u) || std::abs(a - b) <= apart_;
  }

  const MatchWindow& model_;
  BlobNoise dots_;
  int reach_;
  float apart_;
  cv::Mat1i surface_;
  cv::Mat1f steps_;
};

}  // namespace

void MarkMixedWindows(const Rendering& rendering, const MatchWindow& model,
                      double disparity_m_steps, const PixelNoise& noise, cv::Mat1b& lost) {
  if (model.side_px == 0) return;
  const WindowMatcher matcher(rendering, model, disparity_m_steps, noise);
  const cv::Mat1b near = matcher.NearBorders();
  for (int v = 0; v < lost.rows; ++v) {
    const uchar* ask = near[v];
    for (int u = 0; u < lost.cols; ++u) {
      if (ask[u] != 0 && matcher.Fails(u, v)) lost(v, u) = 255;
    }
  }
}

}  // namespace sim

#include "sim/sensor/depth/depth_sensor.h"

#include <algorithm>
#include <vector>

#include "sim/sensor/depth/depth_effects.h"
#include "sim/sensor/depth/kinect_rows.h"
#include "sim/sensor/recycled.h"

namespace sim {
namespace {

/// The work of one frame, row by row. Its memory is kept from one frame to the next.
class KinectRow {
 public:
  void Start(const Rendering& rendering, const KinectModel& model, const PixelNoise& noise,
             const BendField* bend) {
    rendering_ = &rendering;
    model_ = &model;
    bend_ = bend;
    const auto width = static_cast<std::size_t>(rendering.depth_m.cols);
    noise_.Start(rendering.depth_m.cols, 1, noise, kAxialDraw, 3);
    z_.resize(width);
    theta_.resize(width);
    du_.resize(width);
    dv_.resize(width);
    bent_.resize(bend == nullptr ? 0 : width);
    MarkLost(noise);
  }

  /// Rows 0, 1, 2 and so on.
  void Measure(int v, double* out) {
    noise_.Next();
    const int width = rendering_->depth_m.cols;
    KinectAngles(rendering_->incidence_cos[v], width, theta_.data());
    const double* depth = rendering_->depth_m[v];
    if (rendering_->projector_lit.empty()) {
      std::copy_n(depth, width, z_.data());
    } else {
      const uchar* lit = rendering_->projector_lit[v];
      for (int u = 0; u < width; ++u) z_[Index(u)] = lit[u] != 0 ? depth[u] : 0.0;
    }
    if (model_->lateral_scale > 0) LookBeside(v);
    if (!lost_.empty()) {
      const uchar* lost = lost_[v];
      for (int u = 0; u < width; ++u) z_[Index(u)] = lost[u] != 0 ? 0.0 : z_[Index(u)];
    }
    if (bend_ != nullptr) {
      bend_->Row(v, bent_);
      for (int u = 0; u < width; ++u)
        z_[Index(u)] *= 1.0 + static_cast<double>(bent_[Index(u)]);
    }
    KinectMeasured(z_.data(), theta_.data(), noise_.Row(kAxialDraw), *model_, width, out);
  }

 private:
  static std::size_t Index(int i) { return static_cast<std::size_t>(i); }

  /// What is lost whoever looks there; nothing unless the model asks for it.
  void MarkLost(const PixelNoise& noise) {
    lost_.release();
    const ReturnLoss& loss = model_->loss;
    if (loss.min_return_per_m2 == 0 && loss.mirror_spot_rad == 0 && model_->window.side_px == 0)
      return;
    lost_ = Recycled(kept_lost_, rendering_->depth_m.size());
    lost_.setTo(0);
    MarkReturnLoss(*rendering_, loss, noise, lost_);
    MarkMixedWindows(*rendering_, model_->window, model_->disparity_m_steps, noise, lost_);
  }

  /// Depth there; 0 where the projector does not reach, or it is lost.
  double Measurable(cv::Point at) const {
    if (!lost_.empty() && lost_(at) != 0) return 0;
    const cv::Mat1b& lit = rendering_->projector_lit;
    return lit.empty() || lit(at) != 0 ? rendering_->depth_m(at) : 0.0;
  }

  /// Which surface each pixel sees: its own, but near an edge perhaps a neighbour's.
  void LookBeside(int v) {
    const int width = rendering_->depth_m.cols, last = rendering_->depth_m.rows - 1;
    KinectJitter(theta_.data(), noise_.Row(kJitterUDraw), noise_.Row(kJitterVDraw),
                 model_->lateral_scale, width, du_.data(), dv_.data());
    const double* depth = rendering_->depth_m[v];
    for (int u = 0; u < width; ++u) {
      const cv::Point at(u, v), to(std::clamp(u + du_[Index(u)], 0, width - 1),
                                   std::clamp(v + dv_[Index(u)], 0, last));
      if (SameSurface(*rendering_, at, to) || !(depth[u] > 0)) continue;
      z_[Index(u)] = Measurable(to);
      theta_[Index(u)] = Incidence(rendering_->incidence_cos(to));
    }
  }

  const Rendering* rendering_ = nullptr;
  const KinectModel* model_ = nullptr;
  const BendField* bend_ = nullptr;
  SmoothNoiseRows noise_;
  std::vector<double> z_, theta_;
  std::vector<int> du_, dv_;
  std::vector<float> bent_;
  cv::Mat1b lost_, kept_lost_;  ///< 255 = lost; empty = nothing is
};

}  // namespace

KinectModel RecordedKinect() {
  KinectModel model;
  model.bend.rms = kRecordedBend;
  model.loss = kRecordedReturn;
  model.window = kRecordedWindow;
  return model;
}

cv::Mat1d MeasureDepth(const Rendering& rendering, const KinectModel& model,
                       const PixelNoise& noise, const BendField* bend) {
  thread_local KinectRow row;  // memory only
  thread_local cv::Mat1d kept;
  cv::Mat1d measured = Recycled(kept, rendering.depth_m.size());
  row.Start(rendering, model, noise, bend);
  for (int v = 0; v < measured.rows; ++v) row.Measure(v, measured[v]);
  return measured;
}

cv::Mat1w EncodeDepth(const cv::Mat1d& depth_m, double depth_factor) {
  thread_local cv::Mat1w kept;
  cv::Mat1w units = Recycled(kept, depth_m.size());
  for (int v = 0; v < depth_m.rows; ++v) {
    DepthUnits(depth_m[v], depth_factor, depth_m.cols, units[v]);
  }
  return units;
}

}  // namespace sim

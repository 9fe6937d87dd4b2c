#include "sim/sensor/depth/d435_sensor.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "sim/sensor/depth/depth_effects.h"
#include "sim/sensor/depth/rounded_sigma.h"

namespace sim {
namespace {

/// 255 where a window of this radius about the pixel holds more than one surface.
cv::Mat1b NearBorders(const Rendering& rendering, int radius) {
  cv::Mat1b border(rendering.depth_m.size(), uchar{0});
  for (int v = 0; v < border.rows; ++v) {
    for (int u = 0; u < border.cols; ++u) {
      for (const cv::Point to : {cv::Point(u + 1, v), cv::Point(u, v + 1)}) {
        if (to.x >= border.cols || to.y >= border.rows) continue;
        if (!SameSurface(rendering, {u, v}, to)) border(v, u) = border(to) = 255;
      }
    }
  }
  cv::dilate(border, border, cv::Mat1b::ones(2 * radius + 1, 2 * radius + 1));
  return border;
}

class D435Sensor {
 public:
  D435Sensor(const Rendering& rendering, const D435Model& model, const Camera& camera,
             const PixelNoise& noise)
      : rendering_(rendering),
        model_(model),
        camera_(camera),
        noise_(noise),
        sigma_(RoundedSigma::Of(model)),
        size_(rendering.depth_m.size()) {
    if (model.subpixel_px > 0 && model.correlated_share > 0) {
      smooth_ = SmoothNoise(size_, model.window_px / 2, noise, kAxialDraw);
    }
    Fatten();
    if (model.min_share > 0) {
      mixed_ = NearBorders(rendering, model.fattening_px + model.window_px / 2);
    }
  }

  /// 0 when there is no measurement.
  double At(int u, int v) const {
    if (!(rendering_.depth_m(v, u) > 0)) return 0;
    const cv::Point seen = seen_(v, u);
    const double z = rendering_.depth_m(seen);
    if (!(z >= model_.min_depth_m && z <= model_.max_depth_m)) return 0;
    if (model_.baseline_m != 0 && !SeenByRightImager(u, v, seen)) return 0;
    if (!mixed_.empty() && mixed_(v, u) != 0 && IsMixed(u, v)) return 0;
    const double measured = Triangulate(u, v, z);
    return measured > 0 ? RoundDepth(measured, model_.rounding_m) : 0;
  }

 private:
  double Disparity(double z) const { return model_.focal_baseline_px_m / z; }

  /// Which pixel's surface each pixel is given: the nearest thing in its window.
  void Fatten() {
    seen_.create(size_);
    const int reach = model_.fattening_px;
    const cv::Mat1b border =
        reach > 0 ? NearBorders(rendering_, reach) : cv::Mat1b(size_, uchar{0});
    for (int v = 0; v < size_.height; ++v) {
      for (int u = 0; u < size_.width; ++u) {
        seen_(v, u) = border(v, u) != 0 ? NearestThing(u, v, reach) : cv::Point(u, v);
      }
    }
  }

  /// The pixels of the image at most `reach` rows and columns away.
  cv::Rect Window(int u, int v, int reach) const {
    return cv::Rect(u - reach, v - reach, 2 * reach + 1, 2 * reach + 1) & cv::Rect({}, size_);
  }

  cv::Point NearestThing(int u, int v, int reach) const {
    const cv::Point here(u, v);
    if (!(rendering_.depth_m(here) > 0)) return here;
    // Of what is before this pixel's surface by more than the match tells apart, the closest in
    // the image.
    const double threshold = Disparity(rendering_.depth_m(here)) + model_.max_mixed_px;
    cv::Point best = here;
    int best_distance2 = 3 * reach * reach;
    const cv::Rect window = Window(u, v, reach);
    for (int y = window.y; y < window.br().y; ++y) {
      for (int x = window.x; x < window.br().x; ++x) {
        const double z = rendering_.depth_m(y, x);
        if (!(z > 0) || !(Disparity(z) > threshold)) continue;
        const int distance2 = (x - u) * (x - u) + (y - v) * (y - v);
        if (distance2 >= best_distance2 || SameSurface(rendering_, here, {x, y})) continue;
        best = {x, y};
        best_distance2 = distance2;
      }
    }
    return best;
  }

  bool SeenByRightImager(int u, int v, cv::Point seen) const {
    if (!rendering_.projector_lit.empty() && rendering_.projector_lit(seen) == 0) return false;
    // The right imager stands a baseline to the right, and its image ends too.
    const Eigen::Vector3d p_c = rendering_.depth_m(seen) * camera_.Ray(u, v);
    const Eigen::Vector2d right =
        camera_.Project(p_c - Eigen::Vector3d(model_.baseline_m, 0, 0));
    return right.x() >= -0.5 && right.x() <= camera_.width - 0.5;
  }

  /// The matching window sees more than its own surface, and neither that nor all else prevails.
  bool IsMixed(int u, int v) const {
    const int reach = model_.window_px / 2;
    const double own = Disparity(rendering_.depth_m(seen_(v, u)));
    int same = 0, others = 0;
    const cv::Rect window = Window(u, v, reach);
    for (int y = window.y; y < window.br().y; ++y) {
      for (int x = window.x; x < window.br().x; ++x) {
        const double z = rendering_.depth_m(seen_(y, x));
        const bool own_surface =
            z > 0 && (std::abs(Disparity(z) - own) <= model_.max_mixed_px ||
                      SameSurface(rendering_, seen_(v, u), seen_(y, x)));
        (own_surface ? same : others) += 1;
      }
    }
    const double most = std::max(same, others);
    return others > 0 && !(most > model_.min_share * (same + others));
  }

  double Triangulate(int u, int v, double z) const {
    double disparity = Disparity(z);
    if (model_.ripple_px > 0) {
      disparity += model_.ripple_px * std::sin(2.0 * std::numbers::pi * disparity);
    }
    if (model_.subpixel_px > 0) {
      // The noise is partly common to a matching window, partly each pixel's own.
      const double sigma = sigma_->At(z);
      const double smooth = smooth_.empty() ? 0.0 : static_cast<double>(smooth_(v, u));
      disparity +=
          sigma * (std::sqrt(model_.correlated_share) * smooth +
                   std::sqrt(1.0 - model_.correlated_share) * noise_.Normal(u, v, kWhiteDraw));
    } else if (model_.ripple_px <= 0 && model_.grid_px <= 0) {
      return z;
    }
    if (model_.grid_px > 0) {
      disparity = model_.grid_px * std::round(disparity / model_.grid_px);
    }
    return disparity > 0 ? model_.focal_baseline_px_m / disparity : 0;
  }

  const Rendering& rendering_;
  const D435Model& model_;
  const Camera& camera_;
  const PixelNoise& noise_;
  std::shared_ptr<const RoundedSigma> sigma_;
  cv::Size size_;
  cv::Mat1f smooth_;
  cv::Mat_<cv::Point> seen_;
  cv::Mat1b mixed_;  ///< where a window may see two surfaces; empty = nobody asks
};

}  // namespace

double D435Sigma(double z_m, const D435Model& model) {
  return z_m * z_m * model.subpixel_px / model.focal_baseline_px_m;
}

cv::Mat1d MeasureDepth(const Rendering& rendering, const D435Model& model, const Camera& camera,
                       const PixelNoise& noise) {
  const D435Sensor sensor(rendering, model, camera, noise);
  return MeasureEach(sensor, rendering.depth_m.size());
}

}  // namespace sim

#include "sim/sensor/depth/azure_sensor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/sensor/depth/corner_glow.h"
#include "sim/sensor/depth/depth_effects.h"

namespace sim {
namespace {

constexpr double kHexagonHalfWidth = 0.76732698797896;   ///< tan(75 deg / 2)
constexpr double kHexagonHalfHeight = 0.63707026080749;  ///< tan(65 deg / 2)
constexpr double kBestReflectivity = 0.9;                ///< that of the published curve

/// The narrow field: corners left and right, edges above and below.
bool InHexagon(const Eigen::Vector3d& ray) {
  const double x = std::abs(ray.x()), y = std::abs(ray.y());
  return y <= kHexagonHalfHeight &&
         x <= kHexagonHalfWidth * (1.0 - 0.5 * y / kHexagonHalfHeight);
}

class AzureSensor {
 public:
  AzureSensor(const Rendering& rendering, const AzureModel& model, const Camera& camera,
              const PixelNoise& noise, const PixelNoise& session)
      : rendering_(rendering), model_(model), camera_(camera), noise_(noise) {
    if (model.multipath_m > 0 || model.multipath_loss > 0) {
      glow_ = CornerGlow(rendering, camera, model.multipath_reach_m);
    }
    if (model.loss.min_return_per_m2 > 0 || model.loss.mirror_spot_rad > 0) {
      lost_ = cv::Mat1b(rendering.depth_m.size(), uchar{0});
      MarkReturnLoss(rendering, model.loss, noise, lost_);
    }
    offset_m_ = model.session_offset_m * (2.0 * session.Uniform(0, 0, kSessionDraw) - 1.0);
  }

  /// 0 when there is no measurement.
  double At(int u, int v) const {
    if (!(rendering_.depth_m(v, u) > 0)) return 0;
    if (model_.hexagon && !InHexagon(camera_.Ray(u, v))) return 0;
    // The surface that is seen, and where two share the footprint, a depth between them.
    const cv::Point seen = Seen(u, v);
    if (!lost_.empty() && lost_(seen) != 0) return 0;
    double z = model_.flying_pixels ? Mixed(seen) : rendering_.depth_m(seen);
    if (!(z >= model_.min_depth_m && z <= model_.max_depth_m)) return 0;
    const double true_z = z;
    // Light that comes by way of the other face of a corner lengthens the path, or drowns it.
    if (!glow_.empty() && glow_(seen) > 0) {
      const double glow = static_cast<double>(glow_(seen));
      if (noise_.Uniform(u, v, kLossDraw) < model_.multipath_loss * glow) return 0;
      z += model_.multipath_m * glow;
    }
    // Errors of the whole recording, of the depth, and of each pixel; then the sensor's
    // rounding.
    z += offset_m_ +
         model_.wiggle_m * std::sin(2.0 * std::numbers::pi * true_z / model_.wiggle_period_m);
    if (model_.noise_scale > 0) {
      const double cosine = static_cast<double>(rendering_.incidence_cos(seen));
      const double sigma = model_.noise_scale * AzureSigma(true_z, cosine, model_.reflectivity);
      z += SigmaBeforeRounding(sigma, model_.rounding_m, 0) * noise_.Normal(u, v, kAxialDraw);
    }
    return std::max(0.0, RoundDepth(z, model_.rounding_m));
  }

 private:
  cv::Point Seen(int u, int v) const {
    if (!(model_.lateral_px > 0)) return {u, v};
    const auto moved = [&](std::uint32_t draw, int from, int size) {
      const double step = model_.lateral_px * noise_.Normal(u, v, draw);
      return std::clamp(from + static_cast<int>(std::lround(step)), 0, size - 1);
    };
    const cv::Point to(moved(kJitterUDraw, u, rendering_.depth_m.cols),
                       moved(kJitterVDraw, v, rendering_.depth_m.rows));
    return SameSurface(rendering_, {u, v}, to) ? cv::Point(u, v) : to;
  }

  /// Returned light: as cos / z^2.
  double Light(cv::Point at) const {
    const double z = rendering_.depth_m(at);
    return static_cast<double>(rendering_.incidence_cos(at)) / (z * z);
  }

  /// Mean depth of the surfaces in the footprint, weighted by light; 0 when it is refused: by the
  /// light of its own surface against that of all others together.
  double Mixed(cv::Point at) const {
    static constexpr double kFootprint[2] = {0.5, 0.25};
    const double own_z = rendering_.depth_m(at);
    if (!(own_z > 0)) return 0;
    double own = 0, others = 0, moment = 0, nearest = own_z, farthest = own_z;
    for (int dv = -1; dv <= 1; ++dv) {
      for (int du = -1; du <= 1; ++du) {
        const cv::Point to(std::clamp(at.x + du, 0, rendering_.depth_m.cols - 1),
                           std::clamp(at.y + dv, 0, rendering_.depth_m.rows - 1));
        const double share = kFootprint[std::abs(du)] * kFootprint[std::abs(dv)];
        if (SameSurface(rendering_, at, to)) {
          own += share;
        } else if (const double z = rendering_.depth_m(to); z > 0) {
          others += share * Light(to);
          moment += share * Light(to) * z;
          nearest = std::min(nearest, z);
          farthest = std::max(farthest, z);
        }
      }
    }
    if (!(others > 0)) return own_z;
    own *= Light(at);
    const double mixed = others / (own + others);
    const bool both = mixed > model_.min_mixed_share && mixed < 1.0 - model_.min_mixed_share;
    if (farthest - nearest > model_.max_mixed_m && both) return 0;
    return (own * own_z + moment) / (own + others);
  }

  const Rendering& rendering_;
  const AzureModel& model_;
  const Camera& camera_;
  const PixelNoise& noise_;
  cv::Mat1f glow_;
  cv::Mat1b lost_;  ///< 255 = too little or too much light; empty = nowhere
  double offset_m_ = 0;
};

}  // namespace

double AzureSigma(double z_m, double cosine, double reflectivity) {
  const double frontal_m = 0.0005 + 0.001 * std::max(z_m - 0.5, 0.0);
  const double light = std::max(1e-6, reflectivity * cosine);
  return std::min(0.017, frontal_m * std::sqrt(kBestReflectivity / light));
}

cv::Mat1d MeasureDepth(const Rendering& rendering, const AzureModel& model,
                       const Camera& camera, const PixelNoise& noise,
                       const PixelNoise& session) {
  const AzureSensor sensor(rendering, model, camera, noise, session);
  return MeasureEach(sensor, rendering.depth_m.size());
}

}  // namespace sim

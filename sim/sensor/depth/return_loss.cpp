#include "sim/sensor/depth/return_loss.h"

#include <algorithm>
#include <cmath>

#include "sim/scene/surface_light.h"
#include "sim/sensor/depth/blob_noise.h"
#include "sim/sensor/depth/depth_effects.h"

namespace sim {
namespace {

/// Beckmann's roughness. With 0.45 physics' constants give a black display the return that our
/// threshold needs at 37.5 deg; our choice among pairs of the two that do.
constexpr double kRoughness2 = 0.45 * 0.45;
constexpr double kFarthest_sd = 9;  ///< no knot's normal scaled as below is further out

/// exp(x), |x| < 100, to 1e-9: no libm, so the same bits with every C library.
double Exp(double x) {
  const double t = x / 1024.0;
  double e = 1.0 + t * (1.0 + t / 2.0 * (1.0 + t / 3.0 * (1.0 + t / 4.0)));
  for (int i = 0; i < 10; ++i) e *= e;
  return e;
}

/// B of ReturnLoss: camera and projector are taken to be in one place.
double RoughGlass(double cosine) {
  const double c2 = std::max(cosine * cosine, 1e-4);  // below, the lobe is 0 anyway
  const double tan2 = (1.0 - c2) / c2;
  if (tan2 > 20 * kRoughness2) return 0;  // e^-20
  return GlassReflection(1.0) * Exp(-tan2 / kRoughness2) /
         (4.0 * kRoughness2 * c2 * c2 * cosine);
}

class ReturnRows {
 public:
  ReturnRows(const Rendering& rendering, const ReturnLoss& model, const PixelNoise& noise)
      : rendering_(rendering),
        model_(model),
        dim_(rendering.depth_m.size(), noise, kReturnDraw),
        spot_(rendering.depth_m.size(), noise, kMirrorDraw),
        always_(model.min_return_per_m2 * Exp(kFarthest_sd * model.spread_ln)) {}

  void Mark(int v, uchar* lost) const {
    const double* z = rendering_.depth_m[v];
    const float* infrared = rendering_.infrared[v];
    const float* gloss = rendering_.gloss[v];
    const float* cosine = rendering_.incidence_cos[v];
    for (int u = 0; u < rendering_.depth_m.cols; ++u) {
      const double a = static_cast<double>(infrared[u]), c = static_cast<double>(cosine[u]);
      // Most surfaces are bright enough by far, and matt.
      if (gloss[u] == 0 && a * c > always_ * z[u] * z[u]) continue;
      if (z[u] > 0 && (Dim(u, v, a, c) || Saturates(u, v))) lost[u] = 255;
    }
  }

 private:
  bool Dim(int u, int v, double infrared, double cosine) const {
    if (!(model_.min_return_per_m2 > 0)) return false;
    const double z = rendering_.depth_m(v, u);
    const double found =
        ReturnAtOneMetre(infrared, static_cast<double>(rendering_.gloss(v, u)), cosine);
    if (found > always_ * z * z) return false;
    return found < z * z * model_.min_return_per_m2 * Exp(model_.spread_ln * dim_.At(u, v));
  }

  /// The face throws the projector's light at the camera. Ragged by a quarter of the spot's radius.
  bool Saturates(int u, int v) const {
    constexpr double kRagged = 0.25;  // our choice, as blobs look at the ends of other losses
    const double gloss = static_cast<double>(rendering_.gloss(v, u));
    if (!(model_.mirror_spot_rad > 0 && gloss > 0)) return false;
    const double angle2 = 2.0 * (1.0 - static_cast<double>(rendering_.mirror_cos(v, u)));
    const double spot = model_.mirror_spot_rad * gloss * (1.0 + kRagged * spot_.At(u, v));
    return spot > 0 && angle2 < spot * spot;
  }

  const Rendering& rendering_;
  const ReturnLoss& model_;
  BlobNoise dim_, spot_;
  double always_;  ///< what is brighter at 1 m is never lost there
};

}  // namespace

double ReturnAtOneMetre(double infrared, double gloss, double cosine) {
  if (gloss == 0) return infrared * cosine;
  const double through = 1.0 - gloss * GlassReflection(cosine);
  return infrared * cosine * through * through + gloss * RoughGlass(cosine);
}

void MarkReturnLoss(const Rendering& rendering, const ReturnLoss& model,
                    const PixelNoise& noise, cv::Mat1b& lost) {
  const bool asked = model.min_return_per_m2 > 0 || model.mirror_spot_rad > 0;
  if (!asked || rendering.infrared.empty()) return;
  const ReturnRows rows(rendering, model, noise);
  for (int v = 0; v < lost.rows; ++v) rows.Mark(v, lost[v]);
}

}  // namespace sim

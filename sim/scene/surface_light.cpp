#include "sim/scene/surface_light.h"

#include <algorithm>

namespace sim {
namespace {

/// measured: a black display in fr1/xyz, together with kRecordedReturn of return_loss.h
constexpr double kScreenInfrared = 0.003;
constexpr double kScreenGloss = 1.0;  ///< glass or plastic all over
constexpr double kCoverGloss = 0.3;   ///< our choice: some covers are laminated, most are paper
constexpr double kGlassAtNormal = 0.04;  ///< ((n - 1) / (n + 1))^2, n = 1.5

}  // namespace

double InfraredOf(const Material& material) {
  if (material.infrared) return *material.infrared;
  if (material.print == Print::kScreen) return kScreenInfrared;
  const auto& [r, g, b] = material.colour;
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;  // luminance, ITU-R BT.709
}

double GlossOf(const Material& material) {
  if (material.gloss) return *material.gloss;
  if (material.print == Print::kScreen) return kScreenGloss;
  return material.print == Print::kCover ? kCoverGloss : 0.0;
}

double GlassReflection(double cosine) {
  const double x = 1.0 - std::clamp(cosine, 0.0, 1.0), x2 = x * x;
  return kGlassAtNormal + (1.0 - kGlassAtNormal) * x2 * x2 * x;
}

}  // namespace sim

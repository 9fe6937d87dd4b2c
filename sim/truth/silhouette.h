#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "sim/base/pose.h"
#include "sim/camera/camera.h"
#include "sim/shapes/mesh.h"

namespace sim {

/// Axis-aligned rectangle in pixels, pixel centres at integers: x0 <= x1, y0 <= y1.
struct PixelBox {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool operator==(const PixelBox&) const = default;
};

/// What is nearer than this along the optical axis is cut off before projecting, metres.
inline constexpr double kSilhouetteNear_m = 0.01;

/// Box of the projection of the triangles' part with z > kSilhouetteNear_m. Not cut at the
/// image border: it may reach far outside. Empty when all of it lies nearer or behind.
std::optional<PixelBox> ProjectedBox(std::span<const Triangle> triangles, const Pose& T_wc,
                                     const Camera& camera);

}  // namespace sim

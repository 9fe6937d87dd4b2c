#include "slam/faces/select.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "slam/faces/box_link.h"

namespace slam {
namespace {

// Depth that is cleaner than half the modelled sigma is rough by rounding and small curves.
constexpr double kMinUsualRoughness = 0.25;

double MedianOverPixels(std::vector<std::pair<double, long>> values) {
  std::sort(values.begin(), values.end());
  long pixels = 0, below = 0;
  for (const auto& [value, count] : values) pixels += count;
  for (const auto& [value, count] : values) {
    below += count;
    if (2 * below >= pixels) return value;
  }
  return 0.0;
}

/// Coarsely rougher than the frame's surfaces, and by more than its own noise explains.
bool IsStairs(const Roughness& roughness, const UsualRoughness& usual,
              const SelectConfig& config) {
  const double expected =
      std::max({usual.coarse, kMinUsualRoughness, usual.growth * roughness.fine});
  return !(roughness.coarse < config.max_roughness * expected);
}

/// Rounder than a flat thing can seem by noise and by what the sensor bends: a piece of a cup or a
/// bottle, or of two faces across an edge.
bool IsRound(const FramePlane& plane, const SelectConfig& config) {
  const SurfaceCurvature seen{plane.curvature.per_m, std::hypot(plane.curvature.sigma_per_m,
                                                                plane.bend_curvature_per_m)};
  return seen.Surely_per_m() > 0 && seen.per_m > config.max_curvature_per_m;
}

std::optional<BadReason> StructureFault(const FramePlane& plane, const Camera& camera,
                                        const SelectConfig& config) {
  if (config.structure == StructureRule::kIgnored) return std::nullopt;
  const Box image = camera.ImageBox();
  const Eigen::Vector2d rim = Eigen::Vector2d::Constant(config.border_px);
  const Box inner{image.min + rim, image.max - rim};
  const auto at_border = std::count_if(
      plane.edge_points.begin(), plane.edge_points.end(), [&](const EdgePoint& e) {
        return e.kind == EdgeKind::kBorder || !inner.Contains(e.u_px);
      });
  const auto edge_points = static_cast<double>(plane.edge_points.size());
  if (edge_points > 0 &&
      !(static_cast<double>(at_border) < config.max_border_share * edge_points))
    return BadReason::kBorder;
  if (plane.vertices_c.size() != 4) return BadReason::kStructure;
  return std::nullopt;
}

}  // namespace

UsualRoughness FindUsualRoughness(const std::vector<FramePlane>& planes) {
  std::vector<std::pair<double, long>> coarse, growth;  // and the pixels that have it
  for (const FramePlane& plane : planes) {
    const Roughness& r = plane.roughness;
    if (!(r.coarse > 0)) continue;
    coarse.emplace_back(r.coarse, plane.pixel_count);
    if (r.fine > 0) growth.emplace_back(r.coarse / r.fine, plane.pixel_count);
  }
  return {MedianOverPixels(std::move(coarse)), MedianOverPixels(std::move(growth))};
}

std::optional<BadReason> FindFault(const FramePlane& plane,
                                   const std::vector<Detection>& detections, double min_score,
                                   const UsualRoughness& usual, const Camera& camera,
                                   const SelectConfig& config) {
  // Too far away, or no plane.
  if (!(plane.centroid_c.norm() < config.max_distance_m)) return BadReason::kFar;
  if (plane.inlier_ratio == 0) return BadReason::kInliers;
  if (IsStairs(plane.roughness, usual, config)) return BadReason::kInliers;
  if (IsRound(plane, config)) return BadReason::kInliers;

  // The face of a regular object must show its structure.
  double regular_fit = 0.0;
  if (plane.detection) {
    const Detection& linked = detections.at(static_cast<std::size_t>(*plane.detection));
    if (linked.kind == ClassKind::kRegular) {
      regular_fit = Iou(plane.box_px, linked.box_px);
      if (const auto fault = StructureFault(plane, camera, config)) return fault;
    }
  }

  // Nothing is taken from an unstructured object, unless a regular one's box fits better.
  for (const Detection& d : detections) {
    if (d.kind != ClassKind::kUnstructured || !(d.score > min_score)) continue;
    if (Iou(plane.box_px, d.box_px) < regular_fit) continue;
    if (!(EdgeShare(plane, d.box_px, 0.0) < config.max_unstructured_share)) {
      return BadReason::kUnstructured;
    }
  }
  return std::nullopt;
}

}  // namespace slam

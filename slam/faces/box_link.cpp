#include "slam/faces/box_link.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace slam {
namespace {

/// Sorts candidates: better ones are smaller.
std::array<double, 6> Rank(double quality, const Detection& d) {
  return {-quality,         d.box_px.area(),  d.box_px.min.y(),
          d.box_px.min.x(), d.box_px.max.y(), d.box_px.max.x()};
}

}  // namespace

double EdgeShare(const FramePlane& plane, const Box& box_px, double margin_px) {
  if (plane.edge_points.empty()) return 0.0;
  const auto inside =
      std::count_if(plane.edge_points.begin(), plane.edge_points.end(),
                    [&](const EdgePoint& e) { return box_px.Contains(e.u_px, margin_px); });
  return static_cast<double>(inside) / static_cast<double>(plane.edge_points.size());
}

void LinkBoxes(std::vector<FramePlane>& planes, const std::vector<Detection>& detections,
               const BoxLinkConfig& config) {
  for (FramePlane& plane : planes) {
    plane.detection.reset();
    plane.class_name.clear();
    std::array<double, 6> best{};
    for (std::size_t k = 0; k < detections.size(); ++k) {
      const Detection& d = detections[k];
      if (!(d.score > config.min_score)) continue;
      const double iou = Iou(plane.box_px, d.box_px);
      if (!(iou > config.min_iou)) continue;
      const double share = EdgeShare(plane, d.box_px, config.margin_px);
      if (!(share > config.min_edge_share)) continue;
      const std::array<double, 6> rank = Rank(iou * share, d);
      const bool same_box = plane.detection && rank == best;
      const bool better =
          !plane.detection || rank < best || (same_box && d.class_name < plane.class_name);
      if (!better) continue;
      best = rank;
      plane.detection = static_cast<int>(k);
      plane.class_name = d.class_name;
    }
  }
}

}  // namespace slam

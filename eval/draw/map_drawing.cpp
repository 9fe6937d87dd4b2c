#include "eval/draw/map_drawing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "eval/draw/run_gauge.h"
#include "eval/planes/polygon.h"

namespace eval {
namespace {

constexpr double kStandsOn_m = 0.4;
constexpr double kSameHeight_m = 0.05;
constexpr double kAround_m = 0.1;
constexpr double kRarelySeen = 0.03;  // of the most seen plane's observations

std::vector<Eigen::Vector3d> Moved(const Pose& T_vw,
                                   const std::vector<Eigen::Vector3d>& points_w) {
  std::vector<Eigen::Vector3d> points_v;
  points_v.reserve(points_w.size());
  for (const Eigen::Vector3d& p : points_w) points_v.push_back(T_vw * p);
  return points_v;
}

Eigen::Vector3d Mean(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) sum += p;
  return points.empty() ? sum : Eigen::Vector3d(sum / static_cast<double>(points.size()));
}

struct Bounds {
  double x0 = std::numeric_limits<double>::infinity(), y0 = x0, x1 = -x0, y1 = -x0;
  void Add(const std::vector<Eigen::Vector3d>& points) {
    for (const Eigen::Vector3d& p : points) {
      x0 = std::min(x0, p.x()), x1 = std::max(x1, p.x());
      y0 = std::min(y0, p.y()), y1 = std::max(y1, p.y());
    }
  }
  void Cut(const Bounds& other, double margin) {
    x0 = std::max(x0, other.x0 - margin), x1 = std::min(x1, other.x1 + margin);
    y0 = std::max(y0, other.y0 - margin), y1 = std::min(y1, other.y1 + margin);
  }
};

// The base plane and what stands on and around it: floor and walls go on beyond the page.
Bounds BoundsRoundBase(const MapScene& scene, const MapScene::Estimate& base) {
  Bounds bounds;
  bounds.Add(base.hull_v);
  bounds.Add(base.vertices_v);
  const double x0 = bounds.x0 - kAround_m, x1 = bounds.x1 + kAround_m;
  const double y0 = bounds.y0 - kAround_m, y1 = bounds.y1 + kAround_m;
  bounds = {x0, y0, x1, y1};
  bounds.Add(scene.run_path_v);
  bounds.Add(scene.truth_path_v);
  return bounds;
}

Bounds BoundsOf(const MapScene& scene) {
  const auto base = BasePlane(scene);
  if (base && !scene.planes[*base].hull_v.empty()) {
    return BoundsRoundBase(scene, scene.planes[*base]);
  }
  Bounds bounds;
  int most = 0;
  for (const auto& plane : scene.planes) most = std::max(most, plane.observations);
  for (const auto& plane : scene.planes) {
    if (plane.observations < kRarelySeen * most) continue;
    bounds.Add(plane.hull_v);
    bounds.Add(plane.vertices_v);
  }
  if (!scene.truth.empty()) {
    Bounds truth;
    for (const auto& plane : scene.truth) truth.Add(plane.vertices_v);
    if (bounds.x0 < bounds.x1) bounds.Cut(truth, 0.3);
  }
  bounds.Add(scene.run_path_v);
  bounds.Add(scene.truth_path_v);
  return bounds;
}

}  // namespace

bool Contains(const std::vector<Eigen::Vector3d>& convex, const Eigen::Vector3d& p) {
  bool left = false, right = false;
  for (std::size_t i = 0; i < convex.size(); ++i) {
    const Eigen::Vector3d &a = convex[i], &b = convex[(i + 1) % convex.size()];
    const double side = (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
    left = left || side > 0;
    right = right || side < 0;
  }
  return convex.size() >= 3 && !(left && right);
}

Eigen::Vector3d OpenPoint(const MapScene& scene, const MapScene::Estimate& plane,
                          const MapScale& scale) {
  const auto covered = [&](const Eigen::Vector3d& p_v) {
    return std::any_of(scene.planes.begin(), scene.planes.end(), [&](const auto& other) {
      const bool level = other.pi_v.n.z() > kLevel_cos;
      return level && HeightAt(other.pi_v, p_v) > HeightAt(plane.pi_v, p_v) &&
             Contains(other.hull_v, p_v);
    });
  };
  if (!(plane.pi_v.n.z() > kLevel_cos) || !covered(plane.centre_v)) return plane.centre_v;
  for (const double share : {0.2, 0.4, 0.6, 0.8}) {
    for (const Eigen::Vector3d& corner : plane.hull_v) {
      Eigen::Vector3d p_v = (1 - share) * plane.centre_v + share * corner;
      if (scale.page.contains(scale.At(p_v)) && !covered(p_v)) return p_v;
    }
  }
  return plane.centre_v;
}

std::vector<cv::Point2d> MapScale::At(const std::vector<Eigen::Vector3d>& points_v) const {
  std::vector<cv::Point2d> pixels;
  pixels.reserve(points_v.size());
  for (const Eigen::Vector3d& p : points_v) pixels.push_back(At(p));
  return pixels;
}

MapScene CollectMap(const Run& run, const Sequence& sequence) {
  const MapGauge gauge = ChooseMapGauge(run, sequence);
  MapScene scene;
  scene.on_truth = gauge.on_truth;
  scene.levelled = gauge.levelled;
  for (const RunMapPlane& plane : run.map) {
    if (plane.merged_into) continue;
    MapScene::Estimate drawn{plane.id,
                             plane.plane_class.value_or(""),
                             Transform(gauge.T_vw, plane.pi_w),
                             Moved(gauge.T_vw, plane.hull_w),
                             Moved(gauge.T_vw, plane.vertices_w),
                             Eigen::Vector3d::Zero(),
                             plane.observations,
                             plane.area_m2};
    drawn.centre_v = Mean(drawn.vertices_v.size() >= 4 ? drawn.vertices_v : drawn.hull_v);
    scene.planes.push_back(std::move(drawn));
  }
  // Planes of one height, up to round-off, keep the order of their ids in any world frame.
  const auto height = [](const MapScene::Estimate& plane) {
    return std::lround(plane.centre_v.z() * 1e4);
  };
  std::stable_sort(scene.planes.begin(), scene.planes.end(),
                   [&](const auto& a, const auto& b) { return height(a) < height(b); });
  for (const StampedPose& pose : run.trajectory) {
    scene.run_path_v.push_back((gauge.T_vw * pose.T_wc).t);
  }
  if (!gauge.on_truth) return scene;
  // A recording's truth may start long before its first frame.
  const double first = sequence.frames.empty() ? 0 : sequence.frames.front().stamp_s - 0.05;
  const double last = sequence.frames.empty() ? 0 : sequence.frames.back().stamp_s + 0.05;
  for (const StampedPose& pose : *sequence.groundtruth) {
    if (pose.stamp_s >= first && pose.stamp_s <= last) {
      scene.truth_path_v.push_back(gauge.T_vg * pose.T_wc.t);
    }
  }
  if (!sequence.scene) return scene;
  for (const TruthPlane& plane : sequence.scene->planes) {
    if (!plane.scored) continue;
    const TruthObject* object = sequence.scene->FindObject(plane.object);
    scene.truth.push_back({object == nullptr ? "" : object->object_class,
                           Transform(gauge.T_vg, plane.pi_g),
                           Moved(gauge.T_vg, plane.vertices_g)});
  }
  return scene;
}

MapScale FitMap(const MapScene& scene, cv::Rect2d page) {
  Bounds bounds = BoundsOf(scene);
  if (!(bounds.x0 <= bounds.x1 && bounds.y0 <= bounds.y1)) bounds = {-0.5, -0.5, 0.5, 0.5};
  const double margin = 0.03 * std::max({bounds.x1 - bounds.x0, bounds.y1 - bounds.y0, 0.1});
  const double width = bounds.x1 - bounds.x0 + 2 * margin;
  const double height = bounds.y1 - bounds.y0 + 2 * margin;
  MapScale scale;
  scale.pixels_per_m = std::min(page.width / width, page.height / height);
  // Whole pixels; round-off must not make one more of a height that fits exactly.
  page.height = std::min(page.height, std::ceil(height * scale.pixels_per_m));
  scale.page = page;
  const double spare = page.width / scale.pixels_per_m - width;
  scale.x0_m = bounds.x0 - margin - spare / 2;
  scale.y1_m = bounds.y1 + margin;
  return scale;
}

double HeightAt(const Plane& pi_v, const Eigen::Vector3d& p_v) {
  return -(pi_v.d + pi_v.n.x() * p_v.x() + pi_v.n.y() * p_v.y()) / pi_v.n.z();
}

std::optional<std::size_t> BasePlane(const MapScene& scene) {
  std::optional<std::size_t> best;
  std::pair<int, double> best_score;
  for (std::size_t i = 0; i < scene.planes.size(); ++i) {
    const auto& base = scene.planes[i];
    if (!(base.pi_v.n.z() > kLevel_cos)) continue;
    int above = 0;
    for (const auto& other : scene.planes) {
      const double step =
          HeightAt(other.pi_v, other.centre_v) - HeightAt(base.pi_v, other.centre_v);
      above += other.pi_v.n.z() > kLevel_cos && step > 0 && step < kStandsOn_m &&
               other.area_m2 < base.area_m2 && Contains(base.hull_v, other.centre_v);
    }
    const std::pair<int, double> score(above, base.observations * base.area_m2);
    if (best && !(score > best_score)) continue;
    best = i;
    best_score = score;
  }
  return best;
}

const MapScene::Truth* TrueLevelPlane(const MapScene& scene, const MapScene::Estimate& plane) {
  const MapScene::Truth* nearest = nullptr;
  double nearest_m = kSameHeight_m;
  for (const MapScene::Truth& truth : scene.truth) {
    if (!(truth.pi_v.n.z() > kLevel_cos) ||
        !GoesRoundFromAbove(truth.vertices_v, plane.centre_v))
      continue;
    const double apart =
        std::abs(HeightAt(truth.pi_v, plane.centre_v) - HeightAt(plane.pi_v, plane.centre_v));
    if (!(apart < nearest_m)) continue;
    nearest = &truth;
    nearest_m = apart;
  }
  return nearest;
}

}  // namespace eval

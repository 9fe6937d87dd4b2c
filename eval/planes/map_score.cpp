#include "eval/planes/map_score.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "eval/planes/corners.h"
#include "eval/planes/polygon.h"

namespace eval {
namespace {

using Counts = std::map<int, std::map<int, int>>;  // [final map plane][truth or 0]

const RunMapPlane* FindMapPlane(const std::vector<RunMapPlane>& map, int id) {
  const auto found = std::lower_bound(map.begin(), map.end(), id,
                                      [](const RunMapPlane& p, int i) { return p.id < i; });
  return found != map.end() && found->id == id ? &*found : nullptr;
}

/// The plane of the final map that `id` became; a broken chain ends where it breaks.
int FinalId(const std::vector<RunMapPlane>& map, int id) {
  for (std::size_t step = 0; step < map.size(); ++step) {
    const RunMapPlane* plane = FindMapPlane(map, id);
    if (plane == nullptr || !plane->merged_into) return id;
    id = *plane->merged_into;
  }
  return id;
}

/// The truth with most records; ties go to the lower id, before 0.
int Majority(const std::map<int, int>& row) {
  int best = 0, most = 0;
  for (const auto& [truth, n] : row) {
    if (n > most || (n == most && best == 0)) {
      best = truth;
      most = n;
    }
  }
  return best;
}

int CountMerged(const Counts& counts) {
  std::vector<AssociationRecord> records;
  for (const auto& [plane, row] : counts) {
    for (const auto& [truth, n] : row)
      records.insert(records.end(), std::size_t(n), {0, truth, plane});
  }
  return ScoreAssociation(records).merged_map_planes;
}

std::vector<Eigen::Vector3d> InTruthWorld(const Alignment& gauge,
                                          const std::vector<Eigen::Vector3d>& points_w) {
  std::vector<Eigen::Vector3d> points_g;
  points_g.reserve(points_w.size());
  for (const Eigen::Vector3d& p : points_w) points_g.push_back(gauge.T_gw * (gauge.scale * p));
  return points_g;
}

struct Outline {
  Polygon2 map, truth;
};

Outline OutlinesOf(const RunMapPlane& plane, const TruthPlane& truth, const Alignment& gauge) {
  const PlaneChart chart = ChartOf(truth.pi_g, truth.vertices_g.front());
  const auto& outline_w = plane.hull_w.size() >= 3 ? plane.hull_w : plane.vertices_w;
  return {ConvexHull(Project(chart, InTruthWorld(gauge, outline_w))),
          ConvexHull(Project(chart, truth.vertices_g))};
}

double RmsDistance(const Plane& pi_g, const std::vector<Eigen::Vector3d>& points_g) {
  double sum = 0.0;
  for (const Eigen::Vector3d& p : points_g) sum += std::pow(SignedDistance(pi_g, p), 2);
  return std::sqrt(sum / static_cast<double>(points_g.size()));
}

struct Errors {
  std::vector<double> normal_deg, offset_mm, vertex_mm, iou;

  void Add(const RunMapPlane& plane, const TruthPlane& truth, const Alignment& gauge) {
    const Plane pi_g = Transform(gauge.T_gw, {plane.pi_w.n, gauge.scale * plane.pi_w.d});
    normal_deg.push_back(Angle(pi_g.n, truth.pi_g.n) * 180.0 / std::numbers::pi);
    offset_mm.push_back(RmsDistance(pi_g, truth.vertices_g) * 1e3);
    const std::vector<Eigen::Vector3d> corners_g = InTruthWorld(gauge, plane.vertices_w);
    const std::vector<int> match =
        MatchCorners(corners_g, truth.vertices_g, kMaxMapCornerError_m);
    for (std::size_t i = 0; i < match.size(); ++i) {
      if (match[i] < 0) continue;
      vertex_mm.push_back((corners_g[i] - truth.vertices_g[std::size_t(match[i])]).norm() *
                          1e3);
    }
    const Outline outline = OutlinesOf(plane, truth, gauge);
    if (outline.map.size() < 3) return;
    const double both = IntersectionArea(outline.map, outline.truth);
    iou.push_back(both / (Area(outline.map) + Area(outline.truth) - both));
  }
};

/// Covered share of the seen truth; a plane with duplicates counts by its best hull.
std::optional<double> AreaExplained(
    const std::map<int, std::vector<const RunMapPlane*>>& planes_of, const SceneTruth& scene,
    const Alignment& gauge, const std::set<int>& seen) {
  double whole = 0.0, covered = 0.0;
  for (const int id : seen) {
    const TruthPlane* truth = scene.FindPlane(id);
    const PlaneChart chart = ChartOf(truth->pi_g, truth->vertices_g.front());
    whole += Area(ConvexHull(Project(chart, truth->vertices_g)));
    const auto planes = planes_of.find(id);
    if (planes == planes_of.end()) continue;
    double best = 0.0;
    for (const RunMapPlane* plane : planes->second) {
      const Outline outline = OutlinesOf(*plane, *truth, gauge);
      best = std::max(best, IntersectionArea(outline.map, outline.truth));
    }
    covered += best;
  }
  if (!(whole > 0.0)) return std::nullopt;
  return covered / whole;
}

}  // namespace

MapScore ScoreMap(const std::vector<RunMapPlane>& map, const SceneTruth& scene,
                  const std::optional<Alignment>& gauge,
                  const std::vector<AssociationRecord>& records, const std::set<int>& seen) {
  Counts counts;
  for (const AssociationRecord& r : records) ++counts[FinalId(map, r.map_plane)][r.truth];
  MapScore score;
  score.true_planes_seen = static_cast<int>(seen.size());
  score.merged = CountMerged(counts);
  // Most observations first, so that the first of a truth is its match and the rest duplicates.
  std::map<int, std::vector<const RunMapPlane*>> planes_of;
  for (const RunMapPlane& plane : map) {
    if (plane.merged_into) continue;
    ++score.planes;
    const int truth = counts.count(plane.id) > 0 ? Majority(counts.at(plane.id)) : 0;
    if (truth == 0) {
      ++score.spurious;
    } else {
      planes_of[truth].push_back(&plane);
    }
  }
  Errors errors;
  for (auto& [truth, planes] : planes_of) {
    std::stable_sort(planes.begin(), planes.end(),
                     [&, id = truth](const auto* a, const auto* b) {
                       return counts.at(a->id).at(id) > counts.at(b->id).at(id);
                     });
    score.duplicates += static_cast<int>(planes.size()) - 1;
    if (seen.count(truth) == 0) continue;
    ++score.matched;
    if (gauge) errors.Add(*planes.front(), *scene.FindPlane(truth), *gauge);
  }
  score.normal_deg = SpreadOf(errors.normal_deg);
  score.offset_mm = SpreadOf(errors.offset_mm);
  score.vertex_mm = SpreadOf(errors.vertex_mm);
  if (!errors.iou.empty()) score.polygon_iou_median = Quantile(errors.iou, 0.5);
  if (gauge) score.area_explained = AreaExplained(planes_of, scene, *gauge, seen);
  return score;
}

}  // namespace eval

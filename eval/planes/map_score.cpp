#include "eval/planes/map_score.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "eval/planes/corners.h"
#include "eval/planes/polygon.h"
#include "eval/planes/truth_of_planes.h"

namespace eval {
namespace {

using Counts = std::map<int, std::map<int, int>>;  // [final map plane][truth or 0]

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

std::vector<Eigen::Vector3d> PointsInTruthWorld(const Alignment& gauge,
                                                const std::vector<Eigen::Vector3d>& points_w) {
  std::vector<Eigen::Vector3d> points_g;
  points_g.reserve(points_w.size());
  for (const Eigen::Vector3d& p : points_w) points_g.push_back(gauge.T_gw * (gauge.scale * p));
  return points_g;
}

/// Its hull, or its corners where it has none.
const std::vector<Eigen::Vector3d>& OutlineOf(const RunMapPlane& plane) {
  return plane.hull_w.size() >= 3 ? plane.hull_w : plane.vertices_w;
}

/// @pre not empty.
Eigen::Vector3d MiddleOf(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

struct Outline {
  Polygon2 map, truth;
};

Outline OutlinesOf(const RunMapPlane& plane, const TruthPlane& truth, const Alignment& gauge) {
  const PlaneChart chart = ChartOf(truth.pi_g, truth.vertices_g.front());
  const auto& outline_w = OutlineOf(plane);
  return {ConvexHull(Project(chart, PointsInTruthWorld(gauge, outline_w))),
          ConvexHull(Project(chart, truth.vertices_g))};
}

/// The scored true plane that the map plane lies on: the nearest one that their outlines share, by area
/// where offsets agree; 0 if there is none.
int TruthByOutline(const RunMapPlane& plane, const SceneTruth& scene, const Alignment& gauge) {
  struct Candidate {
    int id;
    double offset_m, shared_m2;
  };
  const auto& outline_w = OutlineOf(plane);
  if (outline_w.size() < 3) return 0;
  const Eigen::Vector3d middle_g = MiddleOf(PointsInTruthWorld(gauge, outline_w));
  const Plane pi_g = InTruthWorld(gauge, plane.pi_w);
  std::vector<Candidate> candidates;
  double min_offset_m = kMaxTruthOffset_m;
  for (const TruthPlane& truth : scene.planes) {
    const double angle_deg = Angle(pi_g.n, truth.pi_g.n) * 180.0 / std::numbers::pi;
    const double offset_m = std::abs(SignedDistance(truth.pi_g, middle_g));
    if (!truth.scored || !(angle_deg <= kMaxMapNormal_deg)) continue;
    if (!(offset_m <= kMaxTruthOffset_m)) continue;
    const Outline outline = OutlinesOf(plane, truth, gauge);
    const double shared_m2 = IntersectionArea(outline.map, outline.truth);
    if (!(shared_m2 > 0.0)) continue;
    candidates.push_back({truth.id, offset_m, shared_m2});
    min_offset_m = std::min(min_offset_m, offset_m);
  }
  Candidate best{0, 0.0, 0.0};
  for (const Candidate& c : candidates) {
    if (c.offset_m <= min_offset_m + kSameOffset_m && c.shared_m2 > best.shared_m2) best = c;
  }
  return best.id;
}

/// Do more planes lie on true ones with their normals turned round? Another convention, then.
bool NormalsAreTurned(const std::vector<RunMapPlane>& map, const SceneTruth& scene,
                      const Alignment& gauge) {
  int as_told = 0, turned = 0;
  for (RunMapPlane plane : map) {
    if (plane.merged_into) continue;
    as_told += TruthByOutline(plane, scene, gauge) != 0 ? 1 : 0;
    plane.pi_w = {-plane.pi_w.n, -plane.pi_w.d};
    turned += TruthByOutline(plane, scene, gauge) != 0 ? 1 : 0;
  }
  return turned > as_told;
}

/// NEES of the plane's height at the middle of its outline and of its slopes there; nothing without a
/// regular covariance.
std::optional<double> NeesOfPlane(const RunMapPlane& plane, const TruthPlane& truth,
                                  const Alignment& gauge) {
  const auto& outline_w = OutlineOf(plane);
  if (!plane.covariance || outline_w.empty()) return std::nullopt;
  const Eigen::Vector3d middle_w = MiddleOf(outline_w);
  // The truth as the run's world has it, its normal scaled so that it is as high as the estimate's.
  const Plane pi_g = InTruthWorld(gauge, plane.pi_w);
  const Eigen::Vector3d u_w = plane.pi_w.n.unitOrthogonal(), v_w = plane.pi_w.n.cross(u_w);
  Eigen::Matrix<double, 3, 4> levers;
  levers << middle_w.transpose(), 1.0, u_w.transpose(), 0.0, v_w.transpose(), 0.0;
  const double cosine = truth.pi_g.n.dot(pi_g.n);
  const Eigen::Vector3d middle_g = gauge.T_gw * (gauge.scale * middle_w);
  const Eigen::Vector3d error(
      (SignedDistance(pi_g, middle_g) - SignedDistance(truth.pi_g, middle_g) / cosine) /
          gauge.scale,
      -truth.pi_g.n.dot(gauge.T_gw.R * u_w) / cosine,
      -truth.pi_g.n.dot(gauge.T_gw.R * v_w) / cosine);
  return NeesOf<3>(error, levers * *plane.covariance * levers.transpose());
}

struct Errors {
  std::vector<double> normal_deg, offset_mm, vertex_mm, iou, hausdorff_mm, nees;

  void Add(const RunMapPlane& plane, const TruthPlane& truth, const Alignment& gauge) {
    const Plane pi_g = InTruthWorld(gauge, plane.pi_w);
    normal_deg.push_back(Angle(pi_g.n, truth.pi_g.n) * 180.0 / std::numbers::pi);
    offset_mm.push_back(RmsDistance(pi_g, truth.vertices_g) * 1e3);
    const std::vector<Eigen::Vector3d> corners_g = PointsInTruthWorld(gauge, plane.vertices_w);
    const std::vector<int> match =
        MatchCorners(corners_g, truth.vertices_g, kMaxMapCornerError_m);
    for (std::size_t i = 0; i < match.size(); ++i) {
      if (match[i] < 0) continue;
      vertex_mm.push_back((corners_g[i] - truth.vertices_g[std::size_t(match[i])]).norm() *
                          1e3);
    }
    if (const auto squared = NeesOfPlane(plane, truth, gauge)) nees.push_back(*squared);
    const Outline outline = OutlinesOf(plane, truth, gauge);
    if (outline.map.size() < 3) return;
    const double both = IntersectionArea(outline.map, outline.truth);
    iou.push_back(both / (Area(outline.map) + Area(outline.truth) - both));
    hausdorff_mm.push_back(HausdorffDistance(outline.map, outline.truth) * 1e3);
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

const RunMapPlane* FindMapPlane(const std::vector<RunMapPlane>& map, int id) {
  const auto found = std::lower_bound(map.begin(), map.end(), id,
                                      [](const RunMapPlane& p, int i) { return p.id < i; });
  return found != map.end() && found->id == id ? &*found : nullptr;
}

int FinalMapPlane(const std::vector<RunMapPlane>& map, int id) {
  for (std::size_t step = 0; step < map.size(); ++step) {
    const RunMapPlane* plane = FindMapPlane(map, id);
    if (plane == nullptr || !plane->merged_into) return id;
    id = *plane->merged_into;
  }
  return id;
}

Plane InTruthWorld(const Alignment& gauge, const Plane& pi_w) {
  return Transform(gauge.T_gw, {pi_w.n, gauge.scale * pi_w.d});
}

double RmsDistance(const Plane& pi_g, const std::vector<Eigen::Vector3d>& points_g) {
  double sum = 0.0;
  for (const Eigen::Vector3d& p : points_g) sum += std::pow(SignedDistance(pi_g, p), 2);
  return std::sqrt(sum / static_cast<double>(points_g.size()));
}

MapScore ScoreMap(const std::vector<RunMapPlane>& map, const SceneTruth& scene,
                  const std::optional<Alignment>& gauge, const std::set<int>& seen) {
  // Without decisions place alone tells what a plane shows.
  std::vector<AssociationRecord> records;
  for (const RunMapPlane& plane : map) {
    if (plane.merged_into || !gauge) continue;
    records.push_back({0, TruthByOutline(plane, scene, *gauge), plane.id});
  }
  MapScore score = ScoreMap(map, scene, gauge, records, seen);
  score.merged.reset();
  score.comparable = score.planes == 0 || (gauge && score.has_outlines);
  return score;
}

MapScore ScoreMap(const std::vector<RunMapPlane>& map, const SceneTruth& scene,
                  const std::optional<Alignment>& gauge,
                  const std::vector<AssociationRecord>& records, const std::set<int>& seen) {
  Counts counts;
  for (const AssociationRecord& r : records) ++counts[FinalMapPlane(map, r.map_plane)][r.truth];
  MapScore score;
  score.true_planes_seen = static_cast<int>(seen.size());
  score.merged = CountMerged(counts);
  score.normals_turned = gauge && NormalsAreTurned(map, scene, *gauge);
  // Most observations first, so that the first of a truth is its match and the rest duplicates.
  std::map<int, std::vector<const RunMapPlane*>> planes_of;
  int outlines = 0;
  for (const RunMapPlane& plane : map) {
    if (plane.merged_into) continue;
    ++score.planes;
    outlines += OutlineOf(plane).size() >= 3 ? 1 : 0;
    const int truth = counts.count(plane.id) > 0 ? Majority(counts.at(plane.id)) : 0;
    if (truth == 0) {
      ++score.spurious;
    } else {
      planes_of[truth].push_back(&plane);
    }
  }
  score.has_outlines = score.planes == 0 || outlines > 0;
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
  if (!errors.nees.empty()) {
    const auto silent =
        std::count_if(errors.nees.begin(), errors.nees.end(),
                      [](double squared) { return squared > kSilentSigmas * kSilentSigmas; });
    score.claims = {errors.nees.size(), NeesOver(errors.nees, kBandOf3),
                    static_cast<std::size_t>(silent)};
  }
  if (!errors.iou.empty()) score.polygon_iou_median = Quantile(errors.iou, 0.5);
  score.polygon_hausdorff_mm = SpreadOf(errors.hausdorff_mm);
  if (gauge && score.has_outlines)
    score.area_explained = AreaExplained(planes_of, scene, *gauge, seen);
  return score;
}

}  // namespace eval

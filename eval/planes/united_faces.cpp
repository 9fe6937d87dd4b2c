#include "eval/planes/united_faces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "eval/planes/polygon.h"

namespace eval {
namespace {

bool LiesIn(const TruthPlane& face, const Plane& pi) {
  return std::all_of(
      face.vertices_g.begin(), face.vertices_g.end(),
      [&](const Eigen::Vector3d& v) { return std::abs(pi.n.dot(v) + pi.d) <= kSamePlane_m; });
}

/// Distance between the outlines, 0 where they meet.
double Gap(const TruthPlane& one, const TruthPlane& other) {
  const PlaneChart chart = ChartOf(one.pi_g, one.vertices_g.front());
  const Polygon2 a = ConvexHull(Project(chart, one.vertices_g));
  const Polygon2 b = ConvexHull(Project(chart, other.vertices_g));
  if (a.size() < 3 || b.size() < 3) return kMaxJoint_m + 1;
  if (IntersectionArea(a, b) > 0) return 0;
  double gap = Distance(a.front(), b);
  for (const Eigen::Vector2d& corner : a) gap = std::min(gap, Distance(corner, b));
  for (const Eigen::Vector2d& corner : b) gap = std::min(gap, Distance(corner, a));
  return gap;
}

bool AreOnePlane(const TruthPlane& one, const TruthPlane& other) {
  return one.pi_g.n.dot(other.pi_g.n) > 0 && LiesIn(one, other.pi_g) &&
         LiesIn(other, one.pi_g) && Gap(one, other) <= kMaxJoint_m;
}

/// Scored faces by the thing that they belong to.
std::vector<std::vector<const TruthPlane*>> FacesOfThings(const SceneTruth& scene) {
  std::map<std::pair<bool, int>, std::vector<const TruthPlane*>> things;
  for (const TruthPlane& plane : scene.planes) {
    const TruthObject* object = scene.FindObject(plane.object);
    if (object == nullptr || !plane.scored || plane.vertices_g.size() < 3) continue;
    const bool grouped = object->detection_group > 0;
    things[{grouped, grouped ? object->detection_group : object->id}].push_back(&plane);
  }
  std::vector<std::vector<const TruthPlane*>> out;
  out.reserve(things.size());
  for (auto& [thing, faces] : things) out.push_back(std::move(faces));
  return out;
}

/// Ids of faces by the id that they go by; only those that differ.
std::map<int, int> ScoredAs(const SceneTruth& scene) {
  std::map<int, int> scored_as;
  for (const auto& faces : FacesOfThings(scene)) {
    std::vector<bool> done(faces.size(), false);
    for (std::size_t first = 0; first < faces.size(); ++first) {
      if (done[first]) continue;
      std::vector<std::size_t> reached{first};
      done[first] = true;
      for (std::size_t i = 0; i < reached.size(); ++i) {
        for (std::size_t k = 0; k < faces.size(); ++k) {
          if (done[k] || !AreOnePlane(*faces[reached[i]], *faces[k])) continue;
          done[k] = true;
          reached.push_back(k);
          scored_as[faces[k]->id] = faces[first]->id;  // by rising id: the first is the least
        }
      }
    }
  }
  return scored_as;
}

/// Without the corners that lie on the line between their neighbours: ends of joints.
Polygon2 Straightened(Polygon2 hull) {
  constexpr double kStraight_m = 1e-3;
  for (std::size_t i = 0; i < hull.size() && hull.size() > 3;) {
    const Eigen::Vector2d& before = hull[(i + hull.size() - 1) % hull.size()];
    const Eigen::Vector2d along = (hull[(i + 1) % hull.size()] - before).normalized();
    const Eigen::Vector2d aside = hull[i] - before;
    const bool straight = std::abs(along.x() * aside.y() - along.y() * aside.x()) < kStraight_m;
    if (straight) hull.erase(hull.begin() + static_cast<std::ptrdiff_t>(i));
    if (!straight) ++i;
  }
  return hull;
}

/// Both faces as one, by the first's id.
void Unite(TruthPlane& plane, const TruthPlane& other) {
  const PlaneChart chart = ChartOf(plane.pi_g, plane.vertices_g.front());
  std::vector<Eigen::Vector3d> vertices_g = plane.vertices_g;
  vertices_g.insert(vertices_g.end(), other.vertices_g.begin(), other.vertices_g.end());
  plane.vertices_g.clear();
  for (const Eigen::Vector2d& corner : Straightened(ConvexHull(Project(chart, vertices_g)))) {
    plane.vertices_g.push_back(chart.origin + corner.x() * chart.axis_u +
                               corner.y() * chart.axis_v);
  }
  plane.holes_g.insert(plane.holes_g.end(), other.holes_g.begin(), other.holes_g.end());
  plane.area_m2 += other.area_m2;
}

std::vector<VisiblePlane> United(const std::vector<VisiblePlane>& seen,
                                 const std::map<int, int>& scored_as) {
  std::map<int, int> pixels;
  for (const VisiblePlane& plane : seen) {
    const auto found = scored_as.find(plane.id);
    pixels[found == scored_as.end() ? plane.id : found->second] += plane.pixels;
  }
  std::vector<VisiblePlane> out;
  out.reserve(pixels.size());
  for (const auto& [id, count] : pixels) out.push_back({id, count});
  return out;
}

}  // namespace

Sequence WithUnitedFaces(Sequence sequence) {
  if (!sequence.scene || !sequence.scored_as.empty()) return sequence;
  sequence.scored_as = ScoredAs(*sequence.scene);
  if (sequence.scored_as.empty()) return sequence;
  SceneTruth united;
  united.objects = sequence.scene->objects;
  for (const TruthPlane& face : sequence.scene->planes) {
    const auto found = sequence.scored_as.find(face.id);
    if (found == sequence.scored_as.end()) {
      united.planes.push_back(face);
      continue;
    }
    const auto into =
        std::find_if(united.planes.begin(), united.planes.end(),
                     [&](const TruthPlane& plane) { return plane.id == found->second; });
    Unite(*into, face);
  }
  sequence.scene = std::move(united);
  for (FrameTruth& frame : sequence.frame_truth) {
    frame.planes = United(frame.planes, sequence.scored_as);
  }
  return sequence;
}

}  // namespace eval

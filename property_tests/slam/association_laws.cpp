#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <vector>

#include "property_tests/generators/planes.h"
#include "slam/associate/associate_planes.h"
#include "slam/associate/plane_assignment.h"
#include "slam/mapping/plane_update.h"
#include "tests/support/map_surfaces.h"
#include "tests/support/plane_world.h"

namespace slam {
namespace {

constexpr double kMargin = 1.0;

struct Problem {
  int frames = 0, maps = 0;
  std::vector<AdmissiblePair> pairs;
  PlaneRelations relations;
};

Problem AnyProblem() {
  Problem p;
  p.frames = AnyInt(1, 7);
  p.maps = AnyInt(1, 7);
  for (int f = 0; f < p.frames; ++f) {
    for (int m = 0; m < p.maps; ++m) {
      if (AnyInt(0, 2) > 0) p.pairs.push_back({f, m, AnyReal(0, 12), false, AnyInt(0, 1) == 1});
    }
  }
  const auto n = static_cast<std::size_t>(p.frames);
  p.relations.pieces.assign(n, std::vector<Pieces>(n, Pieces::kOfTwo));
  for (std::size_t f = 0; f < n; ++f) {
    for (std::size_t g = f + 1; g < n; ++g) {
      const int any = AnyInt(0, 5);
      p.relations.pieces[f][g] = p.relations.pieces[g][f] =
          any == 0 ? Pieces::kOfOne : (any == 1 ? Pieces::kUnsure : Pieces::kOfTwo);
    }
  }
  return p;
}

std::vector<int> AnyPermutation(int n) {
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  for (int i = n - 1; i > 0; --i) {
    std::swap(order[static_cast<std::size_t>(i)],
              order[static_cast<std::size_t>(AnyInt(0, i))]);
  }
  return order;
}

RC_GTEST_PROP(PlaneAssignment, PermutingPlanesPermutesTheAnswer, ()) {
  const Problem p = AnyProblem();
  const auto to = AnyPermutation(p.frames), map_to = AnyPermutation(p.maps);
  Problem q = p;
  for (AdmissiblePair& c : q.pairs) {
    c.frame_plane = to[static_cast<std::size_t>(c.frame_plane)];
    c.map_plane = map_to[static_cast<std::size_t>(c.map_plane)];
  }
  std::reverse(q.pairs.begin(), q.pairs.end());
  for (std::size_t f = 0; f < to.size(); ++f) {
    for (std::size_t g = 0; g < to.size(); ++g) {
      q.relations.pieces[static_cast<std::size_t>(to[f])][static_cast<std::size_t>(to[g])] =
          p.relations.pieces[f][g];
    }
  }
  const auto a = AssignPlanes(p.frames, p.pairs, p.relations, kMargin);
  const auto b = AssignPlanes(q.frames, q.pairs, q.relations, kMargin);
  for (std::size_t f = 0; f < to.size(); ++f) {
    const int m = a.map_plane[f];
    RC_ASSERT(b.map_plane[static_cast<std::size_t>(to[f])] ==
              (m < 0 ? m : map_to[static_cast<std::size_t>(m)]));
  }
}

RC_GTEST_PROP(PlaneAssignment, OnlyPiecesOfOneSurfaceShareALandmark, ()) {
  const Problem p = AnyProblem();
  const auto a = AssignPlanes(p.frames, p.pairs, p.relations, kMargin);
  const auto was_seen = [&](std::size_t f) {
    return std::any_of(p.pairs.begin(), p.pairs.end(), [&](const AdmissiblePair& pair) {
      return pair.was_seen && pair.frame_plane == static_cast<int>(f) &&
             pair.map_plane == a.map_plane[f];
    });
  };
  for (std::size_t f = 0; f < a.map_plane.size(); ++f) {
    for (std::size_t g = f + 1; g < a.map_plane.size(); ++g) {
      if (a.map_plane[f] < 0 || a.map_plane[f] != a.map_plane[g]) continue;
      const Pieces pieces = p.relations.pieces[f][g];
      RC_ASSERT(pieces != Pieces::kOfTwo);
      RC_ASSERT(pieces == Pieces::kOfOne || (was_seen(f) && was_seen(g)));
    }
  }
}

RC_GTEST_PROP(PlaneAssignment, TwoLandmarksThatFitAlikeGiveNoDecision, ()) {
  Problem p;
  p.frames = 1;
  const double cost = AnyReal(0, 10);
  p.pairs = {{0, 0, cost}, {0, 1, cost + AnyReal(0, 0.99) * kMargin}};
  p.relations.pieces = {{Pieces::kOfTwo}};
  if (AnyInt(0, 1)) std::swap(p.pairs[0], p.pairs[1]);
  const auto a = AssignPlanes(1, p.pairs, p.relations, kMargin);
  RC_ASSERT(a.map_plane[0] == PlaneAssignment::kAmbiguous);
  p.relations.duplicates = {{0, 1}};
  RC_ASSERT(AssignPlanes(1, p.pairs, p.relations, kMargin).map_plane[0] >= 0);
}

/// A problem in which no landmark takes two planes of a frame.
Problem AnyProblemOfSingles() {
  Problem p = AnyProblem();
  for (auto& row : p.relations.pieces) std::fill(row.begin(), row.end(), Pieces::kOfTwo);
  return p;
}

// A loss needs two planes that compete for one landmark with others near: many problems a case.
RC_GTEST_PROP(PlaneAssignment, ALargerMarginNeverAddsAMatch, ()) {
  for (int problems = 0; problems < 20; ++problems) {
    const Problem p = AnyProblemOfSingles();
    const double small = AnyReal(0, 3), large = small + AnyReal(0, 6);
    const auto bold = AssignPlanes(p.frames, p.pairs, p.relations, small);
    const auto careful = AssignPlanes(p.frames, p.pairs, p.relations, large);
    for (std::size_t f = 0; f < bold.map_plane.size(); ++f) {
      if (careful.map_plane[f] >= 0) RC_ASSERT(bold.map_plane[f] == careful.map_plane[f]);
    }
  }
}

RC_GTEST_PROP(PlaneAssignment, WithoutPiecesEveryLandmarkHasOnePlaneAtMost, ()) {
  const Problem p = AnyProblemOfSingles();
  const auto a = AssignPlanes(p.frames, p.pairs, p.relations, AnyReal(0, 6));
  std::vector<int> taken;
  for (std::size_t f = 0; f < a.map_plane.size(); ++f) {
    const int m = a.map_plane[f];
    if (m < 0) continue;
    // A match is one of the pairs, and of a landmark that no other plane has.
    RC_ASSERT(std::any_of(p.pairs.begin(), p.pairs.end(), [&](const AdmissiblePair& pair) {
      return pair.frame_plane == static_cast<int>(f) && pair.map_plane == m;
    }));
    RC_ASSERT(std::find(taken.begin(), taken.end(), m) == taken.end());
    taken.push_back(m);
  }
}

/// Twins that fit one plane alike and fit it best, in any company: what the others are matched
/// with must not decide between them.
RC_GTEST_PROP(PlaneAssignment, TwinsThatNoOtherPlaneFitsAreInDoubtInAnyCompany, ()) {
  Problem p = AnyProblem();
  const int f = AnyInt(0, p.frames - 1), one = 100, other = 101;
  std::erase_if(p.pairs, [&](const AdmissiblePair& pair) { return pair.frame_plane == f; });
  const double cost = AnyReal(0, 10);
  p.pairs.push_back({f, one, cost});
  p.pairs.push_back({f, other, cost + AnyReal(0, 0.99) * kMargin});
  if (AnyInt(0, 1)) std::swap(p.pairs.back(), p.pairs.front());
  const auto a = AssignPlanes(p.frames, p.pairs, p.relations, kMargin);
  RC_ASSERT(a.map_plane[static_cast<std::size_t>(f)] == PlaneAssignment::kAmbiguous);
}

/// Calls visit(match) for all ways to give each plane of a frame one of its landmarks or none
/// (-1), no landmark twice. `match` is empty at first.
template <typename Visit>
void ForEachMatching(const Problem& p, std::vector<int>& match, const Visit& visit) {
  const auto f = static_cast<int>(match.size());
  if (f == p.frames) return visit(match);
  match.push_back(-1);
  ForEachMatching(p, match, visit);
  for (const AdmissiblePair& pair : p.pairs) {
    if (pair.frame_plane != f) continue;
    if (std::find(match.begin(), match.end() - 1, pair.map_plane) != match.end() - 1) continue;
    match.back() = pair.map_plane;
    ForEachMatching(p, match, visit);
  }
  match.pop_back();
}

/// Costs of the pairs, [plane of the frame][landmark]; what is no pair costs more than any.
using PairCosts = std::vector<std::vector<double>>;

/// Whether some plane and some landmark would both rather have each other.
bool IsLeftBySomePair(const Problem& p, const PairCosts& cost, const std::vector<int>& match) {
  std::vector<double> of_landmark(static_cast<std::size_t>(p.maps), 1e9);
  for (std::size_t f = 0; f < match.size(); ++f) {
    if (match[f] < 0) continue;
    const auto m = static_cast<std::size_t>(match[f]);
    of_landmark[m] = cost[f][m];
  }
  return std::any_of(p.pairs.begin(), p.pairs.end(), [&](const AdmissiblePair& pair) {
    const auto f = static_cast<std::size_t>(pair.frame_plane);
    const double now = match[f] < 0 ? 1e9 : cost[f][static_cast<std::size_t>(match[f])];
    return pair.cost < now && pair.cost < of_landmark[static_cast<std::size_t>(pair.map_plane)];
  });
}

// Without a margin and without pieces nothing is in doubt, and best first is the one matching of
// all that no plane and landmark would leave for each other (costs differ, so there is but one).
RC_GTEST_PROP(PlaneAssignment, WithoutAMarginIsTheOnlyMatchingThatNoPairWouldLeave, ()) {
  const Problem p = AnyProblemOfSingles();
  PairCosts cost(static_cast<std::size_t>(p.frames),
                 std::vector<double>(static_cast<std::size_t>(p.maps), 1e9));
  for (const AdmissiblePair& pair : p.pairs)
    cost[static_cast<std::size_t>(pair.frame_plane)][static_cast<std::size_t>(pair.map_plane)] =
        pair.cost;
  std::vector<std::vector<int>> stable;
  std::vector<int> match;
  ForEachMatching(p, match, [&](const std::vector<int>& all) {
    if (!IsLeftBySomePair(p, cost, all)) stable.push_back(all);
  });
  RC_ASSERT(stable.size() == 1u);
  RC_ASSERT(AssignPlanes(p.frames, p.pairs, p.relations, 0.0).map_plane == stable.front());
}

RC_GTEST_PROP(PlaneAssignment, WhereNothingCompetesEveryPlaneGetsItsBest, ()) {
  Problem p;
  p.frames = AnyInt(1, 7);
  const auto n = static_cast<std::size_t>(p.frames);
  p.relations.pieces.assign(n, std::vector<Pieces>(n, Pieces::kOfTwo));
  const auto order = AnyPermutation(p.frames);
  for (int f = 0; f < p.frames; ++f) {
    p.pairs.push_back({f, order[static_cast<std::size_t>(f)], AnyReal(0, 5)});
    p.pairs.push_back({f, 50 + f, AnyReal(5 + kMargin, 12)});
  }
  const auto a = AssignPlanes(p.frames, p.pairs, p.relations, kMargin);
  RC_ASSERT(a.map_plane == order);
}

/// A desk with a few boxes, and two views of it.
struct Views {
  Map map;
  Frame second;
  Camera camera = SmallCamera();
};

Views AnyViews() {
  PlaneWorld world;
  world.Add({0, 0, 0}, {0.7, 0, 0}, {0, 0.45, 0}, "");
  for (int i = 0; i < 3; ++i) {
    world.AddBox({-0.4 + 0.4 * i, AnyReal(-0.1, 0.15), 0},
                 {AnyReal(0.12, 0.3), AnyReal(0.12, 0.25), AnyReal(0.008, 0.05)},
                 AnyReal(-0.5, 0.5), AnyInt(0, 1) ? "book" : "");
  }
  PlaneMapConfig config;
  config.trial_pixels = 480;
  config.trial_frames = 1;  // one view is the map
  Views v;
  const auto seed = static_cast<std::uint64_t>(AnyInt(0, 1 << 30));
  const ViewFaults faults{1.0, 0.3, 1.0, 0.003, 0.002};
  const Pose one = LookAt({AnyReal(-.2, .2), -0.8, AnyReal(.5, .8)}, {0, 0, 0});
  SeenWorld first = See(world, one, v.camera, faults, Random{seed});
  UpdatePlanes(first.frame, v.map, v.camera, {}, config);
  const Pose two = LookAt({AnyReal(-.2, .2), -0.8, AnyReal(.5, .8)}, {0, 0, 0});
  v.second = See(world, two, v.camera, faults, Random{seed, 1}).frame;
  return v;
}

bool SameDecision(const PlaneMatch& a, const PlaneMatch& b) {
  return a.decision == b.decision && a.map_plane == b.map_plane;
}

RC_GTEST_PROP(PlaneAssociation, DoesNotDependOnWhereTheWorldLies, ()) {
  Views v = AnyViews();
  Frame moved = v.second;
  v.second.plane_matches = AssociatePlanes(v.second, v.map, v.camera, {}).matches;
  const Pose T_vw = AnyPose(5);
  const Pose T_wv = Inverse(T_vw);
  moved.T_cw = moved.T_cw * T_wv;
  for (MapPlane& m : v.map.planes) {
    m.pi_w = Transform(T_vw, m.pi_w);
    m.pi_w.n.normalize();
    m.centroid_w = T_vw * m.centroid_w;
    m.estimate.origin_w = T_vw * m.estimate.origin_w;
    m.estimate.normal_w = T_vw.R * m.estimate.normal_w;
    m.estimate.axes = (T_vw.R * m.estimate.axes).eval();
    for (auto* cloud : {&m.points_w, &m.vertices_w, &m.hull_w}) {
      for (Eigen::Vector3d& p_w : *cloud) p_w = T_vw * p_w;
    }
  }
  moved.plane_matches = AssociatePlanes(moved, v.map, v.camera, {}).matches;
  for (std::size_t f = 0; f < moved.planes.size(); ++f) {
    RC_ASSERT(SameDecision(v.second.plane_matches[f], moved.plane_matches[f]));
  }
}

RC_GTEST_PROP(PlaneAssociation, DoesNotDependOnTheOrderOfTheFramesPlanes, ()) {
  Views v = AnyViews();
  Frame other = v.second;
  other.plane_labels = v.second.plane_labels.clone();  // a copied image shares its pixels
  const auto to = AnyPermutation(static_cast<int>(other.planes.size()));
  for (std::size_t f = 0; f < to.size(); ++f) {
    const auto k = static_cast<std::size_t>(to[f]);
    other.planes[k] = v.second.planes[f];
    other.planes[k].index = to[f];
  }
  for (auto& label : other.plane_labels) {
    if (label > 0)
      label = static_cast<unsigned char>(to[static_cast<std::size_t>(label - 1)] + 1);
  }
  v.second.plane_matches = AssociatePlanes(v.second, v.map, v.camera, {}).matches;
  other.plane_matches = AssociatePlanes(other, v.map, v.camera, {}).matches;
  for (std::size_t f = 0; f < to.size(); ++f) {
    RC_ASSERT(SameDecision(v.second.plane_matches[f],
                           other.plane_matches[static_cast<std::size_t>(to[f])]));
  }
}

RC_GTEST_PROP(PlaneAssociation, ALandmarkFarAwayChangesNothing, ()) {
  Views v = AnyViews();
  Frame again = v.second;
  v.second.plane_matches = AssociatePlanes(v.second, v.map, v.camera, {}).matches;
  MapPlane far = *v.map.planes.begin();
  const Pose away{Eigen::Matrix3d::Identity(), {50, AnyReal(-5, 5), AnyReal(5, 9)}};
  far.pi_w = Transform(away, far.pi_w);
  far.centroid_w = away * far.centroid_w;
  far.estimate.origin_w = away * far.estimate.origin_w;
  for (auto* cloud : {&far.points_w, &far.hull_w}) {
    for (Eigen::Vector3d& p_w : *cloud) p_w = away * p_w;
  }
  AddLandmark(v.map, far);
  again.plane_matches = AssociatePlanes(again, v.map, v.camera, {}).matches;
  for (std::size_t f = 0; f < again.planes.size(); ++f) {
    RC_ASSERT(SameDecision(v.second.plane_matches[f], again.plane_matches[f]));
  }
}

/// The same map with its planes in another order, and so under other ids.
Map WithPlanesInOrder(const Map& map, const std::vector<int>& order,
                      std::map<int, int>& new_ids) {
  std::vector<MapPlane> planes(map.planes.begin(), map.planes.end());
  Map other = map;
  other.planes = {};
  for (const int k : order) {
    const MapPlane& plane = planes[static_cast<std::size_t>(k)];
    new_ids[plane.id] = other.planes.Add(plane).id;
  }
  const auto renamed = [&](const std::map<int, int>& frames) {
    std::map<int, int> out;
    for (const auto& [id, count] : frames) {
      if (new_ids.contains(id)) out[new_ids.at(id)] = count;
    }
    return out;
  };
  for (MapPlane& plane : other.planes) {
    plane.covisible = renamed(plane.covisible);
    plane.stepped = renamed(plane.stepped);
  }
  return other;
}

RC_GTEST_PROP(PlaneAssociation, DoesNotDependOnTheOrderOfTheMapsPlanes, ()) {
  const Views v = AnyViews();
  std::map<int, int> new_ids;
  const Map other =
      WithPlanesInOrder(v.map, AnyPermutation(static_cast<int>(v.map.planes.size())), new_ids);
  const auto here = AssociatePlanes(v.second, v.map, v.camera, {}).matches;
  const auto there = AssociatePlanes(v.second, other, v.camera, {}).matches;
  RC_ASSERT(here.size() == there.size());
  for (std::size_t f = 0; f < here.size(); ++f) {
    PlaneMatch expected = here[f];
    if (expected.map_plane != kNone) expected.map_plane = new_ids.at(expected.map_plane);
    RC_ASSERT(SameDecision(expected, there[f]));
  }
}

}  // namespace
}  // namespace slam

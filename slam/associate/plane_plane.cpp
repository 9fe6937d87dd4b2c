#include "slam/associate/plane_plane.h"

#include <cstring>
#include <limits>

#include "slam/associate/integrated_rule.h"

namespace slam {
namespace {

/// What common systems do: the gates, and of those that pass the nearest.
std::vector<PlaneMatch> ParameterRule(const Frame& frame, const PlaneQuestion& question,
                                      const PlaneGateConfig& gates) {
  std::vector<PlaneMatch> matches(frame.planes.size());
  for (std::size_t f = 0; f < frame.planes.size(); ++f) {
    const FramePlane& plane = frame.planes[f];
    if (!question.asked[f] || plane.bad) continue;
    std::vector<Eigen::Vector3d> edge_points_c;
    for (const EdgePoint& edge : plane.edge_points) edge_points_c.push_back(edge.p_c);
    double nearest = std::numeric_limits<double>::infinity();
    for (const MapPlane& m : question.planes) {
      if (m.merged_into) continue;
      const auto gate = TestPlaneGates(plane.pi_c, plane.centroid_c, edge_points_c, m.pi_w,
                                       frame.T_cw, gates);
      if (!gate || !(gate.value().patch_offset_m < nearest)) continue;
      nearest = gate.value().patch_offset_m;
      matches[f] = {PlaneDecision::kMatched, m.id, "parameters"};
    }
  }
  return matches;
}

}  // namespace

void AssociatePlanes(Frame& frame, const Map& map, const Camera& camera,
                     const AssociationConfig& config) {
  const PlaneQuestion question{map.planes, std::vector<bool>(frame.planes.size(), true)};
  if (config.rule == AssociationRule::kParameters) {
    frame.plane_matches = ParameterRule(frame, question, config.gates);
    return;
  }
  IntegratedRule rule(frame, map, question, camera, config);
  frame.plane_matches = rule.Run();
  rule.YieldTo(map.plane_candidates, frame.plane_matches);
}

std::vector<PlaneMatch> AssociateCandidates(const Frame& frame, const Map& map,
                                            const Camera& camera,
                                            const AssociationConfig& config) {
  PlaneQuestion question{map.plane_candidates, std::vector<bool>(frame.planes.size(), false)};
  std::vector<std::pair<int, int>> matched;
  for (std::size_t f = 0; f < frame.planes.size(); ++f) {
    const PlaneMatch& match = frame.plane_matches[f];
    question.asked[f] =
        match.decision == PlaneDecision::kNone && std::strcmp(match.by, kByAmbiguous) != 0;
    if (match.decision == PlaneDecision::kMatched && !frame.planes[f].bad) {
      matched.emplace_back(static_cast<int>(f), match.map_plane);
    }
  }
  return config.rule == AssociationRule::kParameters
             ? ParameterRule(frame, question, config.gates)
             : IntegratedRule(frame, map, question, camera, config).RunAfter(matched);
}

}  // namespace slam

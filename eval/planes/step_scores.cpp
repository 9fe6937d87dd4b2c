#include "eval/planes/step_scores.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "eval/planes/polygon.h"

namespace eval {
namespace {

constexpr double kLevelNormalZ = 0.95;  // looks up, 18 degrees
/// Lower ends of the classes: fine where a depth camera begins to see a step, coarse above.
constexpr std::array<double, 9> kStepClasses_mm = {0.5, 3, 5, 8, 12, 20, 35, 60, 100};
constexpr double kMaxStep_mm = 200.0;  // nominal end of the last class, for drawing

/// Is the face above or below the point? Outlines may turn inwards, and have holes.
bool IsOver(const TruthPlane& face, const Eigen::Vector3d& point_g) {
  return GoesRoundFromAbove(face.vertices_g, point_g) &&
         std::none_of(face.holes_g.begin(), face.holes_g.end(),
                      [&](const auto& hole) { return GoesRoundFromAbove(hole, point_g); });
}

/// Class of heights by id of a regular top.
std::map<int, std::size_t> ClassesOf(const SceneTruth& scene) {
  std::map<int, std::size_t> classes;
  for (const TruthPlane& plane : scene.planes) {
    const TruthObject* object = scene.FindObject(plane.object);
    if (!plane.scored || object == nullptr || !object->regular || !LooksUp(plane)) continue;
    const double step_mm = 1e3 * StepOf(plane, scene);
    if (!(step_mm >= kStepClasses_mm.front())) continue;
    const auto above =
        std::upper_bound(kStepClasses_mm.begin(), kStepClasses_mm.end(), step_mm);
    classes[plane.id] = static_cast<std::size_t>(above - kStepClasses_mm.begin() - 1);
  }
  return classes;
}

}  // namespace

double StepOf(const TruthPlane& top, const SceneTruth& scene) {
  Eigen::Vector3d middle_g = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& corner : top.vertices_g) middle_g += corner;
  middle_g /= static_cast<double>(top.vertices_g.size());
  double step_m = std::numeric_limits<double>::infinity();
  for (const TruthPlane& other : scene.planes) {
    if (other.id == top.id || !LooksUp(other)) continue;
    if (!IsOver(other, middle_g)) continue;
    const double under_m = SignedDistance(other.pi_g, middle_g);
    if (under_m > 0) step_m = std::min(step_m, under_m);
  }
  return std::isfinite(step_m) ? step_m : 0.0;
}

bool LooksUp(const TruthPlane& plane) { return plane.pi_g.n.z() > kLevelNormalZ; }

std::vector<StepScore> ScoreSteps(const DecisionHistory& history, const SceneTruth& scene) {
  const std::map<int, std::size_t> class_of = ClassesOf(scene);
  std::vector<StepScore> scores(kStepClasses_mm.size());
  for (std::size_t i = 0; i < scores.size(); ++i) {
    scores[i].min_mm = kStepClasses_mm[i];
    scores[i].max_mm = i + 1 < scores.size() ? kStepClasses_mm[i + 1] : kMaxStep_mm;
  }
  std::set<std::pair<int, int>> right;  // frame and truth
  const std::vector<JudgedDecision> judged = JudgeDecisions(RecordsOf(history.decisions));
  for (std::size_t i = 0; i < judged.size(); ++i) {
    const AssociationRecord& record = history.decisions[i].record;
    const auto step = class_of.find(record.truth);
    if (step == class_of.end()) continue;
    if (judged[i].outcome == DecisionOutcome::kWrong) {
      ++scores[step->second].wrong_planes;
    } else {
      ++scores[step->second].right_planes;
      right.emplace(record.frame, record.truth);
    }
  }
  for (const SeenSurface& surface : history.surfaces) {
    const auto step = class_of.find(surface.truth);
    if (step == class_of.end()) continue;
    ++scores[step->second].seen;
    scores[step->second].right += static_cast<int>(right.count({surface.frame, surface.truth}));
  }
  std::erase_if(scores, [](const StepScore& s) { return s.seen == 0; });
  return scores;
}

}  // namespace eval

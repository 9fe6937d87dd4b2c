#include "eval/planes/plane_events.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "eval/planes/map_score.h"

namespace eval {
namespace {

/// Distance from the map plane that a decision gave to the plane that it should have given.
std::optional<double> DistanceOf(const PlaneDecision& decision, const EventWorld& world) {
  const RunMapPlane* given =
      FindMapPlane(world.map, FinalMapPlane(world.map, decision.record.map_plane));
  if (given == nullptr || !world.gauge) return std::nullopt;
  const Plane pi_g = InTruthWorld(*world.gauge, given->pi_w);
  const TruthPlane* truth = world.scene.FindPlane(decision.record.truth);
  if (truth == nullptr) return std::abs(SignedDistance(pi_g, decision.centroid_g)) * 1e3;
  return RmsDistance(pi_g, truth->vertices_g) * 1e3;
}

/// Sums up decisions that put one true plane on one map plane.
class Placement {
 public:
  void Add(const PlaneDecision& decision, const std::optional<double>& distance_mm) {
    if (decisions_ == 0) first_ = &decision;
    ++decisions_;
    // Decisions come frame by frame; pieces of one surface are several.
    if (decision.record.frame != last_frame_) ++frames_;
    last_frame_ = decision.record.frame;
    pixels_ += decision.record.pixels;
    if (distance_mm)
      harm_px_mm_ = harm_px_mm_.value_or(0.0) + decision.record.pixels * *distance_mm;
    distance_mm_ = distance_mm;
    ++cues_[decision.cue];
  }

  RunEvent Event(EventKind kind) const {
    RunEvent event;
    event.kind = kind;
    event.frame = first_->record.frame;
    event.stamp_s = first_->stamp_s;
    event.frames = frames_;
    event.truth = first_->record.truth;
    event.pixels = pixels_;
    event.distance_mm = distance_mm_;
    event.harm_px_mm = harm_px_mm_;
    const auto fewer = [](const auto& a, const auto& b) { return a.second < b.second; };
    event.cue = std::max_element(cues_.begin(), cues_.end(), fewer)->first;
    return event;
  }
  int decisions() const { return decisions_; }

 private:
  const PlaneDecision* first_ = nullptr;
  int decisions_ = 0, frames_ = 0, last_frame_ = -1;
  long long pixels_ = 0;
  std::optional<double> distance_mm_, harm_px_mm_;
  std::map<std::string, int> cues_;
};

/// [one][other]: of map planes the true planes, or the other way round.
using Placements = std::map<int, std::map<int, Placement>>;

/// Entries of a row that carry weight, but the one with most decisions.
struct Mixture {
  int main = 0;
  std::vector<int> others;
};
Mixture MixtureOf(const std::map<int, Placement>& row) {
  std::map<int, int> counts;
  for (const auto& [id, placement] : row) counts[id] = placement.decisions();
  Mixture mixture;
  mixture.others = StrongEntries(counts);
  if (mixture.others.empty()) return mixture;
  const auto main = std::max_element(mixture.others.begin(), mixture.others.end(),
                                     [&](int a, int b) { return counts.at(a) < counts.at(b); });
  mixture.main = *main;
  mixture.others.erase(main);
  return mixture;
}

void AddMixtures(const Placements& by_map, const Placements& by_truth,
                 std::vector<RunEvent>& events) {
  for (const auto& [map_plane, row] : by_map) {
    const Mixture mixture = MixtureOf(row);
    for (const int truth : mixture.others) {
      RunEvent event = row.at(truth).Event(EventKind::kMerge);
      event.other_truth = mixture.main;
      event.map_plane = map_plane;
      events.push_back(event);
    }
  }
  for (const auto& [truth, row] : by_truth) {
    const Mixture mixture = MixtureOf(row);
    for (const int map_plane : mixture.others) {
      RunEvent event = row.at(map_plane).Event(EventKind::kSplit);
      event.map_plane = map_plane;
      event.right_map_plane = mixture.main;
      events.push_back(event);
    }
  }
}

/// The true plane that a map plane was most often seen as; null where it was seen as none.
const std::pair<const int, Placement>* MostShown(const std::map<int, Placement>& row) {
  const auto most = std::max_element(row.begin(), row.end(), [](const auto& a, const auto& b) {
    return a.second.decisions() < b.second.decisions();
  });
  return most == row.end() ? nullptr : &*most;
}

/// Map planes that the run itself made by splitting others: what they and the others show.
void AddSplitOffs(const DecisionHistory& history, const Placements& by_map,
                  const EventWorld& world, std::vector<RunEvent>& events) {
  for (const RunMapPlane& plane : world.map) {
    if (!plane.split_from) continue;
    std::map<int, Placement> row;  // under its own id, whatever it was merged into later
    for (const PlaneDecision& decision : history.decisions) {
      const AssociationRecord& record = decision.record;
      if (record.map_plane != plane.id || record.truth == 0) continue;
      row[record.truth].Add(decision, DistanceOf(decision, world));
    }
    const auto* shown = MostShown(row);
    if (shown == nullptr) continue;
    RunEvent event = shown->second.Event(EventKind::kSplitOff);
    event.map_plane = plane.id;
    event.right_map_plane = FinalMapPlane(world.map, *plane.split_from);
    const auto others = by_map.find(*event.right_map_plane);
    if (others != by_map.end()) event.other_truth = MostShown(others->second)->first;
    event.cue.clear();
    event.harm_px_mm.reset();  // no fault by itself
    events.push_back(event);
  }
}

RunEvent EventOf(const PlaneDecision& decision, const JudgedDecision& judged,
                 const std::map<int, FirstLandmark>& landmarks, const EventWorld& world) {
  RunEvent event;
  const bool wrong = judged.outcome == DecisionOutcome::kWrong;
  event.kind = wrong ? EventKind::kWrong : EventKind::kMissed;
  event.frame = decision.record.frame;
  event.stamp_s = decision.stamp_s;
  event.truth = decision.record.truth;
  if (wrong) event.other_truth = judged.owner;
  event.map_plane = FinalMapPlane(world.map, decision.record.map_plane);
  if (judged.truth_had_owner) {
    event.right_map_plane =
        FinalMapPlane(world.map, landmarks.at(decision.record.truth).map_plane);
  }
  event.cue = decision.cue;
  event.pixels = decision.record.pixels;
  event.distance_mm = DistanceOf(decision, world);
  if (event.distance_mm) event.harm_px_mm = decision.record.pixels * *event.distance_mm;
  return event;
}

/// @param left  without a decision: a surface or a frame plane
template <typename Left>
RunEvent EventOf(EventKind kind, const Left& left, const std::string& cue,
                 const std::map<int, FirstLandmark>& landmarks, const EventWorld& world) {
  RunEvent event;
  event.kind = kind;
  event.frame = left.frame;
  event.stamp_s = left.stamp_s;
  event.truth = left.truth;
  event.right_map_plane = FinalMapPlane(world.map, landmarks.at(left.truth).map_plane);
  event.cue = cue;
  event.pixels = left.pixels;
  return event;
}

void AddUndecided(const UndecidedSurfaces& undecided,
                  const std::vector<AmbiguousPlane>& ambiguous,
                  const std::map<int, FirstLandmark>& landmarks, const EventWorld& world,
                  std::vector<RunEvent>& events) {
  std::set<std::pair<int, int>> listed;  // frame and surface
  for (const SeenSurface& surface : undecided.undecided) {
    listed.emplace(surface.frame, surface.truth);
    events.push_back(EventOf(EventKind::kNoDecision, surface, surface.cue, landmarks, world));
  }
  for (const AmbiguousPlane& plane : ambiguous) {
    // The surface was judged by its largest plane, which is that event already.
    if (plane.is_largest && listed.count({plane.frame, plane.truth}) > 0) continue;
    events.push_back(EventOf(EventKind::kAmbiguous, plane, kByAmbiguous, landmarks, world));
  }
}

}  // namespace

const char* NameOf(EventKind kind) {
  constexpr const char* kNames[] = {"wrong", "missed", "no decision", "ambiguous",
                                    "merge", "split",  "split off",   "lost"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::vector<RunEvent> FindPlaneEvents(const DecisionHistory& history,
                                      const UndecidedSurfaces& undecided,
                                      const std::vector<AmbiguousPlane>& ambiguous,
                                      const EventWorld& world) {
  const std::vector<JudgedDecision> judged = JudgeDecisions(RecordsOf(history.decisions));
  const std::map<int, FirstLandmark> landmarks = FirstLandmarks(history.decisions);
  std::vector<RunEvent> events;
  Placements by_map, by_truth;
  for (std::size_t i = 0; i < judged.size(); ++i) {
    const PlaneDecision& decision = history.decisions[i];
    const bool at_fault = judged[i].outcome == DecisionOutcome::kWrong ||
                          judged[i].outcome == DecisionOutcome::kMissed;
    if (at_fault) events.push_back(EventOf(decision, judged[i], landmarks, world));
    const int truth = decision.record.truth;
    if (truth == 0) continue;
    const int map_plane = FinalMapPlane(world.map, decision.record.map_plane);
    const auto distance_mm = DistanceOf(decision, world);
    by_map[map_plane][truth].Add(decision, distance_mm);
    by_truth[truth][map_plane].Add(decision, distance_mm);
  }
  AddMixtures(by_map, by_truth, events);
  AddSplitOffs(history, by_map, world, events);
  AddUndecided(undecided, ambiguous, landmarks, world, events);
  SortByHarm(events);
  return events;
}

void SortByHarm(std::vector<RunEvent>& events) {
  const auto key = [](const RunEvent& e) {
    return std::tuple(-e.harm_px_mm.value_or(-1.0), -e.pixels.value_or(-1), e.frame, e.kind);
  };
  std::stable_sort(events.begin(), events.end(),
                   [&](const RunEvent& a, const RunEvent& b) { return key(a) < key(b); });
}

}  // namespace eval

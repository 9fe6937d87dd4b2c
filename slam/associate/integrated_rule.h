#pragma once

#include <utility>
#include <vector>

#include "slam/associate/association_config.h"
#include "slam/associate/plane_assignment.h"
#include "slam/associate/plane_evidence.h"
#include "slam/associate/plane_overlap.h"
#include "slam/model/frame.h"
#include "slam/model/map.h"

namespace slam {

/// What a frame is compared with, and which of its planes take part.
struct PlaneQuestion {
  const std::vector<MapPlane>& planes;  ///< landmarks or candidates; `id` is the position
  std::vector<bool> asked;              ///< by frame plane
};

/// The integrated rule over one frame; see AssociatePlanes for what it weighs. The arguments
/// must outlive it.
class IntegratedRule {
 public:
  IntegratedRule(const Frame& frame, const Map& map, const PlaneQuestion& question,
                 const Camera& camera, const AssociationConfig& config);

  /// Decides from the predicted pose: the planes that fit beyond doubt correct it first.
  std::vector<PlaneMatch> Run();

  /// Decides where the pose is known from landmarks: `matched` are (frame plane, landmark).
  std::vector<PlaneMatch> RunAfter(const std::vector<std::pair<int, int>>& matched);

  /// Takes back matches to which another answer is clearly nearer: surfaces that are on trial
  /// and no duplicates of the landmark. Such a frame plane is left without landmark.
  void YieldTo(const std::vector<MapPlane>& candidates, std::vector<PlaneMatch>& matches) const;

 private:
  enum class Verdict { kRefused, kDoubtful, kPossible };
  /// What speaks for and against one pair.
  struct Pair {
    Verdict verdict = Verdict::kRefused;
    double cost = 0.0;  ///< -2 log likelihood
    double overlap = 0.0;
    bool extension = false;
    bool ranked = false;
  };
  using Row = std::vector<Pair>;

  static bool Doubtful(const Row& row);
  static const char* RuleName(const FramePlane& f, const MapPlane& m, const Pair& pair);

  void LookAtPairs();
  Pair Weigh(const FramePlane& f, const MapPlane& m, const PlaneComparison& comparison,
             const PlaneView& view, const Box& box_px) const;
  double BoxCost(const FramePlane& f, const MapPlane& m, const Box& box_px) const;
  bool GoesOn(const FramePlane& f, const MapPlane& m) const;
  std::vector<std::pair<int, int>> Anchors() const;
  void CheckRanks();
  PlaneRelations Relations() const;
  bool SharesFramePlane(std::size_t m, std::size_t n) const;
  bool Duplicates(const MapPlane& one, const MapPlane& other) const;
  std::vector<PlaneMatch> Decide() const;

  const Frame& frame_;
  const Map& map_;  ///< for its points
  const std::vector<MapPlane>& planes_;
  const std::vector<bool>& asked_;
  const Camera& camera_;
  const AssociationConfig& config_;
  UncertainPose pose_;
  std::vector<Row> pairs_;  ///< [frame plane][map plane]
};

}  // namespace slam

#pragma once

#include <map>
#include <vector>

#include "eval/planes/partition_score.h"

namespace eval {

/// One decision: in this frame a frame plane that shows truth plane `truth` (0 = none of the
/// scored ones) was put on map plane `map_plane`.
struct AssociationRecord {
  int frame = 0;
  int truth = 0;
  int map_plane = 0;
  int pixels = 0;  ///< of the frame plane
};

/// What one decision was, given those of earlier frames; see DecisionCounts.
enum class DecisionOutcome {
  kRight,       ///< TP
  kWrong,       ///< FP
  kMissed,      ///< a new map plane for a truth that has one: FN
  kFirst,       ///< the first map plane of its truth: TN
  kSpurious,    ///< noise that makes a map plane
  kNoiseAgain,  ///< noise on the map plane that noise created: counted as spurious too
};
struct JudgedDecision {
  DecisionOutcome outcome = DecisionOutcome::kFirst;
  bool truth_had_owner = false;  ///< its truth had a map plane
  int owner = 0;                 ///< truth that made the map plane; 0: none, noise
};

/// The truth that made each map plane, 0 for noise: the one that showed most pixels of it in its
/// first frame; ties go to the lower id, before 0.
/// @param records  by rising frame; of one frame in any order
std::map<int, int> OwnersOf(const std::vector<AssociationRecord>& records);

/// @param records  by rising frame; of one frame in any order
/// @returns one for each record
std::vector<JudgedDecision> JudgeDecisions(const std::vector<AssociationRecord>& records);

/// What an entry of a row needs to carry weight.
struct EntryRule {
  double min_records = 3.0, min_share = 0.05;  ///< of the row; both
};
/// Which entries of a row carry weight.
std::vector<int> StrongEntries(const std::map<int, int>& row, const EntryRule& rule = {});

/// A share with its parts; nothing to share is 0, so that it never looks like success.
struct PrecisionRecall {
  double precision = 0.0, recall = 0.0, f1 = 0.0;
};

/// What a gate decided. owner(m) is the truth that made map plane m, see OwnersOf.
///   known plane: TP if owner = truth, else FP, and FN as well if that truth has an owner;
///   new plane:   TN if its truth had none, FN if it had (a duplicate landmark),
///                spurious if there is no truth; of several truths that make one map plane
///                in a frame all but its owner are on a known plane.
/// Decisions of a frame are simultaneous. Noise put again on the plane that noise created is
/// neither right nor wrong and counts as `spurious`.
struct DecisionCounts {
  int tp = 0, fp = 0, fn = 0, tn = 0, spurious = 0;
  PrecisionRecall scores;  ///< tp / (tp + fp), tp / (tp + fn)
};

/// Source: design of the metrics, section 3.4.
struct AssociationScore {
  std::size_t records = 0, records_with_truth = 0;
  long long pair_tp = 0, pair_predicted = 0, pair_truth = 0;
  PrecisionRecall pair;  ///< over pairs of records with truth on one map plane / of one truth
  PrecisionRecall b_cubed;   ///< the same per record
  PartitionScore partition;  ///< of records with truth: truths and map planes
  DecisionCounts decision;
  int merged_map_planes = 0;   ///< with at least two truths that carry weight
  int split_truth_planes = 0;  ///< likewise by truth
};

/// @param records  by rising frame; of one frame in any order
AssociationScore ScoreAssociation(const std::vector<AssociationRecord>& records,
                                  const EntryRule& rule = {});

/// Harmonic mean of both, 0 if both are 0.
PrecisionRecall MakeScores(double tp, double predicted, double truth);

}  // namespace eval

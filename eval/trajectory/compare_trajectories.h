#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eval/formats/pose/pose_file.h"
#include "eval/formats/sequence/sequence_agreement.h"
#include "eval/trajectory/alignment.h"
#include "eval/trajectory/pairs.h"
#include "eval/trajectory/statistics.h"

/// Two bare trajectories compared as evo does it.
namespace eval {

/// What is done to the estimate before its errors are taken.
enum class AlignMode {
  kNone,
  kOrigin,  ///< its first matched pose is laid on the truth's
  kSe3,     ///< least squares of positions, see AlignUmeyama
  kSim3     ///< the same with a scale
};

enum class DeltaUnit { kFrames, kMetres, kSeconds, kDegrees };

/// How far apart the two poses of a relative error are.
struct PoseDelta {
  double value = 1.0;  ///< > 0; frames are whole ones
  DeltaUnit unit = DeltaUnit::kFrames;
};

/// The plane onto which both trajectories are projected after the alignment.
enum class ProjectionPlane { kNone, kXy, kXz, kYz };

struct ComparisonRules {
  AlignMode align = AlignMode::kSe3;
  double max_difference_s = kMaxStampDifference_s;  ///< of stamps that are matched
  PoseDelta delta;
  PairMode pairs = PairMode::kConsecutive;
  bool pairs_from_truth = false;  ///< along the truth instead of the aligned estimate
  ProjectionPlane plane = ProjectionPlane::kNone;
};

/// Statistics of one list of errors in each of its relations; empty together.
struct ErrorStatistics {
  std::optional<Statistics> translation_m, rotation_deg;
  std::optional<Statistics> full;  ///< mixes units: a regression figure only
};

/// How an estimate differs from the truth.
struct TrajectoryComparison {
  std::size_t poses = 0, true_poses = 0, matched = 0;
  double path_m = 0.0,
         true_path_m = 0.0;  ///< along the matched poses, as they are in the files
  double max_gap_s = 0.0;    ///< between matched neighbours; between frames with KITTI files
  double scale = 1.0;        ///< by which the estimate was multiplied
  ErrorStatistics absolute, relative;
  std::size_t pairs = 0;    ///< behind the relative errors
  std::string no_absolute;  ///< why there are no errors; empty when there are some
  std::string no_relative;  ///< why there are no relative errors
};

/// @throws InputError when one file has stamps and the other none, KITTI files differ in length, or
///   fewer than two poses of the estimate have a truth
TrajectoryComparison CompareTrajectories(const PoseFile& estimate, const PoseFile& truth,
                                         const ComparisonRules& rules);

/// The pose in a plane, as evo projects it: the coordinate across is 0, and what is left of the
/// rotation is the angle about that axis, one of those of R = Rz Ry Rx.
Pose Project(const Pose& pose, ProjectionPlane plane);

}  // namespace eval

#pragma once

#include <vector>

#include "eval/trajectory/pairs.h"

namespace eval {

/// Which part of an error motion E is looked at.
enum class Relation {
  kTranslation,  ///< |t_E|, metres
  kAngleDeg,     ///< angle of R_E, degrees
  kFull,         ///< Frobenius norm of E - I: mixes units, a regression figure only
};

/// Absolute errors E_i = P_i^-1 Q_i of poses in one frame, after alignment.
/// @param estimate, truth  P and Q, matched one by one
std::vector<double> AbsoluteErrors(const std::vector<Pose>& estimate,
                                   const std::vector<Pose>& truth, Relation relation);

/// Relative errors E_ij = (Q_i^-1 Q_j)^-1 (P_i^-1 P_j); the frames need not agree.
std::vector<double> RelativeErrors(const std::vector<Pose>& estimate,
                                   const std::vector<Pose>& truth,
                                   const std::vector<PosePair>& pairs, Relation relation);

}  // namespace eval

#pragma once

#include <map>
#include <string>

#include "slam/model/map_plane.h"

namespace slam {

/// How often a plane is labelled with one class, given the evidence of a map plane.
///   P(observed | belief) = sum over true classes c of P(observed | c) P(c | belief)
/// A class is missed in `kMiss` of its frames, and a false class is linked in `kFalse` of them,
/// so a missed detection (observed "") is weak evidence, and another object's class is strong
/// evidence. Source: PAS-SLAM's class rule (completed: the case of one class missing is a
/// belief, not a veto).
/// @param belief    summed evidence by class; "" is class -1; may be empty
/// @param observed  class of the frame plane, "" for -1
/// @returns likelihood in (0, 1]
double ClassLikelihood(const std::map<std::string, double>& belief,
                       const std::string& observed);

/// Bayes factor of "both have one class" against "each has its own": sum of P P' / prior over
/// the classes. Symmetric; far below 1 when they contradict, above 1 when they agree.
double SameClassOdds(const std::map<std::string, double>& one,
                     const std::map<std::string, double>& other);

/// The class with the highest posterior; "" while nothing is known.
std::string BelievedClass(const std::map<std::string, double>& belief);

/// Adds one observation of a plane's class and decides anew which class is believed in.
/// The class of a map plane is a belief over its observations, not the first label: a missed
/// detection weighs little against detections, a single false link little against many misses.
/// @param class_name  class of the frame plane; "" for none
/// @param score       of the detection, (0, 1]; 1 for none
void UpdateClassBelief(MapPlane& map_plane, const std::string& class_name, double score);

}  // namespace slam

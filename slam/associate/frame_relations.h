#pragma once

#include <vector>

#include "slam/associate/association_config.h"
#include "slam/associate/plane_assignment.h"
#include "slam/geometry/camera.h"
#include "slam/model/frame.h"

namespace slam {

inline constexpr double kCertainStep_sigmas = 4.0;  // 1 in 16,000

/// The two planes are linked to boxes of two objects. A second box of one object agrees with
/// the first (a double, maybe of another class) or lies in it (a part, of the same class); the
/// box of a book before a laptop lies in the laptop's and is of another class.
bool OnTwoObjects(const FramePlane& one, const FramePlane& other,
                  const std::vector<Detection>& detections);

/// What the planes of a frame are to each other.
struct FrameRelations {
  PieceTable pieces;
  std::vector<FrameStep> steps;  ///< between planes that but for the step could be one
};

FrameRelations RelateFramePlanes(const Frame& frame, const Camera& camera,
                                 const AssociationConfig& config);

}  // namespace slam

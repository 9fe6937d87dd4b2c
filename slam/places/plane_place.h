#pragma once

#include <optional>

#include "slam/places/place_guesses.h"
#include "slam/places/place_search.h"

namespace slam {

/// Where a camera is found by planes alone.
struct PlanePlace {
  /// None where nothing fits, and where more than one place does.
  std::optional<UncertainPose> pose;
  /// Covariance of the pose before the planes' parameters were counted: of a prior beside them.
  Matrix6d before = Matrix6d::Zero();
  bool ambiguous = false;  ///< more than one place fits
};

/// Finds a camera of which nothing is known by the planes of its frame: the constellation of their
/// angles, distances and corners is looked for among the landmarks (GuessPlaces), and each place is
/// held against the whole map: the frame's planes must show landmarks, and the landmarks in view
/// must be where depth was measured. A place counts when both are so, and when no other
/// place fits nearly as well: rooms and desks look alike.
/// @param frame  after plane processing; its pose is not looked at
PlanePlace FindPlaceByPlanes(const Frame& frame, const Map& map, const Camera& camera,
                             const PlanePlaceConfig& config, const PointSearchConfig& search);

}  // namespace slam

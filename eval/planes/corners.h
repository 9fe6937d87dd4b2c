#pragma once

#include <Eigen/Core>
#include <vector>

#include "eval/planes/true_frame.h"

namespace eval {

inline constexpr double kMaxCornerError_m = 0.05;

/// One-to-one matches of claimed and true corners with the most matches and, among these, the
/// least total distance; none beyond `max_error_m`.
/// @returns for each claim the index of its true corner, or -1
std::vector<int> MatchCorners(const std::vector<Eigen::Vector3d>& claimed,
                              const std::vector<Eigen::Vector3d>& truth, double max_error_m);

/// Counts over frames, planes and corners.
struct CornerCounts {
  int claimed = 0;  ///< corners of trusted frame planes
  int matched = 0;  ///< those of them at a true corner of the plane that the frame plane shows
  int true_in_view = 0;   ///< true corners in view of planes that count
  int found_in_view = 0;  ///< those of them that are matched
  int faces_in_view = 0;  ///< top faces of regular objects that count, all four corners in view
  int faces_with_4 = 0;   ///< those of them with four matches
  std::vector<double> errors_mm;  ///< distances of the matched ones

  /// @param claimed_c  corners of all trusted frame planes that show `seen`
  void AddPlane(const SeenPlane& seen, const std::vector<Eigen::Vector3d>& claimed_c);
  CornerCounts& operator+=(const CornerCounts& other);
};

}  // namespace eval

#pragma once

#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

namespace eval {

/// The label that a plane of a frame asks for. Positions are pixels of the picture.
struct LabelWish {
  cv::Point2d at;      ///< where it belongs
  std::string text;    ///< on its chip; empty: a dot is enough
  double share = 0.0;  ///< of the picture's area that the plane covers
};

/// A label that found room.
struct PlacedLabel {
  std::size_t wish = 0;
  bool is_chip = false;  ///< else a dot
  cv::Rect2d place;
  bool needs_leader = false;  ///< stands so far from where it belongs that a line leads there
};

inline constexpr double kChipText_px = 10.5;  ///< height of a capital letter on a chip
inline constexpr double kDotRadius_px = 5.5;
/// Share of the picture from which on a plane is one that a reader looks for.
inline constexpr double kLargeShare = 0.015;

/// Gives chips and dots their places so that none lies over another. The chips of large planes
/// come first and may stand aside; a small plane has a chip only where there is room and its
/// text does not stand in the frame already, else a dot; dots come last and are left out where a chip stands.
std::vector<PlacedLabel> PlaceLabels(const std::vector<LabelWish>& wishes, cv::Size picture);

}  // namespace eval

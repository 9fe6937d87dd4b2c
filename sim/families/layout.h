#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "sim/base/random.h"
#include "sim/families/recipe.h"

namespace sim {

inline constexpr double kThingMargin_m = 0.012;  ///< between things, and to the table's edge
inline constexpr int kTriesAThing = 300;  ///< places drawn for one before a layout is given up

/// Where the centre of a thing may come, and how far it may be turned.
struct Zone {
  Eigen::Vector2d low, high;  ///< metres, world x and y
  double max_yaw_deg = 180;
};

/// Puts rectangles on a table one after another so that all keep a margin between them and from
/// the edge.
class Layout {
 public:
  /// @param low,high  the table, world x and y
  Layout(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double margin_m)
      : low_(low), high_(high), margin_m_(margin_m) {}

  /// A free place for the footprint, drawn at most `tries` times; nothing when none was found.
  std::optional<Place> Find(const Eigen::Vector2d& footprint, const Zone& zone, int tries,
                            Random& random);

 private:
  struct Rectangle {
    Eigen::Vector2d center, half, x_axis;
  };
  bool OnTable(const Rectangle& rectangle) const;
  bool Free(const Rectangle& rectangle) const;
  Eigen::Vector2d low_, high_;
  double margin_m_;
  std::vector<Rectangle> taken_;
};

}  // namespace sim

#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "sim/shapes/mesh.h"

namespace sim {

/// What a ray meets; triangle -1 is nothing.
struct ExactHit {
  int triangle = -1;
  double distance = 0;  ///< in units of the direction
  bool from_front = false;
};

/// Casts rays at triangles in double, without the ray tracer: slow, but the same bits on every
/// processor. Watertight where triangles share corners bit for bit. Const and thread-safe.
class ExactCaster {
 public:
  explicit ExactCaster(std::span<const Triangle> triangles);

  /// Nearest triangle, either side of it, further than `near` times the direction. Of two at
  /// the same distance, to 1e-12, the one seen from the front (a ray along the edge of a body
  /// shows the side that faces the camera), then the first in the list.
  ExactHit Nearest(const Eigen::Vector3d& origin_w, const Eigen::Vector3d& direction_w,
                   double near) const;

 private:
  struct Node {
    Eigen::Array3d low, high;
    int first = 0, count = 0;  ///< in order_; count 0: an inner node
    int left = 0, right = 0;
  };
  struct Corners {
    Eigen::Vector3d a, b, c;
  };
  int Build(int first, int count);
  void Try(int triangle, const Eigen::Vector3d& origin_w, const Eigen::Vector3d& direction_w,
           double near, ExactHit& best) const;

  std::vector<Corners> triangles_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace sim

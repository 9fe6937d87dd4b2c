#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>

#include "sim/base/random.h"
#include "sim/motion/view.h"
#include "sim/scene/scene.h"

namespace sim {

/// A way of moving without its timing: views by how far the camera has come along its closed
/// way (`place`, one round is 1) and how far it has come in looking about (`look`, one round is
/// 1).
class Pattern {
 public:
  virtual ~Pattern() = default;
  virtual View At(double place, double look) const = 0;
  /// Whether the camera should see the target from where it starts.
  virtual bool FacesTarget() const { return true; }
  /// Whether the camera goes fast and slow by the way alone, as where it turns back.
  virtual bool GoesUnevenly() const { return false; }
  /// Whether the look itself goes fast and slow, so that it is to be paced evenly.
  virtual bool TurnsUnevenly() const { return false; }
};

/// @param scale  of what may be made smaller so that the way is free, 1 full size
/// @param random  draws where the way lies within the limits of `motion`
/// @throws std::invalid_argument for a preset that is no pattern
std::unique_ptr<Pattern> MakePattern(const Motion& motion, double scale, Random& random);

}  // namespace sim

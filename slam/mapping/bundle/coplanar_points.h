#pragma once

#include "slam/mapping/bundle/bundle_window.h"

namespace slam {

/// Holds the window's points that lie on its newest plane to it: their place is told by two
/// numbers in the plane, and the plane.
/// Source: co-planar parametrisation (Li, Li, Oernek, Lin, Tombari 2020; VIP-SLAM).
void HoldToPlane(const MapPlane& landmark, BundleWindow& window);

/// For the solver, blocks of held points: the two numbers in place of the position ...
void PlaceInPlanes(BundleWindow& window);
/// ... and the position again.
void PlaceInWorld(BundleWindow& window);

/// Lets go of the points that their observations alone would put farther off the plane than what
/// is not known of them and `sigma_m` explain (chi-square at 95 %), and puts them there.
void LetGoOfThoseOff(double sigma_m, BundleWindow& window);

}  // namespace slam

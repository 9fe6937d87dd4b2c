#pragma once

namespace slam {

/// Radians of an angle that a file gives in degrees.
double RadiansOf(double degrees);

/// Degrees that RadiansOf takes back to the same radians, with as few digits as do so. For an
/// angle that no number of degrees gives (about one in eleven, none that came from a file) the
/// nearest.
double DegreesOf(double radians);

}  // namespace slam

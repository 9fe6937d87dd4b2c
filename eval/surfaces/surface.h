#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "eval/planes/polygon.h"

namespace eval {

/// A large flat thing of a recording. World frame g, metres.
struct Surface {
  int id = 0;             ///< from 1
  int same_as = 0;        ///< id of the surface that it is a part of; 0 = none
  Plane pi_g;             ///< normal towards the cameras
  PlaneChart chart_g;     ///< in which the outlines stand
  double flatness_m = 0;  ///< root mean square of the fused heights over the plane
  std::vector<Polygon2> outlines, holes;  ///< an outline may lie in a hole
};

/// The file that `pas surfaces` writes.
struct SurfaceFile {
  std::string sequence;       ///< for the reader; not used
  double min_area_m2 = 0.15;  ///< smaller ones were left out
  double noise_per_m = 0.0;   ///< of one pixel's inverse depth, measured
  std::vector<Surface> surfaces;
};

/// Outlines less holes, square metres.
double AreaOf(const Surface& surface);

/// The id under which its figures are counted: its own, or that of what it is a part of.
inline int CountedAs(const Surface& surface) {
  return surface.same_as != 0 ? surface.same_as : surface.id;
}

/// Format "pas-surfaces/1", YAML, for a person to edit. @throws InputError with file:line
SurfaceFile ReadSurfaces(const std::filesystem::path& file);
std::string SurfacesText(const SurfaceFile& file);

}  // namespace eval

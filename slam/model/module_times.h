#pragma once

#include <array>

namespace slam {

/// Modules of the paper's time table, in the order of the columns of timing.csv.
enum class Module {
  kOrb,  ///< ORB extraction
  kOd,   ///< object detection
  kMdc,  ///< missed-detection compensation
  kEpi,  ///< extraction of planes and their edge points
  kPp,   ///< plane processing: re-fit, box link, edge lines, vertices, selection
  kDa,   ///< data association of points and planes
  kPo,   ///< pose optimisation
  kUpm,  ///< update of the plane map
  kMt    ///< the whole tracking of the frame
};

inline constexpr int kModuleCount = 9;
inline constexpr std::array<const char*, kModuleCount> kModuleNames = {
    "orb", "od", "mdc", "epi", "pp", "da", "po", "upm", "mt"};

/// What one frame cost, milliseconds by module. A report only: nothing is decided by it.
struct ModuleTimes {
  std::array<double, kModuleCount> ms{};
  double& operator[](Module m) { return ms[static_cast<std::size_t>(m)]; }
  double operator[](Module m) const { return ms[static_cast<std::size_t>(m)]; }
};

}  // namespace slam

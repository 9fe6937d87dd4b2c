#pragma once

#include <string>
#include <vector>

#include "sim/scene/scene.h"

namespace sim {

/// A synthetic counterpart of a recorded sequence of the TUM RGB-D benchmark: like structure,
/// texture, speeds and camera; up to 30 s.
struct Twin {
  std::string name;  ///< "fr1-desk"
  std::string family, preset;
  std::vector<std::pair<std::string, double>> parameters;
  double speed_m_s, turn_deg_s, duration_s;
};

/// All sixteen, in the order of the benchmark.
const std::vector<Twin>& Twins();

/// The scene with motion and capture set.
/// @throws InputError for a name that is not there
Scene MakeTwin(const std::string& name, std::uint64_t seed);

}  // namespace sim

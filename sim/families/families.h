#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "sim/scene/scene.h"

namespace sim {

/// A parameter of a family, as `pas scene make --set NAME=VALUE` takes it.
struct FamilyParameter {
  std::string name;  ///< with its unit, "step_mm"
  double value = 0;  ///< when it is not given
  double low = 0, high = 0;
  std::string meaning;
  bool whole = false;  ///< a whole number
  double least = 0;    ///< 0, which draws the value, or at least this much
};

/// A recipe for scenes.
struct Family {
  std::string name;
  std::string provokes;  ///< what it is hard for, one line
  std::vector<FamilyParameter> parameters;
};

/// All families, in a fixed order.
const std::vector<Family>& Families();

/// Makes a scene: the same family, seed and parameters give the same scene, bit for bit.
/// @throws InputError for a family or parameter that is not there, or a value out of its range.
Scene MakeScene(const std::string& family, std::uint64_t seed,
                const std::map<std::string, double>& parameters = {});

}  // namespace sim

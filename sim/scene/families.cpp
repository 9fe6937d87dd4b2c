#include "sim/scene/families.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sim/scene/check.h"
#include "sim/scene/input_error.h"
#include "sim/scene/number_text.h"
#include "sim/scene/recipe.h"

namespace sim {
namespace {

using Maker = Scene (*)(std::uint64_t, const ParameterValues&);

Maker MakerOf(const std::string& family) {
  if (family == "desk") return &MakeDesk;
  if (family == "plates") return &MakePlates;
  return &MakeStack;
}

ParameterValues Complete(const Family& family, const std::map<std::string, double>& given) {
  ParameterValues values;
  std::string known;
  for (const FamilyParameter& parameter : family.parameters) {
    values[parameter.name] = parameter.value;
    known += (known.empty() ? "" : ", ") + parameter.name;
  }
  for (const auto& entry : given) {
    const std::string& name = entry.first;
    const double value = entry.second;
    const auto at = std::find_if(family.parameters.begin(), family.parameters.end(),
                                 [&](const FamilyParameter& p) { return p.name == name; });
    if (at == family.parameters.end()) {
      throw InputError("family " + family.name,
                       "has no parameter '" + name + "'; expected one of: " + known);
    }
    if (!(value >= at->low && value <= at->high)) {
      throw InputError("family " + family.name,
                       "expected " + name + " from " + NumberText(at->low) + " to " +
                           NumberText(at->high) + ", found " + NumberText(value));
    }
    values[name] = Rounded(value);
  }
  return values;
}

}  // namespace

const std::vector<Family>& Families() {
  static const std::vector<Family> families{
      {"desk",
       "an office desk: many small near-parallel tops 6 to 50 mm over the desk and each other",
       {{"objects", 0, 0, 14, "things on the desk, 8 to 14; 0 draws the number"}}},
      {"plates",
       "two boards side by side: one plane or two? Step, gap and tilt are exact",
       {{"step_mm", 20, 0, 200, "height of the second top over the first, at the gap"},
        {"gap_mm", 20, 0.1, 500, "between the boards"},
        {"tilt_deg", 0, 0, 30, "of the second top; its far edge rises"},
        {"thickness_mm", 20, 1, 200, "of the first board"},
        {"side_mm", 300, 50, 600, "of both boards"}}},
      {"stack",
       "a stack of boards of nearly one size: equal steps, turned to and fro",
       {{"count", 4, 1, 10, "boards, a whole number"},
        {"step_mm", 20, 1, 100, "thickness of each"},
        {"turn_deg", 3, 0, 10, "of every second board"}}}};
  return families;
}

Scene MakeScene(const std::string& family, std::uint64_t seed,
                const std::map<std::string, double>& parameters) {
  std::string known;
  for (const Family& one : Families()) {
    known += (known.empty() ? "" : ", ") + one.name;
    if (one.name != family) continue;
    const ParameterValues values = Complete(one, parameters);
    for (const char* whole : {"objects", "count"}) {
      const auto at = values.find(whole);
      if (at != values.end() && at->second != std::floor(at->second)) {
        throw InputError("family " + family, std::string(whole) + " is a whole number");
      }
    }
    Scene scene = MakerOf(family)(seed, values);
    scene.name = family + "-" + std::to_string(seed);
    scene.family = family;
    scene.seed = seed;
    if (const auto fault = FindFault(scene)) {
      throw std::logic_error("family " + family + " made an impossible scene: " + fault->what);
    }
    return scene;
  }
  throw InputError("family '" + family + "'", "is not known; expected one of: " + known);
}

}  // namespace sim

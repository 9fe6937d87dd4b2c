#include "sim/families/families.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "io/input_error.h"
#include "io/number_text.h"
#include "sim/families/filling.h"
#include "sim/families/keycaps.h"
#include "sim/families/recipe.h"
#include "sim/scene/check.h"

namespace sim {
namespace {

using Maker = Scene (*)(std::uint64_t, const ParameterValues&);

struct Recipe {
  Family family;
  Maker make;
};

const FamilyParameter kTexture{"texture", 1, 0, 1, "richness of every print, 0 none"};
const FamilyParameter kLamps{
    "lamps", 0, 0, 4, "lights on beside the sun: in desk lamps, then panels overhead", true};
const FamilyParameter kKeycaps{
    "keycaps", 0, 0, 1, "1: every key of the keyboards with blocks of keys is a box", true};

std::vector<Recipe> DeskRecipes() {
  return {
      {{"desk",
        "an office desk: many small near-parallel tops 6 to 50 mm over the desk and each "
        "other, from 15 objects on sheets too",
        {{"objects", 0, 0, 40, "things on the desk, 5 to 40; 0 draws 8 to 14", true, 5},
         kLamps,
         kKeycaps,
         kTexture}},
       &MakeDesk},
      {{"plates",
        "two boards side by side: one plane or two? Step, gap and tilt are exact",
        {{"step_mm", 20, 0, 200, "height of the second top over the first, at the gap"},
         {"gap_mm", 20, 0.1, 500, "between the boards"},
         {"tilt_deg", 0, 0, 30, "of the second top; its far edge rises"},
         {"thickness_mm", 20, 1, 200, "of the first board"},
         {"side_mm", 300, 50, 600, "of both boards"},
         kTexture}},
       &MakePlates},
      {{"stack",
        "a stack of boards of nearly one size: equal steps, turned to and fro",
        {{"count", 4, 1, 10, "boards, a whole number", true},
         {"step_mm", 20, 1, 100, "thickness of each"},
         {"turn_deg", 3, 0, 10, "of every second board"},
         kTexture}},
       &MakeStack},
      {{"coplanar",
        "pairs of different things whose tops are one plane, or nearly: two landmarks or one?",
        {{"count", 2, 1, 3, "pairs", true},
         {"step_mm", 0, 0, 2, "of the right top over the left one"},
         {"gap_mm", 40, 5, 300, "between the two of a pair"},
         kTexture}},
       &MakeCoplanar},
      {{"tilted",
        "books that lean on what lies under them: tops that are nearly level",
        {{"count", 3, 1, 4, "leaning books", true},
         {"lift_mm", 0, 0, 50, "height of what lies under them, 0.1 to 50; 0 draws 7 to 45",
          false, 0.1},
         kTexture}},
       &MakeTilted},
      {{"board",
        "thin upright boards seen from both sides: front and back are not one plane",
        {{"count", 3, 1, 4, "a screen, a tablet, then boards", true},
         {"thickness_mm", 8, 2, 50, "of the boards"},
         kTexture}},
       &MakeBoards},
      {{"twins",
        "two desks that look alike: which of the two is it?",
        {{"apart_m", 2.4, 1.6, 5, "from desk to desk"},
         {"missing", 1, 0, 5, "things that the second desk lacks", true},
         kTexture}},
       &MakeTwins},
      {{"revisit",
        "the camera leaves the desk, looks at a shelf, and comes back",
        {{"objects", 0, 0, 14, "things on the desk, 8 to 14; 0 draws the number", true, 8},
         kTexture}},
       &MakeRevisit}};
}

std::vector<Recipe> RoomRecipes() {
  return {{{"office",
            "two desks back to back, a cabinet and a shelf; a long loop round the desks",
            {{"objects", 20, 2, 40, "things on both desks, fewer when they do not fit", true},
             kLamps,
             kKeycaps,
             kTexture}},
           &MakeOffice},
          {{"room",
            "a small room seen all round from its middle",
            {{"objects", 10, 1, 20, "things on the desk, fewer when they do not fit", true},
             kTexture}},
           &MakeRoomFamily},
          {{"cabinet",
            "one cabinet with doors 18 mm thick, and little else to see",
            {{"width_m", 0.9, 0.4, 2, ""},
             {"depth_m", 0.45, 0.3, 0.8, ""},
             {"height_m", 1.0, 0.5, 1.9, ""},
             kTexture}},
           &MakeCabinetFamily},
          {{"wall",
            "panels that fill the view, in zigzag or flat, printed or plain, near or far",
            {{"structure", 1, 0, 1, "1 zigzag, 0 flat", true},
             {"distance_m", 1.2, 0.7, 2.6, "of the camera"},
             kTexture}},
           &MakeWall},
          {{"passer",
            "someone walks past, or a hand or a carried toy moves through the view",
            {{"kind", 0, 0, 3, "1 a walker, 2 a hand, 3 a hand with a toy; 0 draws", true},
             {"objects", 10, 2, 14, "things on the desk, fewer when they do not fit", true},
             {"times", 4, 1, 20, "how often it comes", true},
             {"speed_m_s", 0, 0, 2,
              "of its way, 0.05 to 2; 0 is 0.9 for a walker, 0.5 for a hand", false, 0.05},
             kTexture}},
           &MakePasser}};
}

const std::vector<Recipe>& Recipes() {
  static const std::vector<Recipe> recipes = [] {
    std::vector<Recipe> all = DeskRecipes();
    for (const Recipe& recipe : RoomRecipes()) all.push_back(recipe);
    return all;
  }();
  return recipes;
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
      throw io::InputError("family " + family.name,
                           "has no parameter '" + name + "'; expected one of: " + known);
    }
    if (!(value >= at->low && value <= at->high)) {
      throw io::InputError("family " + family.name,
                           "expected " + name + " from " + io::NumberText(at->low) + " to " +
                               io::NumberText(at->high) + ", found " + io::NumberText(value));
    }
    if (value != 0 && value < at->least) {
      throw io::InputError("family " + family.name, "expected " + name + " of 0 or from " +
                                                        io::NumberText(at->least) +
                                                        " on, found " + io::NumberText(value));
    }
    values[name] = Rounded(value);
  }
  return values;
}

}  // namespace

const std::vector<Family>& Families() {
  static const std::vector<Family> families = [] {
    std::vector<Family> all;
    for (const Recipe& recipe : Recipes()) all.push_back(recipe.family);
    return all;
  }();
  return families;
}

Scene MakeScene(const std::string& family, std::uint64_t seed,
                const std::map<std::string, double>& parameters) {
  std::string known;
  for (const auto& [one, make] : Recipes()) {
    known += (known.empty() ? "" : ", ") + one.name;
    if (one.name != family) continue;
    const ParameterValues values = Complete(one, parameters);
    for (const FamilyParameter& parameter : one.parameters) {
      const double value = values.at(parameter.name);
      if (parameter.whole && value != std::floor(value)) {
        throw io::InputError("family " + family, parameter.name + " is a whole number");
      }
    }
    Scene scene = make(seed, values);
    if (values.at("texture") < 1) DialTexture(values.at("texture"), scene);
    if (values.count("keycaps") != 0 && values.at("keycaps") > 0) PutKeycaps(scene);
    if (const auto lamps = values.find("lamps"); lamps != values.end()) {
      PutLights(static_cast<int>(lamps->second), seed, scene);
    }
    scene.name = family + "-" + std::to_string(seed);
    scene.family = family;
    scene.seed = seed;
    if (const auto fault = FindFault(scene)) {
      throw std::logic_error("family " + family + " made an impossible scene: " + fault->what);
    }
    return scene;
  }
  throw io::InputError("family '" + family + "'", "is not known; expected one of: " + known);
}

}  // namespace sim

#pragma once

#include <rapidcheck.h>

#include <cstdint>
#include <map>
#include <string>

#include "property_tests/generators/numbers.h"
#include "sim/base/angle.h"
#include "sim/families/families.h"
#include "sim/scene/scene.h"

namespace sim {

using generators::AnyInt;

/// Shrinks towards its first value.
inline double DrawReal(double low, double high, int steps = 1000) {
  return low + (high - low) * AnyInt(0, steps) / steps;
}

/// What a scene was made from, for a message that `pas scene make` can replay.
struct SceneRecipe {
  std::string family;
  std::uint64_t seed = 0;
  std::map<std::string, double> parameters;

  Scene Make() const { return MakeScene(family, seed, parameters); }
  std::string Command() const {
    std::string command =
        "pas scene make --family " + family + " --seed " + std::to_string(seed);
    for (const auto& [name, value] : parameters) {
      command += " --set " + name + "=" + std::to_string(value);
    }
    return command + " -o scene.yaml";
  }
};

/// The recipe of a family, any of its parameters in their ranges (whole numbers where they are)
/// but for the texture, which is full.
inline SceneRecipe DrawRecipeOf(const Family& family) {
  SceneRecipe recipe{family.name, static_cast<std::uint64_t>(AnyInt(0, 100000)), {}};
  for (const FamilyParameter& parameter : family.parameters) {
    // How many things fit depends on the desk.
    if (parameter.name == "objects" || parameter.name == "texture") continue;
    const int low =
        static_cast<int>(parameter.low) + (parameter.low > static_cast<int>(parameter.low));
    recipe.parameters[parameter.name] = AnyInt(low, static_cast<int>(parameter.high));
  }
  return recipe;
}

/// One of the first three families: desk, plates, stack.
inline SceneRecipe DrawSceneRecipe() {
  return DrawRecipeOf(Families()[static_cast<std::size_t>(AnyInt(0, 2))]);
}

/// Any family, any texture.
inline SceneRecipe DrawAnyRecipe() {
  const auto last = static_cast<int>(Families().size()) - 1;
  SceneRecipe recipe = DrawRecipeOf(Families()[static_cast<std::size_t>(AnyInt(0, last))]);
  recipe.parameters["texture"] = DrawReal(0, 1, 10);
  return recipe;
}

/// A desk whose motion has any of the presets.
inline Scene DrawDesk() {
  Scene scene = MakeScene("desk", static_cast<std::uint64_t>(AnyInt(0, 100000)));
  scene.motion.preset = *rc::gen::element<std::string>("slow", "office", "fast");
  return scene;
}

/// A solid box anywhere within two metres, sides 0.05 to 1 m, turned in any way.
inline Object DrawBox(int id) {
  Object box;
  box.id = id;
  box.name = "box_" + std::to_string(id);
  box.class_name = "box";
  box.role = Role::kRegular;
  for (int i = 0; i < 3; ++i) {
    box.center_w[i] = DrawReal(-1, 1);
    box.size[i] = DrawReal(0.05, 1);
  }
  const double roll = DrawReal(0, 180), pitch = DrawReal(-90, 90);
  box.q_wo = QuaternionFromRpyDeg({roll, pitch, DrawReal(0, 360)});
  return box;
}

}  // namespace sim

#include "sim/families/materials.h"

#include <vector>

#include "sim/families/recipe.h"

namespace sim {
namespace {

using Colour = std::array<double, 3>;

double Shade(double value) { return Rounded(value < 0 ? 0 : value > 1 ? 1 : value); }

Colour Varied(const Colour& colour, double spread, Random& random) {
  const double light = random.Between(1 - spread, 1 + spread);
  Colour varied{};
  for (std::size_t i = 0; i < 3; ++i) {
    varied[i] = Shade(colour[i] * light * random.Between(1 - spread / 3, 1 + spread / 3));
  }
  return varied;
}

Colour Pick(const std::vector<Colour>& palette, Random& random) {
  return palette[static_cast<std::size_t>(random.Below(static_cast<int>(palette.size())))];
}

const std::vector<Colour> kWoods{{.46, .29, .15}, {.58, .42, .25}, {.35, .21, .11}};
const std::vector<Colour> kCloths{{.45, .30, .20}, {.30, .35, .45}, {.40, .42, .36}};
const std::vector<Colour> kCovers{{.65, .10, .10}, {.10, .25, .60}, {.10, .45, .25},
                                  {.75, .60, .10}, {.45, .15, .50}, {.80, .40, .10},
                                  {.15, .50, .55}, {.75, .72, .65}};
const std::vector<Colour> kPapers{{.85, .83, .76}, {.80, .80, .80}, {.78, .72, .58}};
const std::vector<Colour> kWalls{{.70, .68, .62}, {.60, .66, .70}, {.70, .62, .58}};

struct Look {
  Colour colour, ink;
};

Look DrawLook(Print print, Random& random) {
  const Colour dark{.03, .03, .04}, light{.85, .85, .82};
  switch (print) {
    case Print::kWood: {
      const Colour wood = Pick(kWoods, random);
      return {wood, {wood[0] * .35, wood[1] * .30, wood[2] * .25}};
    }
    case Print::kCloth: {
      const Colour cloth = Pick(kCloths, random);
      return {cloth, {cloth[0] * .3, cloth[1] * .3, cloth[2] * .3}};
    }
    case Print::kCover: {
      const Colour cover = Pick(kCovers, random);
      const bool bright = cover[0] + cover[1] + cover[2] > 1.2;
      return {cover, bright ? dark : light};
    }
    case Print::kText:
      return {Pick(kPapers, random), dark};
    case Print::kKeys:
      return {{.10, .10, .11}, light};
    case Print::kScreen:
      return {{.12, .20, .38}, light};
    case Print::kSpeckle:
      return {Pick(kWalls, random), {.15, .17, .22}};
    case Print::kPlain:
      break;
  }
  return {{.35, .35, .36}, dark};
}

}  // namespace

Material DrawMaterial(Print print, Random& random) {
  const Look look = DrawLook(print, random);
  Material material;
  material.print = print;
  material.colour = Varied(look.colour, 0.15, random);
  material.ink = Varied(look.ink, 0.10, random);
  material.richness = print == Print::kPlain ? 0 : Rounded(0.01 * (85 + random.Below(16)));
  material.seed = random.Bits() >> 32;
  return material;
}

void Dress(Object& object, Random& random) {
  const std::string& kind = object.class_name;
  const auto face = [&](Face which) -> Material& {
    return object.faces[static_cast<std::size_t>(which)];
  };
  if (kind == "teddy bear") {
    object.faces.fill(DrawMaterial(Print::kCloth, random));
  } else if (kind == "book") {
    object.faces.fill(DrawMaterial(Print::kText, random));  // the edges of the pages
    face(Face::kPlusZ) = DrawMaterial(Print::kCover, random);
    face(Face::kMinusZ) = face(Face::kMinusX) = face(Face::kPlusZ);
  } else if (kind == "box") {
    object.faces.fill(DrawMaterial(random.Chance(0.5) ? Print::kText : Print::kCover, random));
    face(Face::kPlusZ).seed = random.Bits() >> 32;
  } else if (kind == "keyboard" || kind == "remote") {
    object.faces.fill(DrawMaterial(Print::kSpeckle, random));
    face(Face::kPlusZ) = DrawMaterial(Print::kKeys, random);
  } else if (kind == "cell phone" || kind == "tablet") {
    object.faces.fill(DrawMaterial(Print::kSpeckle, random));
    face(Face::kPlusZ) = DrawMaterial(Print::kScreen, random);
  } else {
    object.faces.fill(DrawMaterial(Print::kSpeckle, random));
  }
}

}  // namespace sim

#pragma once

#include "sim/base/random.h"
#include "sim/scene/scene.h"

namespace sim {

/// Materials rich enough for corner features; the base colour is drawn too.
Material DrawMaterial(Print print, Random& random);
/// Gives each face of the object its look by class: keys on top of a keyboard, and so on.
void Dress(Object& object, Random& random);

}  // namespace sim

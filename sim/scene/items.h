#pragma once

#include "sim/scene/random.h"
#include "sim/scene/recipe.h"

/// Things that stand on desks; sizes are those of real ones, in the ranges the shops sell.
namespace sim {

Item MakeBook(Random& random);
/// `count` books, each wholly on the one below and turned by up to 6 degrees.
Item MakeBookStack(int count, Random& random);
Item MakeKeyboard(Random& random);
/// Base and lid as two boxes that meet along the hinge, open by 95 to 130 degrees.
Item MakeOpenLaptop(Random& random);
Item MakeClosedLaptop(Random& random);
/// Panel, neck and foot.
Item MakeMonitor(Random& random);
Item MakeCarton(Random& random);
Item MakePhone(Random& random);
Item MakeTablet(Random& random);
Item MakeMouse(Random& random);
Item MakeRemote(Random& random);
/// The unstructured one: class "teddy bear", no planes.
Item MakeToy(Random& random);

}  // namespace sim

#pragma once

#include "sim/base/random.h"
#include "sim/families/recipe.h"

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

// items_more.cpp; the round ones have no planes and are neither regular nor unstructured.
Item MakeMug(Random& random);
Item MakeBottle(Random& random);
Item MakeBowl(Random& random);
/// Pot and foliage, "potted plant", unstructured.
Item MakePlant(Random& random);
/// Foot, post and shade.
Item MakeLamp(Random& random);
/// A5 or A4, 3 to 20 mm; class "book".
Item MakeNotebook(Random& random);
/// A4 sheets, 0.5 to 10 mm in all; class "paper".
Item MakePaper(Random& random);
Item MakeMousePad(Random& random);
/// Class "box".
Item MakeTissueBox(Random& random);
/// Base and three blocks of keys that stand out by 2 to 10 mm.
Item MakeKeycapKeyboard(Random& random);
/// An upright board of the thickness, two blocks keep it; class "book".
Item MakeUprightBoard(double thickness_m, Random& random);
/// A tablet upright on a foot.
Item MakeUprightTablet(Random& random);

}  // namespace sim

#include <algorithm>

#include "sim/families/items.h"

namespace sim {
namespace {

Part RoundPart(const std::string& class_name, ShapeKind shape, double across, double height,
               double bottom_z, const Material& material) {
  Part part = BoxPart(class_name, {across, across, height}, 0, 0, bottom_z);
  part.object.shape = shape;
  part.object.role = Role::kOther;
  part.object.faces.fill(material);
  return part;
}

Item Single(const Part& part) {
  Item item;
  item.parts.push_back(part);
  item.footprint = part.object.size.head<2>();
  return item;
}

struct Range {
  double low, high;
};

Item SingleRound(const std::string& class_name, ShapeKind shape, const Range& across_m,
                 const Range& height_m, Print print, Random& random) {
  const double across = DrawLength(random, across_m.low, across_m.high);
  const double height = DrawLength(random, height_m.low, height_m.high);
  return Single(RoundPart(class_name, shape, across, height, 0, DrawMaterial(print, random)));
}

Item SinglePrinted(const std::string& class_name, const Eigen::Vector3d& size, Print print,
                   Random& random) {
  Part part = BoxPart(class_name, size, 0, 0, 0);
  part.object.faces.fill(DrawMaterial(print, random));
  return Single(part);
}

}  // namespace

Item MakeMug(Random& random) {
  return SingleRound("cup", ShapeKind::kMug, {.070, .095}, {.080, .115}, Print::kCover, random);
}

Item MakeBottle(Random& random) {
  return SingleRound("bottle", ShapeKind::kBottle, {.060, .085}, {.18, .27}, Print::kCover,
                     random);
}

Item MakeBowl(Random& random) {
  return SingleRound("bowl", ShapeKind::kBowl, {.12, .20}, {.05, .08}, Print::kSpeckle, random);
}

Item MakePlant(Random& random) {
  const double pot_across = DrawLength(random, .10, .15);
  const double pot_height = DrawLength(random, .09, .13);
  const double leaf_across = Rounded(pot_across + DrawLength(random, .04, .12));
  const double leaf_height = DrawLength(random, .15, .28);
  Item plant;
  plant.one_detection = true;
  plant.footprint = {leaf_across, leaf_across};
  plant.parts.push_back(RoundPart("potted plant", ShapeKind::kMug, pot_across, pot_height, 0,
                                  DrawMaterial(Print::kPlain, random)));
  Part leaves = RoundPart("potted plant", ShapeKind::kBush, leaf_across, leaf_height,
                          pot_height, DrawMaterial(Print::kCloth, random));
  leaves.object.faces.fill([&] {
    Material green = DrawMaterial(Print::kSpeckle, random);
    green.colour = {.12, .38, .10};
    green.ink = {.03, .12, .03};
    return green;
  }());
  leaves.object.seed = 1 + (random.Bits() >> 32);
  plant.parts.push_back(leaves);
  for (Part& part : plant.parts) part.object.role = Role::kUnstructured;
  return plant;
}

Item MakeLamp(Random& random) {
  const double foot = DrawLength(random, .14, .18), shade = DrawLength(random, .16, .24);
  const double post_height = DrawLength(random, .20, .30);
  const double shade_height = DrawLength(random, .10, .15);
  const Material metal = DrawMaterial(Print::kPlain, random);
  Item lamp;
  lamp.one_detection = true;
  lamp.footprint = Eigen::Vector2d::Constant(std::max(foot, shade));
  lamp.parts.push_back(RoundPart("lamp", ShapeKind::kCylinder, foot, .02, 0, metal));
  lamp.parts.push_back(RoundPart("lamp", ShapeKind::kCylinder, .016, post_height, .02, metal));
  Part hood = RoundPart("lamp", ShapeKind::kBowl, shade, shade_height, .02 + post_height,
                        DrawMaterial(Print::kCloth, random));
  hood.rpy_deg.x() = 180;  // a bowl upside down
  lamp.parts.push_back(hood);
  return lamp;
}

Item MakeNotebook(Random& random) {
  const bool large = random.Chance(0.4);
  const double thickness = DrawLength(random, .003, .020);
  return SinglePrinted("book", {large ? .210 : .148, large ? .297 : .210, thickness},
                       Print::kCover, random);
}

Item MakePaper(Random& random) {
  const double thickness = DrawLength(random, .0005, .010);
  return SinglePrinted("paper", {.210, .297, thickness}, Print::kText, random);
}

Item MakeMousePad(Random& random) {
  const double width = DrawLength(random, .20, .26), depth = DrawLength(random, .17, .21);
  const double thickness = DrawLength(random, .002, .005);
  return SinglePrinted("mouse pad", {width, depth, thickness}, Print::kCloth, random);
}

Item MakeTissueBox(Random& random) {
  const double width = DrawLength(random, .21, .24), depth = DrawLength(random, .11, .13);
  const double height = DrawLength(random, .06, .10);
  return SinglePrinted("box", {width, depth, height}, Print::kCover, random);
}

Item MakeKeycapKeyboard(Random& random) {
  const double depth = DrawLength(random, .12, .15), base = DrawLength(random, .008, .020);
  const double relief = DrawLength(random, .002, .010);
  Item keyboard = Single(BoxPart("keyboard", {.45, depth, base}, 0, 0, 0));
  keyboard.one_detection = true;
  Dress(keyboard.parts[0].object, random);
  keyboard.parts[0].object.faces.fill(DrawMaterial(Print::kSpeckle, random));
  const double rows = Rounded(depth - 0.02);
  struct Block {
    double x, width;
  };
  for (const Block& block : {Block{-.073, .284}, Block{.105, .056}, Block{.179, .075}}) {
    Part keys = BoxPart("keyboard", {block.width, rows, relief}, block.x, 0, base);
    Dress(keys.object, random);
    keyboard.parts.push_back(keys);
  }
  return keyboard;
}

Item MakeUprightBoard(double thickness_m, Random& random) {
  constexpr double kBlock_m = 0.03;
  const double width = DrawLength(random, .25, .45), height = DrawLength(random, .20, .35);
  Item board = Single(BoxPart("book", {width, thickness_m, height}, 0, 0, 0));
  board.one_detection = true;
  Object& sheet = board.parts[0].object;
  sheet.faces.fill(DrawMaterial(Print::kPlain, random));
  sheet.faces[static_cast<std::size_t>(Face::kMinusY)] = DrawMaterial(Print::kCover, random);
  sheet.faces[static_cast<std::size_t>(Face::kPlusY)] = DrawMaterial(Print::kText, random);
  const Material wood = DrawMaterial(Print::kWood, random);
  for (const double side : {-1.0, 1.0}) {
    Part block = BoxPart("book", {Rounded(width / 2), kBlock_m, .04}, 0,
                         side * (thickness_m + kBlock_m) / 2, 0);
    block.object.faces.fill(wood);
    board.parts.push_back(block);
  }
  board.footprint = {width, thickness_m + 2 * kBlock_m};
  return board;
}

Item MakeUprightTablet(Random& random) {
  const double thickness = DrawLength(random, .006, .009);
  Item tablet = Single(BoxPart("tablet", {.16, .10, .02}, 0, 0, 0));
  tablet.one_detection = true;
  Dress(tablet.parts[0].object, random);
  tablet.parts[0].object.faces.fill(DrawMaterial(Print::kPlain, random));
  Part pane = BoxPart("tablet", {.25, thickness, .174}, 0, 0, .02);
  pane.object.faces.fill(DrawMaterial(Print::kSpeckle, random));
  pane.object.faces[static_cast<std::size_t>(Face::kMinusY)] =
      DrawMaterial(Print::kScreen, random);
  tablet.parts.push_back(pane);
  tablet.footprint = {.25, .10};
  return tablet;
}

}  // namespace sim

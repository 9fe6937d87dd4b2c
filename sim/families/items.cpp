#include "sim/families/items.h"

#include <algorithm>
#include <cmath>

#include "sim/base/angle.h"

namespace sim {
namespace {

Item SingleBox(const std::string& class_name, const Eigen::Vector3d& size, Random& random) {
  Item item;
  item.parts.push_back(BoxPart(class_name, size, 0, 0, 0));
  Dress(item.parts[0].object, random);
  item.footprint = size.head<2>();
  return item;
}

Eigen::Vector3d DrawSize(Random& random, const Eigen::Vector3d& low,
                         const Eigen::Vector3d& high) {
  const double x = DrawLength(random, low.x(), high.x());
  const double y = DrawLength(random, low.y(), high.y());
  return {x, y, DrawLength(random, low.z(), high.z())};
}

Eigen::Vector3d DrawBookSize(Random& random) {
  return DrawSize(random, {.120, .180, .012}, {.200, .270, .050});
}

/// Half the size of the upright rectangle around one turned by `yaw_deg`.
Eigen::Vector2d TurnedHalf(const Eigen::Vector2d& size, double yaw_deg) {
  const SinCos yaw = SinCosDeg(yaw_deg);
  const double c = std::abs(yaw.cos), s = std::abs(yaw.sin);
  return {(c * size.x() + s * size.y()) / 2, (s * size.x() + c * size.y()) / 2};
}

}  // namespace

Item MakeBook(Random& random) { return SingleBox("book", DrawBookSize(random), random); }

Item MakeBookStack(int count, Random& random) {
  Item stack = MakeBook(random);
  for (int i = 1; i < count; ++i) {
    const Object below = stack.parts.back().object;
    const double yaw_deg = Rounded(0.1 * (random.Below(121) - 60));
    Eigen::Vector3d size = DrawBookSize(random);
    size.head<2>() = size.head<2>().cwiseMin(below.size.head<2>() * 0.96);
    // Turned by yaw it must still fit on the book below, in that book's own frame.
    const double turn_deg = yaw_deg - stack.parts.back().rpy_deg.z();
    const Eigen::Vector2d half = TurnedHalf(size.head<2>(), turn_deg);
    const double fit = (below.size.head<2>() / 2).cwiseQuotient(half).minCoeff();
    if (fit < 1) size.head<2>() *= 0.98 * fit;
    size =
        size.unaryExpr([](double a) { return std::floor(a * 1e4) / 1e4; }).unaryExpr(&Rounded);
    const Eigen::Vector2d room = below.size.head<2>() / 2 -
                                 TurnedHalf(size.head<2>(), turn_deg) -
                                 Eigen::Vector2d::Constant(1e-4);
    // Drawn in statements of their own: compilers differ in the order of arguments.
    const double shift_y = random.Between(-1, 1) * std::max(room.y(), 0.0);
    const double shift_x = random.Between(-1, 1) * std::max(room.x(), 0.0);
    const Eigen::Vector2d shift(shift_x, shift_y);
    const SinCos below_yaw = SinCosDeg(stack.parts.back().rpy_deg.z());
    Part book =
        BoxPart("book", size,
                below.center_w.x() + below_yaw.cos * shift.x() - below_yaw.sin * shift.y(),
                below.center_w.y() + below_yaw.sin * shift.x() + below_yaw.cos * shift.y(),
                below.center_w.z() + below.size.z() / 2);
    book.rpy_deg.z() = yaw_deg;
    Dress(book.object, random);
    stack.parts.push_back(book);
  }
  return stack;
}

Item MakeKeyboard(Random& random) {
  return SingleBox("keyboard", DrawSize(random, {.30, .11, .012}, {.45, .15, .030}), random);
}

Item MakeOpenLaptop(Random& random) {
  const Eigen::Vector3d base_size = DrawSize(random, {.30, .210, .012}, {.36, .248, .018});
  const double lid_length = DrawLength(random, 0.94 * base_size.y(), 0.99 * base_size.y());
  const double lid_thickness = DrawLength(random, .005, .008);
  const double opening_deg = Rounded(0.1 * (950 + random.Below(351)));
  const SinCos opening = SinCosDeg(opening_deg);
  const double behind = -lid_length * opening.cos + lid_thickness * opening.sin;

  Item laptop;
  laptop.one_detection = true;
  laptop.footprint = {base_size.x(), base_size.y() + behind};
  Part base = BoxPart("laptop", base_size, 0, -behind / 2, 0);
  Dress(base.object, random);
  base.object.faces[static_cast<std::size_t>(Face::kPlusZ)] =
      DrawMaterial(Print::kKeys, random);

  // The lid's own z runs up the screen, its -y is the screen; both turn about the hinge.
  Part lid = BoxPart("laptop", {base_size.x(), lid_thickness, lid_length}, 0, 0, 0);
  const Eigen::Vector3d hinge(0, (base_size.y() - behind) / 2, base_size.z());
  const Eigen::Vector3d up(0, -opening.cos, opening.sin), out(0, opening.sin, opening.cos);
  lid.object.center_w = hinge + up * lid_length / 2 + out * lid_thickness / 2;
  lid.rpy_deg.x() = Rounded(90 - opening_deg);
  Dress(lid.object, random);
  lid.object.faces[static_cast<std::size_t>(Face::kMinusY)] =
      DrawMaterial(Print::kScreen, random);
  laptop.parts = {base, lid};
  return laptop;
}

Item MakeClosedLaptop(Random& random) {
  return SingleBox("laptop", DrawSize(random, {.30, .210, .015}, {.36, .248, .025}), random);
}

Item MakeMonitor(Random& random) {
  const bool large = random.Chance(0.4);
  const Eigen::Vector3d panel_size(large ? .598 : .531, DrawLength(random, .030, .050),
                                   large ? .336 : .299);
  const Eigen::Vector3d foot_size = DrawSize(random, {.20, .16, .006}, {.27, .24, .015});
  const double bottom = DrawLength(random, .08, .16);
  const Eigen::Vector3d neck_size(.06, .03, bottom + panel_size.z() * 0.6 - foot_size.z());

  // The panel hangs on the front of the neck, the neck stands behind the middle of the foot.
  const double front = std::max(foot_size.y() / 2, panel_size.y());
  const double middle_y = (front - foot_size.y() / 2) / 2;
  Item monitor;
  monitor.one_detection = true;
  monitor.footprint = {std::max(panel_size.x(), foot_size.x()), front + foot_size.y() / 2};
  Part panel = BoxPart("tv", panel_size, 0, middle_y - panel_size.y() / 2, bottom);
  Dress(panel.object, random);
  panel.object.faces[static_cast<std::size_t>(Face::kMinusY)] =
      DrawMaterial(Print::kScreen, random);
  Part neck = BoxPart("tv", neck_size.unaryExpr(&Rounded), 0, middle_y + neck_size.y() / 2,
                      foot_size.z());
  Part foot = BoxPart("tv", foot_size, 0, middle_y, 0);
  Dress(neck.object, random);
  Dress(foot.object, random);
  monitor.parts = {panel, neck, foot};
  return monitor;
}

Item MakeCarton(Random& random) {
  return SingleBox("box", DrawSize(random, {.18, .13, .06}, {.32, .24, .22}), random);
}

Item MakePhone(Random& random) {
  return SingleBox("cell phone", DrawSize(random, {.067, .138, .007}, {.078, .165, .010}),
                   random);
}

Item MakeTablet(Random& random) {
  return SingleBox("tablet", DrawSize(random, {.165, .240, .006}, {.180, .260, .009}), random);
}

Item MakeMouse(Random& random) {
  return SingleBox("mouse", DrawSize(random, {.055, .095, .028}, {.070, .125, .042}), random);
}

Item MakeRemote(Random& random) {
  return SingleBox("remote", DrawSize(random, {.042, .150, .016}, {.055, .190, .024}), random);
}

Item MakeToy(Random& random) {
  Item toy =
      SingleBox("teddy bear", DrawSize(random, {.14, .13, .18}, {.19, .18, .25}), random);
  Object& object = toy.parts[0].object;
  object.role = Role::kUnstructured;
  object.shape = ShapeKind::kToy;
  object.seed = 1 + (random.Bits() >> 32);
  return toy;
}

}  // namespace sim

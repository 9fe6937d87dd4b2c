#include "sim/families/furniture.h"

#include <algorithm>

namespace sim {
namespace {

Part FurniturePart(const Eigen::Vector3d& size, const Eigen::Vector3d& low,
                   const Material& material) {
  Part part = BoxPart("cabinet", size.unaryExpr(&Rounded), low.x() + size.x() / 2,
                      low.y() + size.y() / 2, low.z());
  part.object.faces.fill(material);
  return part;
}

}  // namespace

Item MakeCabinet(const Eigen::Vector3d& size, Random& random) {
  constexpr double kDoor_m = 0.018, kGap_m = 0.004, kRim_m = 0.03;
  const Material carcass = DrawMaterial(Print::kWood, random);
  const Material door = DrawMaterial(Print::kWood, random);
  const Material metal = DrawMaterial(Print::kPlain, random);
  Item cabinet;
  cabinet.one_detection = true;
  cabinet.footprint = size.head<2>();
  const double w = size.x(), d = size.y(), h = size.z();
  const double front = -d / 2 + kDoor_m;
  cabinet.parts.push_back(FurniturePart({w, d - kDoor_m, h}, {-w / 2, front, 0}, carcass));
  const double door_width = w / 2 - kRim_m - kGap_m / 2;
  for (const double side : {-1.0, 1.0}) {
    const double low_x = side < 0 ? -kGap_m / 2 - door_width : kGap_m / 2;
    cabinet.parts.push_back(
        FurniturePart({door_width, kDoor_m, h - 2 * kRim_m}, {low_x, -d / 2, kRim_m}, door));
    cabinet.parts.push_back(
        FurniturePart({.012, .012, .12}, {side * .04 - .006, -d / 2 - .012, h / 2}, metal));
  }
  return cabinet;
}

Item MakeShelf(const Eigen::Vector3d& size, int boards, Random& random) {
  constexpr double kBoard_m = 0.02;
  const Material wood = DrawMaterial(Print::kWood, random);
  Item shelf;
  shelf.one_detection = true;
  shelf.footprint = size.head<2>();
  const double w = size.x(), d = size.y(), h = size.z();
  for (const double low_x : {-w / 2, w / 2 - kBoard_m}) {
    shelf.parts.push_back(FurniturePart({kBoard_m, d, h}, {low_x, -d / 2, 0}, wood));
  }
  const double inner = w - 2 * kBoard_m;
  shelf.parts.push_back(
      FurniturePart({inner, kBoard_m, h}, {-inner / 2, d / 2 - kBoard_m, 0}, wood));
  for (int i = 0; i < boards; ++i) {
    const double z = ShelfBoard_m(size, boards, i) - kBoard_m;
    shelf.parts.push_back(
        FurniturePart({inner, d - kBoard_m, kBoard_m}, {-inner / 2, -d / 2, z}, wood));
  }
  return shelf;
}

double ShelfBoard_m(const Eigen::Vector3d& size, int boards, int index) {
  return Rounded(0.08 + (size.z() - 0.08) * index / boards);
}

Item MakeShelfBooks(const Eigen::Vector3d& size, int boards, Random& random) {
  Item books;
  books.footprint = size.head<2>();
  const double room_m = (size.z() - 0.08) / boards - 0.03;
  for (int i = 0; i < boards; ++i) {
    double x = -size.x() / 2 + 0.03 + DrawLength(random, 0, 0.15);
    const double end = size.x() / 2 - 0.03 - DrawLength(random, 0, 0.25);
    while (true) {
      const double thickness = DrawLength(random, .02, .055);
      const double depth = DrawLength(random, .14, std::min(.20, size.y() - .04));
      const double height = DrawLength(random, .18, std::min(.30, room_m));
      if (x + thickness > end) break;
      Part book =
          BoxPart("book", {thickness, depth, height}, Rounded(x + thickness / 2),
                  Rounded(size.y() / 2 - 0.021 - depth / 2), ShelfBoard_m(size, boards, i));
      Dress(book.object, random);
      book.object.faces[static_cast<std::size_t>(Face::kMinusY)] =
          DrawMaterial(Print::kCover, random);
      books.parts.push_back(book);
      x += thickness + 0.0005;
    }
  }
  return books;
}

}  // namespace sim

#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/families/items.h"

/// Rooms and tables with things on them, for the families that need more than one desk.
namespace sim {

struct Table {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double width = 1.4, depth = 0.7, top_z = 0.72;  ///< metres, width along x
  bool turned = false;                            ///< its user sits at +y, not at -y
};

/// At the origin, of drawn size and the height of an office desk.
Table DrawTable(Random& random, const std::array<double, 2>& widths_m,
                const std::array<double, 2>& depths_m);

/// Top and two sides, detected as one dining table.
void PutTable(const std::string& name, const Table& table, const Material& material,
              Scene& scene);

/// Floor, and four walls of 2.5 m round the rectangle; `print` is that of the walls.
void PutRoom(const Eigen::Vector2d& low, const Eigen::Vector2d& high, Print print,
             Random& random, Scene& scene);

/// A thing with its zone as parts of the table's depth (-0.5 is the user's edge).
struct Wish {
  Item item;
  double low_part = -0.5, high_part = 0.5;
  double max_yaw_deg = 180;
};

/// `count` things of the whole catalogue, largest first: screen, laptop and keyboard from 3 on,
/// books in stacks as two or three of them.
std::vector<Wish> DrawClutter(int count, Random& random);

/// Puts all of them on the table with a margin of 12 mm, or none and says false.
bool FillTable(const std::vector<Wish>& wishes, const Table& table, Random& random,
               Scene& scene);

/// Draws and places until it fits; fewer things when the table is too small for `count`.
/// @param key  names the random stream
void PutClutter(int count, const Table& table, std::initializer_list<std::uint64_t> key,
                Scene& scene);

/// Multiplies the richness of every print by `dial`, 0 none to 1 as it is.
void DialTexture(double dial, Scene& scene);

}  // namespace sim

#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "sim/base/random.h"
#include "sim/families/materials.h"
#include "sim/scene/scene.h"

/// What the families are cooked from; for the sources of this folder alone.
namespace sim {

/// Values of a family's parameters, complete and within their ranges.
using ParameterValues = std::map<std::string, double>;

Scene MakeDesk(std::uint64_t seed, const ParameterValues& values);
Scene MakePlates(std::uint64_t seed, const ParameterValues& values);
Scene MakeStack(std::uint64_t seed, const ParameterValues& values);
Scene MakeCoplanar(std::uint64_t seed, const ParameterValues& values);
Scene MakeTilted(std::uint64_t seed, const ParameterValues& values);
Scene MakeBoards(std::uint64_t seed, const ParameterValues& values);
Scene MakeTwins(std::uint64_t seed, const ParameterValues& values);
Scene MakeRevisit(std::uint64_t seed, const ParameterValues& values);
Scene MakeOffice(std::uint64_t seed, const ParameterValues& values);
Scene MakeRoomFamily(std::uint64_t seed, const ParameterValues& values);
Scene MakeCabinetFamily(std::uint64_t seed, const ParameterValues& values);
Scene MakePasser(std::uint64_t seed, const ParameterValues& values);
Scene MakeWall(std::uint64_t seed, const ParameterValues& values);
/// A larger desk with 15 to 40 things of the whole catalogue.
Scene MakeCrowdedDesk(std::uint64_t seed, int count);

/// Turns on `count` lights: bulbs in the shades of desk lamps, as far as there are such, then
/// panels that hang over the target.
void PutLights(int count, std::uint64_t seed, Scene& scene);

/// To the micrometre (or 1e-6 of any unit), so that scene files stay legible.
double Rounded(double number);

/// A length drawn from [low, high], to 0.1 mm.
double DrawLength(Random& random, double low_m, double high_m);

/// A solid of a thing that is put together before it is placed. `object.center_w` is in the
/// frame of the thing: x right, y away from the user, z up, origin on the surface it will stand
/// on.
struct Part {
  Object object;
  Eigen::Vector3d rpy_deg = Eigen::Vector3d::Zero();
};

/// A thing: solids and the rectangle (metres, centred at the origin) that it needs.
struct Item {
  std::vector<Part> parts;
  Eigen::Vector2d footprint = Eigen::Vector2d::Zero();
  bool one_detection = false;  ///< its parts are detected as one
};

/// A box that stands at height `bottom_z` with its centre over (x, y) of the thing.
Part BoxPart(const std::string& class_name, const Eigen::Vector3d& size, double x, double y,
             double bottom_z);

/// Where a thing stands: centre of the footprint, world, and its turn about z.
struct Place {
  double x = 0, y = 0, z = 0, yaw_deg = 0;
};

/// Adds the parts to the scene with the next ids, names "<class>_<number>" and, when the thing
/// is detected as one, a detection group of its own.
void Put(const Item& item, const Place& place, Scene& scene);

/// The first detection group that no object of the scene is in.
int NextGroup(const Scene& scene);

/// What the scene's next object begins with: id, name, class and role.
Object NextObject(const Scene& scene, const std::string& name, const std::string& class_name,
                  Role role);

/// A structure box (floor, wall, desk) with one material all over.
void PutStructure(const std::string& name, const std::string& class_name,
                  const Eigen::Vector3d& size, const Eigen::Vector3d& center_w,
                  const Material& material, Scene& scene);

}  // namespace sim

#include "sim/scene/check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "io/number_text.h"
#include "sim/scene/geometry.h"

namespace sim {
namespace {

std::string Millimetres(double length_m) {
  return io::NumberText(std::round(length_m * 1e4) / 10) + " mm";
}

/// Heights that it reaches: of a mesh its own, for those of a turned box may be far beyond.
struct Reach {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

Reach ReachOf(const Object& object) {
  Reach reach;
  const auto take = [&reach](const Eigen::Vector3d& x_w) {
    reach.low = std::min(x_w.z(), reach.low);
    reach.high = std::max(x_w.z(), reach.high);
  };
  if (object.shape == ShapeKind::kMesh) {
    const Pose T_wo = ObjectPose(object);
    for (const Eigen::Vector3d& x_o : object.model->vertices_o) take(T_wo * x_o);
  } else {
    for (const Eigen::Vector3d& corner : Corners(object)) take(corner);
  }
  return reach;
}

/// How deep the corners of a mesh are in the other's box. Its own box says little: a mesh may
/// be hollow, or stand round the other.
double DepthOfCorners(const Object& mesh, const Object& other) {
  double depth = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& x_o : mesh.model->vertices_o) {
    depth = std::max(depth, -DistanceToBox(other, ObjectPose(mesh) * x_o));
  }
  return depth;
}

double DepthInside(const Object& a, const Object& b) {
  double depth = OverlapDepth(a, b);
  if (depth <= kTouch_m) return depth;
  if (a.shape == ShapeKind::kMesh) depth = std::min(depth, DepthOfCorners(a, b));
  if (b.shape == ShapeKind::kMesh) depth = std::min(depth, DepthOfCorners(b, a));
  return depth;
}

std::optional<std::string> RepeatedName(const Scene& scene, std::size_t i) {
  const Object& object = scene.objects[i];
  for (std::size_t j = 0; j < i; ++j) {
    const Object& earlier = scene.objects[j];
    if (earlier.id == object.id) {
      return "id " + std::to_string(object.id) + " belongs to '" + earlier.name +
             "' already; give each object its own";
    }
    if (earlier.name == object.name) {
      return "name '" + object.name + "' is taken already; give each object its own";
    }
  }
  return std::nullopt;
}

/// What moves must stay clear of what stands, and over the floor, all along its way. Two that
/// move may meet.
std::optional<std::string> FaultOfWay(const Scene& scene, std::size_t i, double floor_z) {
  constexpr double kStep_m = 0.02;
  const Object& moving = scene.objects[i];
  if (moving.way.empty()) return std::nullopt;
  for (const double time_s : MomentsOf(moving, kStep_m)) {
    const Object there = ObjectAt(moving, time_s);
    const std::string when = " at " + io::NumberText(std::round(time_s * 100) / 100) + " s";
    if (!(floor_z - ReachOf(there).low <= kTouch_m)) {
      return "'" + moving.name + "' is below the floor" + when + "; raise its way";
    }
    for (const Object& other : scene.objects) {
      if (!other.way.empty() || &other == &moving) continue;
      const double reach = (there.size.norm() + other.size.norm()) / 2;
      if ((there.center_w - other.center_w).squaredNorm() > reach * reach) continue;
      const double depth = DepthInside(there, other);
      if (depth <= kTouch_m) continue;
      return "'" + moving.name + "' is " + Millimetres(depth) + " inside '" + other.name + "'" +
             when + "; move its way";
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<SceneFault> FindFault(const Scene& scene) {
  std::optional<double> lowest_floor;
  for (const Object& object : scene.objects) {
    if (object.class_name != "floor") continue;
    const double top_z = ReachOf(object).high;
    lowest_floor = std::min(top_z, lowest_floor.value_or(top_z));
  }
  const double floor_z = lowest_floor.value_or(0);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    if (const auto repeated = RepeatedName(scene, i)) return SceneFault{i, *repeated};
    if (const auto fault = FaultOfWay(scene, i, floor_z)) return SceneFault{i, *fault};
    if (!object.way.empty()) continue;
    const double below = floor_z - ReachOf(object).low;
    if (object.class_name != "floor" && !(below <= kTouch_m)) {
      return SceneFault{i, "'" + object.name + "' reaches " + Millimetres(below) +
                               " below the floor; raise center_m"};
    }
    for (std::size_t j = 0; j < i; ++j) {
      const Object& other = scene.objects[j];
      if (!other.way.empty()) continue;  // it looks at the others itself
      const double reach = (object.size.norm() + other.size.norm()) / 2;
      if ((object.center_w - other.center_w).squaredNorm() > reach * reach) continue;
      const double depth = DepthInside(object, other);
      if (depth <= kTouch_m) continue;
      return SceneFault{i, "'" + object.name + "' and '" + other.name + "' are " +
                               Millimetres(depth) + " inside each other; move one apart"};
    }
  }
  return std::nullopt;
}

}  // namespace sim

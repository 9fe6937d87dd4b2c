#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

#include "io/input_error.h"
#include "property_tests/generators/scenes.h"
#include "sim/motion/trajectory.h"
#include "sim/scene/geometry.h"
#include "sim/scene/names.h"
#include "sim/shapes/mesh.h"

namespace sim {
namespace {

/// What is drawn of one object, in its own frame. The motion generator knows only boxes; these
/// are the very triangles that rays meet.
struct Skin {
  struct Flat {
    Eigen::Vector3d a, b, c, middle;
    double radius_m;
  };
  std::vector<Flat> flats;
};

/// Nearest point of a triangle (Ericson, Real-Time Collision Detection, 5.1.5).
double DistanceTo(const Skin::Flat& t, const Eigen::Vector3d& p) {
  const Eigen::Vector3d ab = t.b - t.a, ac = t.c - t.a, ap = p - t.a, bp = p - t.b,
                        cp = p - t.c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp),
               d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d1 <= 0 && d2 <= 0) return ap.norm();
  if (d3 >= 0 && d4 <= d3) return bp.norm();
  if (d6 >= 0 && d5 <= d6) return cp.norm();
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return (ap - ab * (d1 / (d1 - d3))).norm();
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return (ap - ac * (d2 / (d2 - d6))).norm();
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double part = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return (bp - (t.c - t.b) * part).norm();
  }
  return std::abs(ab.cross(ac).normalized().dot(ap));
}

double Distance(const Skin& skin, const Eigen::Vector3d& p, double no_more_than) {
  double nearest = no_more_than;
  for (const Skin::Flat& flat : skin.flats) {
    if ((p - flat.middle).norm() - flat.radius_m < nearest) {
      nearest = std::min(nearest, DistanceTo(flat, p));
    }
  }
  return nearest;
}

/// How often the skin goes round a point: 0 outside of it, 1 inside (van Oosterom and Strackee
/// 1983, the solid angle of a triangle).
double TimesRound(const Skin& skin, const Eigen::Vector3d& p) {
  double sum = 0;
  for (const Skin::Flat& flat : skin.flats) {
    const Eigen::Vector3d a = flat.a - p, b = flat.b - p, c = flat.c - p;
    const double na = a.norm(), nb = b.norm(), nc = c.norm();
    sum += std::atan2(a.dot(b.cross(c)),
                      na * nb * nc + a.dot(b) * nc + b.dot(c) * na + c.dot(a) * nb);
  }
  return sum / (2 * std::numbers::pi);
}

std::map<int, Skin> SkinsOf(const Scene& scene) {
  std::map<int, const Object*> objects;
  for (const Object& object : scene.objects) objects[object.id] = &object;
  std::map<int, Skin> skins;
  for (const Triangle& triangle : BuildMesh(scene).triangles) {
    const Object& object = *objects.at(triangle.object);
    const Object still = object.way.empty() ? object : ObjectAt(object, object.way[0].time_s);
    std::array<Eigen::Vector3d, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = still.q_wo.conjugate() * (triangle.corners_w[i] - still.center_w);
    }
    const Eigen::Vector3d middle = (corners[0] + corners[1] + corners[2]) / 3;
    double radius_m = 0;
    for (const Eigen::Vector3d& corner : corners) {
      radius_m = std::max(radius_m, (corner - middle).norm());
    }
    skins[triangle.object].flats.push_back(
        {corners[0], corners[1], corners[2], middle, radius_m});
  }
  return skins;
}

/// Any preset; every other time as near to everything as the motion block can ask for.
Motion AnyMotion(Motion motion) {
  const auto last = static_cast<int>(kPresetNames.size()) - 1;
  if (AnyInt(0, 1) == 1) {
    motion.preset = kPresetNames[static_cast<std::size_t>(AnyInt(0, last))];
  }
  if (AnyInt(0, 1) == 1) {
    motion.distance_min_m = 0.2;
    motion.distance_max_m = DrawReal(0.25, 0.8);
    motion.target_spread_m = DrawReal(0.1, 0.8);
    motion.azimuth_min_rad = -3.1;
    motion.azimuth_max_rad = 3.1;
    motion.pitch_min_rad = DrawReal(-0.3, 0.3);
    motion.pitch_max_rad = DrawReal(0.4, 0.9);
  }
  return motion;
}

/// A box that goes past what the camera looks at, or through it.
Object PassingBox(const Motion& motion, int id) {
  Object box = DrawBox(id);
  const double start_deg = DrawReal(0, 360), side_m = DrawReal(-0.8, 0.8);
  const SinCos start = SinCosDeg(start_deg);
  const Eigen::Vector3d along(start.cos, start.sin, 0), across(-start.sin, start.cos, 0);
  const Eigen::Vector3d middle_w = motion.target_w + side_m * across;
  box.way = {{0, middle_w - 2 * along, 0}, {20, middle_w + 2 * along, 90}};
  box.center_w = box.way[0].center_w;
  return box;
}

RC_GTEST_PROP(MakeTrajectory, StaysOutsideAndClearOfWhatIsDrawnInAnyFamilyWithAnyPreset, ()) {
  constexpr double kClear_m = 0.15, kRoundOff_m = 1e-9;
  const SceneRecipe recipe = DrawAnyRecipe();
  const auto seed = static_cast<std::uint64_t>(AnyInt(0, 100000));
  Scene scene;
  std::vector<TimedPose> trajectory;
  try {
    scene = recipe.Make();
    scene.motion = AnyMotion(scene.motion);
    if (AnyInt(0, 3) == 0) scene.objects.push_back(PassingBox(scene.motion, 1000));
    RC_LOG() << recipe.Command() << ", preset " << scene.motion.preset << ", seed " << seed;
    trajectory = MakeTrajectory(scene, 45, 3, seed);
  } catch (const io::InputError&) {
    RC_DISCARD("so much does not fit, or leaves the camera no such way");
  }
  const std::map<int, Skin> skins = SkinsOf(scene);
  for (const TimedPose& pose : trajectory) {
    for (const Object& given : scene.objects) {
      const Object object = ObjectAt(given, pose.timestamp_s);
      const Eigen::Vector3d p = object.q_wo.conjugate() * (pose.T_wc.t - object.center_w);
      const Skin& skin = skins.at(object.id);
      const bool clear = Distance(skin, p, 2 * kClear_m) >= kClear_m - kRoundOff_m;
      // From the first pose on it would have to come through the skin.
      const bool outside = &pose != &trajectory.front() || TimesRound(skin, p) < 0.5;
      if (clear && outside) continue;
      RC_FAIL(object.name + " at " + std::to_string(pose.timestamp_s) + " s");
    }
  }
}

}  // namespace
}  // namespace sim

#pragma once

#include <vector>

#include "slam/base/random.h"
#include "slam/geometry/camera.h"
#include "slam/geometry/sensor_model.h"
#include "slam/mapping/keyframes.h"
#include "slam/mapping/map_points.h"
#include "slam/model/map.h"

namespace slam {

inline Descriptor AnyDescriptor(Random& random) {
  Descriptor descriptor;
  for (auto& byte : descriptor) byte = static_cast<std::uint8_t>(random.Below(256));
  return descriptor;
}

/// Exact feature of a world point; octave 0, angle 0.
inline PointFeature FeatureOfPoint(const Eigen::Vector3d& p_w, const Pose& T_cw,
                                   const Camera& camera, const Descriptor& descriptor,
                                   bool with_depth) {
  const Eigen::Vector3d p_c = T_cw * p_w;
  PointFeature feature;
  feature.u_px = camera.Project(p_c);
  feature.descriptor = descriptor;
  if (with_depth) {
    feature.depth_m = p_c.z();
    feature.depth_sigma_m = SensorModel{}.DepthSigma_m(p_c.z());
  }
  return feature;
}

/// A map without error: points in a box 1 to 3 m away, keyframes side by side, every point seen
/// by every keyframe that has it in its image.
struct PointWorld {
  Camera camera;
  Map map;
};

/// @param depth_every every such point has depth (1: all)
inline PointWorld MakePointWorld(int keyframes, int points, std::uint64_t seed,
                                 int depth_every = 1) {
  PointWorld world;
  Random random{seed, 77};
  std::vector<Eigen::Vector3d> positions_w;
  std::vector<Descriptor> descriptors;
  for (int i = 0; i < points; ++i) {
    positions_w.emplace_back(2.0 * random.Uniform() - 1.0, 1.6 * random.Uniform() - 0.8,
                             1.0 + 2.0 * random.Uniform());
    descriptors.push_back(AnyDescriptor(random));
  }
  std::vector<int> ids(positions_w.size(), kNone);
  for (int k = 0; k < keyframes; ++k) {
    Keyframe keyframe;
    keyframe.id = k;
    keyframe.frame_index = 10 * k;
    keyframe.T_cw = Inverse(
        Pose{ExpSo3({0.01 * k, -0.02 * k, 0.015 * k}), {0.08 * k, 0.03 * (k % 3), 0.02 * k}});
    std::vector<int> seen;
    for (int i = 0; i < points; ++i) {
      const Eigen::Vector3d& p_w = positions_w[static_cast<std::size_t>(i)];
      const Eigen::Vector3d p_c = keyframe.T_cw * p_w;
      if (!(p_c.z() > 0.1) || !world.camera.ImageBox().Contains(world.camera.Project(p_c))) {
        continue;
      }
      keyframe.features.push_back(FeatureOfPoint(p_w, keyframe.T_cw, world.camera,
                                                 descriptors[static_cast<std::size_t>(i)],
                                                 i % depth_every == 0));
      seen.push_back(i);
    }
    keyframe.map_points.assign(keyframe.features.size(), kNone);
    world.map.keyframes.push_back(keyframe);
    for (int f = 0; f < static_cast<int>(seen.size()); ++f) {
      int& id = ids[static_cast<std::size_t>(seen[static_cast<std::size_t>(f)])];
      if (id == kNone) {
        id = AddPoint(world.map,
                      positions_w[static_cast<std::size_t>(seen[static_cast<std::size_t>(f)])],
                      k, f, {});
      } else {
        AddObservation(world.map, id, k, f);
      }
    }
  }
  for (const MapPoint& point : world.map.points) UpdatePoint(world.map, point.id, {});
  for (int k = 0; k < keyframes; ++k) UpdateCovisibility(world.map, k, {});
  return world;
}

/// The point that a test takes for the n-th observation of a keyframe.
inline int PointAt(const Map& map, int keyframe, int n) {
  for (const int point : map.keyframes.at(static_cast<std::size_t>(keyframe)).map_points) {
    if (point != kNone && n-- == 0) return point;
  }
  return kNone;
}

}  // namespace slam

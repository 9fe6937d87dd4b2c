#pragma once

#include <cmath>
#include <vector>

#include "slam/places/train_vocabulary.h"
#include "tests/support/point_world.h"

namespace slam {

/// A camera that walks a circle and looks outwards at points all around, mapped with an error
/// that grows: where it comes back to its start, the map has drifted away from itself.
struct RingWorld {
  Camera camera;
  Map map;                  ///< as drifted
  std::vector<Pose> truth;  ///< T_cw of the keyframes
  Vocabulary vocabulary;
};

struct RingShape {
  int keyframes = 40;
  int points = 2500;
  double drift_m = 0.004, drift_rad = 0.001;  ///< a keyframe
  int alike = 1;                              ///< so many parts of the ring look the same
};

inline RingWorld MakeRingWorld(const RingShape& shape = {}) {
  Random random{3, 5};
  std::vector<Eigen::Vector3d> things_w;
  std::vector<Descriptor> looks;
  for (int i = 0; i < shape.points / shape.alike; ++i) {
    const double angle = 2 * M_PI * random.Uniform() / shape.alike;
    const double radius = 2.5 + random.Uniform(), height = 2.4 * random.Uniform() - 1.2;
    const Descriptor look = AnyDescriptor(random);
    for (int part = 0; part < shape.alike; ++part) {
      const double a = angle + 2 * M_PI * part / shape.alike;
      things_w.emplace_back(radius * std::cos(a), height, radius * std::sin(a));
      looks.push_back(look);
    }
  }
  Map map;
  std::vector<Pose> truth;
  const Camera camera;
  Pose T_estimated_true;  // where what is mapped now is thought to be
  Pose T_first_wc;
  std::vector<int> ids(things_w.size(), kNone), last_seen(things_w.size(), -1000);
  for (int k = 0; k < shape.keyframes; ++k) {
    // One step short of a full turn: the last keyframe sees what the first one did.
    const double a = 2 * M_PI * k / shape.keyframes;
    Eigen::Matrix3d R_wc;  // z outwards, y down
    R_wc.col(2) = Eigen::Vector3d(std::cos(a), 0, std::sin(a));
    R_wc.col(1) = Eigen::Vector3d::UnitY();
    R_wc.col(0) = R_wc.col(1).cross(R_wc.col(2));
    const Pose T_wc{R_wc, R_wc.col(2)};
    if (k == 0) T_first_wc = T_wc;
    truth.push_back(Inverse(T_wc) * T_first_wc);  // the world is the first camera
    if (k > 0) {
      Vector6d drift;
      drift << shape.drift_m, 0.5 * shape.drift_m, 0, 0, shape.drift_rad, 0;
      T_estimated_true = T_estimated_true * Exp(drift);
    }
    Keyframe keyframe;
    keyframe.id = k;
    keyframe.frame_index = 10 * k;
    keyframe.T_cw = truth.back() * Inverse(T_estimated_true);
    std::vector<std::size_t> seen;
    for (std::size_t i = 0; i < things_w.size(); ++i) {
      const Eigen::Vector3d p_w = Inverse(T_first_wc) * things_w[i];
      const Eigen::Vector3d p_c = truth.back() * p_w;
      if (!(p_c.z() > 0.3) || !camera.ImageBox().Contains(camera.Project(p_c))) continue;
      keyframe.features.push_back(FeatureOfPoint(p_w, truth.back(), camera, looks[i], true));
      seen.push_back(i);
    }
    keyframe.map_points.assign(keyframe.features.size(), kNone);
    map.keyframes.push_back(keyframe);
    for (std::size_t f = 0; f < seen.size(); ++f) {
      const std::size_t i = seen[f];
      const bool forgotten = k - last_seen[i] > 6;
      last_seen[i] = k;
      if (ids[i] == kNone || forgotten) {
        ids[i] = AddPoint(map, T_estimated_true * (Inverse(T_first_wc) * things_w[i]), k,
                          static_cast<int>(f), {});
      } else {
        AddObservation(map, ids[i], k, static_cast<int>(f));
      }
    }
  }
  for (const MapPoint& point : map.points) UpdatePoint(map, point.id, {});
  for (int k = 0; k < shape.keyframes; ++k) UpdateCovisibility(map, k, {});
  std::vector<std::vector<Descriptor>> images;
  for (const Keyframe& keyframe : map.keyframes) {
    images.emplace_back();
    for (const PointFeature& feature : keyframe.features) {
      images.back().push_back(feature.descriptor);
    }
  }
  return {camera, map, truth,
          TrainVocabulary(images, {.branching = 8, .depth = 3, .min_members = 2})};
}

}  // namespace slam

#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "slam/mapping/plane_update.h"
#include "slam/model/map.h"
#include "tests/support/map_surfaces.h"
#include "tests/support/plane_world.h"
#include "tests/support/small_images.h"

namespace slam {

/// Shows a map two patches side by side, one of them higher, as if association took both for its
/// first landmark until that is split.
struct TwoPatches {
  static constexpr int kLarger = 0, kLesser = 1;  ///< in the world

  double height_m = 0.008;                ///< of the lesser patch
  double larger_m = 0.4, lesser_m = 0.2;  ///< widths, along x on either side of 0
  bool shows_step = true;                 ///< frames tell of a step
  double told_step_m = 0.0;               ///< that they tell of; 0: the true one
  double bend_ratio = 0.0;                ///< of the sensor
  bool reverse = false;                   ///< the order of the frame's planes
  bool told_of_larger = false;            ///< the step is the larger patch's height

  Map map;
  Frame frame;  ///< the last one
  std::vector<int> truth;
  int frames = 0;

  std::size_t IndexOf(int patch) const {
    return static_cast<std::size_t>(std::find(truth.begin(), truth.end(), patch) -
                                    truth.begin());
  }

  void Next() {
    PlaneWorld world;
    world.Add({-larger_m / 2, 0, 0}, {larger_m / 2, 0, 0}, {0, 0.3, 0}, "");
    world.Add({lesser_m / 2, 0, height_m}, {lesser_m / 2, 0, 0}, {0, 0.3, 0}, "");
    const double a = 0.08 * frames;
    const Pose T_cw = LookAt({0.3 * std::sin(a), -0.7 + 0.05 * std::cos(a), 0.7}, {0, 0, 0});
    SeenWorld seen = See(world, T_cw, SmallCamera(), {}, Random{1});
    if (reverse) Reverse(seen);
    frame = std::move(seen.frame);
    truth = std::move(seen.truth);
    frame.index = frames;
    frame.timestamp_s = 0.1 * frames++;
    frame.bend_ratio = bend_ratio;
    for (FramePlane& plane : frame.planes) {
      plane.bend_offset_sigma_m = bend_ratio * plane.centroid_c.z();
      plane.bend_angle_sigma_rad = 10 * bend_ratio;
    }
    Match();
    UpdatePlanes(frame, map, SmallCamera(), {}, SmallImages());
  }

 private:
  void Match() {
    frame.plane_matches.assign(frame.planes.size(), {});
    const auto landmarks = Landmarks(map);
    for (std::size_t f = 0; f < frame.planes.size(); ++f) {
      PlaneMatch& match = frame.plane_matches[f];
      if (landmarks.empty()) {
        // The larger patch makes the landmark.
        if (truth[f] != kLarger) match.reason = MatchReason::kAmbiguous;
        continue;
      }
      const MapPlane& shown = truth[f] == kLarger ? *landmarks.front() : *landmarks.back();
      match = {PlaneDecision::kMatched, shown.id, MatchReason::kParameters};
    }
    if (!shows_step || frame.planes.size() != 2) return;
    const double step_m = told_step_m != 0 ? told_step_m : height_m;
    const int lesser = static_cast<int>(IndexOf(kLesser));
    const FrameStep of_lesser{lesser, 1 - lesser, step_m, 0.0005};
    const FrameStep of_larger{1 - lesser, lesser, -step_m, 0.0005};
    frame.plane_steps = {told_of_larger ? of_larger : of_lesser};
  }

  static void Reverse(SeenWorld& seen) {
    const int count = static_cast<int>(seen.frame.planes.size());
    std::reverse(seen.frame.planes.begin(), seen.frame.planes.end());
    std::reverse(seen.truth.begin(), seen.truth.end());
    for (int f = 0; f < count; ++f) seen.frame.planes[static_cast<std::size_t>(f)].index = f;
    for (unsigned char& label : seen.frame.plane_labels) {
      if (label > 0) label = static_cast<unsigned char>(count + 1 - label);
    }
  }
};

}  // namespace slam

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <opencv2/core/matx.hpp>
#include <vector>

#include "sim/base/pose.h"
#include "sim/scene/scene.h"
#include "sim/trace/ray_scene.h"

namespace sim {

/// Eight places on surfaces, in the frame of the world that is traced.
struct Spots {
  std::array<bool, RayPacket::kLanes> used{};
  std::array<Eigen::Vector3d, RayPacket::kLanes> x_w;  ///< on the surface
  std::array<Eigen::Vector3d, RayPacket::kLanes> n_w;  ///< normal of the surface itself, unit
  std::array<Eigen::Vector3d, RayPacket::kLanes>
      shading_n_w;  ///< normal of what it stands for, unit
};

/// What a scene's lights give at eight places.
struct LightAtSpots {
  std::array<cv::Vec3f, RayPacket::kLanes> light;  ///< linear RGB, beside the sun's
  /// Bit k: light k is seen, of an area half of it or more.
  std::array<std::uint32_t, RayPacket::kLanes> seen{};
};

/// The points that a scene's lights shine from, where a view's world is. What the light is in
/// double, what is in its way by rays.
class LightPoints {
 public:
  /// @param T_sw  from the frame that is traced to that of the lights
  void Start(const std::vector<Light>& lights, const Pose& T_sw);
  bool Empty() const { return lights_.empty(); }

  /// @param blocked  of a RayPacket, by lane: whether something is between near and far
  template <typename Blocked>
  LightAtSpots At(const Spots& spots, const Blocked& blocked) const {
    LightAtSpots out;
    out.light.fill(cv::Vec3f(0, 0, 0));
    for (std::size_t k = 0; k < lights_.size(); ++k) {
      Sum sum;
      for (std::size_t point = lights_[k].first; point < lights_[k].last; ++point) {
        Ways ways;
        if (!FindWays(lights_[k], points_w_[point], spots, ways)) continue;
        sum.Add(ways, blocked(ways.rays));
      }
      Add(k, sum, out);
    }
    return out;
  }

 private:
  struct Shining {
    std::size_t first = 0, last = 0;  ///< places in points_w_
    bool one_sided = false;
    Eigen::Vector3d front_w = Eigen::Vector3d::Zero();
    double intensity = 0;  ///< one point's
    cv::Vec3f colour;
  };
  /// From eight places to one point.
  struct Ways {
    RayPacket rays;
    std::array<double, RayPacket::kLanes> gain{};  ///< light of a unit of intensity; 0 behind
  };
  struct Sum {
    std::array<double, RayPacket::kLanes> gain{};
    std::array<std::size_t, RayPacket::kLanes> seen{};
    void Add(const Ways& ways, const std::array<bool, RayPacket::kLanes>& blocked);
  };

  void AddPoints(const Light& light, const Pose& T_ws);
  static bool FindWays(const Shining& light, const Eigen::Vector3d& point_w, const Spots& spots,
                       Ways& ways);
  void Add(std::size_t k, const Sum& sum, LightAtSpots& out) const;

  std::vector<Shining> lights_;
  std::vector<Eigen::Vector3d> points_w_;
};

}  // namespace sim

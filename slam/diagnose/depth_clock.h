#pragma once

#include <Eigen/Core>
#include <deque>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "slam/geometry/camera.h"
#include "slam/geometry/pose.h"
#include "slam/model/frame.h"

namespace slam {

/// Whether the depth of a frame was taken when its colour was. Poses by pixels are colour's; how depth
/// changes between two frames says how the depth camera moved meanwhile. The two motions
/// are laid over each other with every shift up to a second. It says nothing of cameras with
/// fewer than ten frames a second.
///
/// The inverse depth of a tile that is a plane m (m . x = 1) is q = m . r along the ray r, and
/// under the motion X2 = exp(v, omega) X1 it changes by omega . (m x r) - q m . v. A pair of
/// frames is kept as the normal equations of that. Inverse depth, as noise hardly depends on
/// the distance then.
class DepthClock {
 public:
  explicit DepthClock(const Camera& camera);

  /// Takes in the next frame, in the order of time: its depth as measured, at the time that its stamp
  /// says, and its pose by pixels, if it has one, at the time of its colour.
  void Observe(const Frame& frame);

  /// By how much later than its stamp says depth was taken: seconds, negative: earlier, at most a
  /// second. None when the motion does not say surely that it is not 0.
  std::optional<double> Late_s() const;

  /// What to tell when that is more than pairing by time stamps leaves; empty otherwise.
  std::vector<std::string> Warnings() const;

 private:
  struct Tile {
    Eigen::Vector3d m = Eigen::Vector3d::Zero();  ///< plane m . x = 1, 1/metre; zero: none
    double q = 0.0;                               ///< inverse depth at the centre, 1/metre
  };
  struct Seen {
    double s = 0.0;
    std::vector<Tile> tiles;
  };
  struct TimedPose {
    double s = 0.0;
    Pose T_cw;
  };
  /// From one frame to a later one: cost(xi) = xi' H xi - 2 xi' g + c.
  struct Change {
    double from_s = 0.0, to_s = 0.0;
    Matrix6d H = Matrix6d::Zero();
    Vector6d g = Vector6d::Zero();
    double c = 0.0;
    int tiles = 0;
  };
  /// Sums for one shift over the changes for which poses are known so shifted.
  struct Shift {
    double cost = 0.0;
    /// Sums of gain = (unshifted cost - cost) / (unshifted cost + cost), in which all changes
    /// weigh alike, and of its square.
    double gains = 0.0, squared_gains = 0.0;
    int changes = 0;
  };
  using Shifts = std::vector<Shift>;

  Eigen::Vector3d Ray(int u, int v) const;
  Eigen::Vector3d Middle(const cv::Rect& area) const;
  Tile Fit(const cv::Mat1f& depth_m, const cv::Rect& area) const;
  std::vector<Tile> Tiles(const cv::Mat1f& depth_m) const;
  Change Between(const Seen& from, const Seen& to) const;
  std::optional<Pose> PoseAt(double s) const;
  std::optional<double> Cost(const Change& change, double late_s) const;
  void Add(const Change& change, Shifts& shifts) const;
  static double Lowest(const Shifts& shifts, std::size_t at);

  cv::Mat2d rays_;
  std::vector<cv::Rect> areas_;  ///< the tiles
  std::deque<Seen> seen_;        ///< the last few frames
  std::deque<TimedPose> poses_;  ///< those of the last seconds
  std::deque<Change> changes_;   ///< those that may yet meet a pose
  Shifts shifts_;
};

}  // namespace slam

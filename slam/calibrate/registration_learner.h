#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "slam/calibrate/depth_edges.h"
#include "slam/calibrate/registration_config.h"
#include "slam/geometry/camera.h"
#include "slam/geometry/pose.h"
#include "slam/model/frame.h"

namespace slam {

/// How depth lies in the colour image.
struct RegistrationEstimate {
  Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();  ///< colour shows it so much further on
  Eigen::Vector2d sigma_px = Eigen::Vector2d::Zero();  ///< standard deviation of that
  bool clear = false;     ///< no other shift explains nearly as much, along neither axis
  double grown_px = 0.0;  ///< near things are wider in depth by this, on each side
  int epochs = 0;         ///< that it was measured in
  /// What is taken out of the shift, by axis: nothing when it is not clear or too small to matter.
  Eigen::Vector2d applied_px = Eigen::Vector2d::Zero();
};

/// Learns how far the depth of a recording lies beside its colour. Where a near thing ends in
/// depth, brightness mostly changes in colour, at a distance that all such edges share: it is
/// the shift at which the gradients of brightness add up to most. Depth sensors that match
/// windows make near things wider, which moves left and right edges apart and not aside, so
/// that is looked for, too. What the scene does (a frame around a screen, a shadow) is random
/// from edge to edge and from epoch to epoch; how much epochs scatter tells how well the shift
/// is known. What one side of things does in all of a scene (a rim along the tops of screens) tells of
/// a shift and of as much growth, along one axis alone: by how much the axes grow apart, the shift
/// may be off.
///
/// Deterministic. The idea is Levinson and Thrun's (RSS 2013), for laser scanners.
class RegistrationLearner {
 public:
  /// @param edge_growth_px  SensorModel::edge_growth_px, [0, 4]. Without a bound the end of one side
  ///                        and a rim inside the other would do for a shift
  RegistrationLearner(const Camera& camera, double edge_growth_px,
                      const RegistrationConfig& config);

  /// Learns from a tracked frame, if the camera has moved since the last that it learnt from.
  void Learn(const Frame& frame);

  /// What is known by now stays as it is, for a map that is made with it throughout.
  /// @pre there is an estimate
  void Hold() { held_ = true; }

  /// None before enough epochs.
  const std::optional<RegistrationEstimate>& estimate() const { return estimate_; }
  /// Turn from the colour camera to the depth camera, where it is known well enough; else the
  /// identity.
  const Eigen::Matrix3d& R_dc() const { return R_dc_; }

 private:
  static constexpr int kReach_px = 10;  ///< of the gradients that are looked at, either way
  static constexpr std::size_t kSamples = 2 * kReach_px + 1;
  /// Gradients around the edges of one side, summed by their distance from the edge.
  struct Profile {
    std::array<double, kSamples> sum{};
    int edges = 0;
  };
  using Profiles = std::array<Profile, kNearSides>;
  struct Peak {
    Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();
    double grown_px = 0.0;
    double torn_px = 0.0;  ///< the growth that one axis alone would have, less the other's
    /// How many times more of the gradients it explains than any shift that is not beside it.
    Eigen::Vector2d lead = Eigen::Vector2d::Zero();
  };
  class Explained;

  bool HasMoved(const Frame& frame) const;
  void AddEdge(const cv::Mat1f& gray, const DepthEdge& edge, NearSide side, const Pose& T_cd);
  Peak FindPeak(const Profiles& profiles) const;
  void CloseEpoch();

  Camera camera_;
  cv::Mat2d rays_;
  int max_grown_;  ///< steps
  RegistrationConfig config_;
  Profiles epoch_, all_;
  std::vector<Eigen::Vector2d> shifts_px_;  ///< of each epoch
  std::optional<Pose> last_T_cw_;           ///< of the last frame that it learnt from
  std::optional<RegistrationEstimate> estimate_;
  bool held_ = false;
  Eigen::Matrix3d R_dc_ = Eigen::Matrix3d::Identity();
};

}  // namespace slam

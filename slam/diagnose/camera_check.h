#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "slam/diagnose/view_pair.h"
#include "slam/geometry/camera.h"
#include "slam/model/feature_scale.h"
#include "slam/model/frame.h"

namespace slam {

/// What the views say of the intrinsics.
struct CameraEstimate {
  Intrinsics found = Intrinsics::Zero();
  Intrinsics sigma = Intrinsics::Zero();  ///< larger when pairs disagree or share views
  std::array<bool, 4> wrong{};            ///< significantly and relevantly off; fx, fy, cx, cy
  std::size_t pairs = 0;
  double turn_rad = 0.0;  ///< rotation between the two views that are most apart

  bool AnyWrong() const { return wrong[0] || wrong[1] || wrong[2] || wrong[3]; }
};

/// Watches tracked frames for a camera whose focal length or principal point is not what the
/// user said. Tracking hides that: it fits a stretched scene to a stretched camera. Pairs of
/// views that the camera has turned between do not agree then (see ViewPair). Each pair is
/// looked at once, in under a millisecond; memory is bounded, about 1 MB; the map is not
/// touched. Until the camera has turned enough, and when pairs disagree for reasons of their
/// own, sigma is large and nothing is said.
class CameraCheck {
 public:
  CameraCheck(const Camera& given, const FeatureScale& scale);

  /// @param frame  tracked, with its matches
  /// @returns whether the camera was found wrong by this frame for the first time
  bool See(const Frame& frame);

  /// From all pairs kept, iterated; nullopt before there are enough.
  std::optional<CameraEstimate> Estimate();

  /// What is wrong, how much and how to mend it, or that later views took it back; empty when
  /// nothing was found wrong.
  std::string Warning();

 private:
  struct SeenPoint {
    int id;
    Eigen::Vector2d u_px;
    double z_m;
    int octave;
  };
  struct View {
    int frame;  ///< index
    Pose T_cw;
    Vector6d speed_per_s;           ///< d T_cw / dt = xi^ T_cw
    double taken_out_s;             ///< Readout::taken_out_s
    std::vector<SeenPoint> points;  ///< with depth, by id
  };
  struct Pair {
    int first_frame;  ///< of the earlier view
    double turn_rad;
    ViewPair views;
    IntrinsicsEvidence at_given;
  };

  void NoteSpeed(const Frame& frame);
  View ViewOf(const Frame& frame) const;
  std::vector<TwiceSeen> Common(const View& first, const View& second) const;
  bool Compare(const View& first, const View& second);
  double PairsAView() const;
  CameraEstimate Combine(const std::vector<IntrinsicsEvidence>& evidence,
                         const Intrinsics& at) const;
  bool FindsWrong(int frame_index);

  Intrinsics given_;
  Intrinsics min_error_;  ///< deviations up to it do not matter
  Intrinsics prior_sigma_;
  FeatureScale scale_;
  struct Moment {
    double s;
    Pose T_cw;
    bool view;  ///< became the latest of the views
  };
  std::optional<Moment> last_;
  std::optional<Vector6d> speed_per_s_;  ///< between the last two frames
  int height_px_;
  std::vector<View> views_;
  std::vector<Pair> pairs_;
  std::size_t compared_ = 0;       ///< pairs since the start
  std::size_t next_estimate_ = 0;  ///< no estimate before so many pairs
  std::optional<CameraEstimate> noticed_;
  int noticed_frame_ = 0;
};

}  // namespace slam

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

/// When intrinsics are called wrong, and what is looked at.
struct CameraCheckConfig {
  double sigmas = 6.0;            ///< deviation at least this many; domain (0, inf)
  double least_focal = 0.025;     ///< and this share of the focal length; domain (0, 1)
  double least_centre = 0.0125;   ///< or this share of the image's width; domain (0, 1)
  double turn_rad = 0.026;        ///< between views, 1.5 degrees; domain (0, pi)
  std::size_t least_common = 60;  ///< points that two views share; domain [30, inf)
  std::size_t most_points = 250;  ///< of a pair of views; domain [30, inf)
  std::size_t most_views = 12;    ///< kept for later ones; domain [1, inf)
  std::size_t least_pairs = 3;    ///< before anything is said; domain [2, inf)
  std::size_t most_pairs = 40;    ///< kept, those that turn most; domain [least_pairs, inf)
};

/// What the views say of the intrinsics.
struct CameraEstimate {
  Intrinsics found = Intrinsics::Zero();
  Intrinsics sigma = Intrinsics::Zero();  ///< with what the pairs disagree by
  std::array<bool, 4> wrong{};            ///< significantly and relevantly off; fx, fy, cx, cy
  std::size_t pairs = 0;
  double turn_rad = 0.0;  ///< between the views that are most apart

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
  CameraCheck(const Camera& given, const FeatureScale& scale, CameraCheckConfig config = {});

  /// @param frame  tracked, with its matches
  /// @returns whether the camera was found wrong by this frame for the first time
  bool See(const Frame& frame);

  /// From all pairs kept, iterated; nullopt before there are enough.
  std::optional<CameraEstimate> Estimate();

  /// What is wrong, how much and how to mend it; empty when nothing was found wrong.
  std::string Warning();

 private:
  struct SeenPoint {
    int id;
    Eigen::Vector2d u_px;
    double z_m;
    int octave;
  };
  struct View {
    Pose T_cw;
    Vector6d speed_per_s;           ///< of T_cw
    std::vector<SeenPoint> points;  ///< with depth, by id
  };
  struct Pair {
    double turn_rad;
    ViewPair views;
    IntrinsicsEvidence at_given;
  };

  void NoteSpeed(const Frame& frame);
  View ViewOf(const Frame& frame) const;
  std::vector<TwiceSeen> Common(const View& first, const View& second) const;
  bool Compare(const View& first, const View& second);
  CameraEstimate Combine(const std::vector<IntrinsicsEvidence>& evidence,
                         const Intrinsics& at) const;
  bool FindsWrong(int frame_index);

  Intrinsics given_, least_, prior_sigma_;
  FeatureScale scale_;
  CameraCheckConfig config_;
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
  std::size_t compared_ = 0, next_estimate_ = 0;  ///< pairs, since the start
  std::optional<CameraEstimate> noticed_;
  int noticed_frame_ = 0;
};

}  // namespace slam

#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "eval/check/sequence_truth.h"

namespace eval {

/// Standard deviation that a depth may have. `ideal` is exact up to the rounding of the file;
/// `kinect1-clean` is Nguyen, Izadi and Lovell (3DIMPVT 2012), sigma = 1.2 mm + 1.9 mm (z - 0.4)^2
/// plus its tilt term; `kinect1` also bends by 0.33 % of z and lies beside its colour, by 0.2
/// degrees (docs/sensors.md); an unknown sensor may have 2 mm + 1 % of z.
double DepthSigma(const std::string& sensor, double z, double tilt_rad, double unit_m);

/// The ids without those that lie near others: what depth that was taken up to 20 ms away from
/// its colour, or that lies some pixels beside it, may show instead.
/// @param ids  CV_16U
cv::Mat InnerIds(const cv::Mat& ids);

/// Rays (x/z, y/z, 1) of pixels, without the lens's distortion.
std::vector<Eigen::Vector3d> RaysOf(const Camera& camera,
                                    const std::vector<cv::Point2d>& pixels);

/// Compares depth images with the depth that the truth predicts: the plane seen through the
/// centre of a pixel, met by its ray from the true pose,
///   z = -(n . o + d) / (n . R_wc r),   r = ((u - cx) / fx, (v - cy) / fy, 1).
/// The pose is that of the depth's own time; where that is another than the colour's, pixels
/// near another plane are left out. In every frame the median of |depth - z| / sigma(z) must be at most 1, where sigma is the
/// sensor's own noise. This finds depth along the ray instead of along the axis, inverted
/// poses, a wrong depth factor, swapped images, and planes of the wrong sign; and it says which
/// fits.
class TruthDepthCheck {
 public:
  TruthDepthCheck(Folder& folder, const SequenceTruth& truth);
  /// @param plane_ids  CV_16U, as gt/plane_id; frames that lack anything are left out
  void Frame(double stamp_s, const cv::Mat& plane_ids);
  /// Reports: one fault for each bad frame, or a single one when more than half are bad.
  void Finish();

 private:
  struct Verdict {
    std::string file;
    double error_m = 0;  ///< median |depth - z|
    bool bad = false;
    std::string explanation;  ///< the mistake that would explain it; may be empty
  };

  Folder& folder_;
  const SequenceTruth& truth_;
  std::vector<Verdict> verdicts_;
};

}  // namespace eval

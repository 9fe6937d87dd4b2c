#pragma once

#include <Eigen/Core>
#include <vector>

namespace eval {

/// What one frame shows and what the run says it shows; ids of a frame are all different.
struct TrackingFrame {
  std::vector<int> truth_ids;
  std::vector<int> predicted_ids;
  Eigen::MatrixXd similarity;  ///< truths x predictions, IoU of the masks in [0, 1]
};

/// CLEAR: per-frame matches at similarity >= 0.5 that prefer the pair of the frame before.
struct ClearScore {
  int tp = 0, fp = 0, fn = 0, id_switches = 0;
  double mota = 0.0;  ///< (TP - FP - IDSW) / (TP + FN)
  double motp = 0.0;  ///< mean similarity of the matches
};

/// Identity: one-to-one matching of whole trajectories.
struct IdentityScore {
  int idtp = 0, idfp = 0, idfn = 0;
  double idf1 = 0.0, idp = 0.0, idr = 0.0;
};

/// HOTA and its parts, means over 19 thresholds 0.05 ... 0.95 (Luiten 2020).
struct HotaScore {
  double hota = 0.0, det_a = 0.0, ass_a = 0.0;
};

/// Definitions of TrackEval 12c8791, which tests hold them to.
ClearScore ScoreClear(const std::vector<TrackingFrame>& frames);
IdentityScore ScoreIdentity(const std::vector<TrackingFrame>& frames);
HotaScore ScoreHota(const std::vector<TrackingFrame>& frames);

}  // namespace eval

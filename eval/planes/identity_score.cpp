#include "eval/planes/identity_score.h"

#include "eval/planes/hungarian.h"

namespace eval {

IdentityScore ScoreIdentity(const std::vector<TrackingFrame>& frames) {
  const TrackingIndices ids = NumberIds(frames);
  Eigen::MatrixXd together =
      Eigen::MatrixXd::Zero(Eigen::Index(ids.truth.size()), Eigen::Index(ids.predicted.size()));
  int truths = 0, predictions = 0;
  for (const TrackingFrame& frame : frames) {
    truths += static_cast<int>(frame.truth_ids.size());
    predictions += static_cast<int>(frame.predicted_ids.size());
    for (Eigen::Index i = 0; i < frame.similarity.rows(); ++i) {
      for (Eigen::Index j = 0; j < frame.similarity.cols(); ++j) {
        if (!(frame.similarity(i, j) >= kMatchThreshold)) continue;
        together(ids.truth.at(frame.truth_ids[std::size_t(i)]),
                 ids.predicted.at(frame.predicted_ids[std::size_t(j)])) += 1.0;
      }
    }
  }
  IdentityScore score;
  const std::vector<int> column_of = AssignMaxWeight(together);
  for (std::size_t i = 0; i < column_of.size(); ++i) {
    if (column_of[i] >= 0)
      score.idtp += static_cast<int>(together(Eigen::Index(i), column_of[i]));
  }
  score.idfn = truths - score.idtp;
  score.idfp = predictions - score.idtp;
  score.idp = SafeRatio(score.idtp, predictions);
  score.idr = SafeRatio(score.idtp, truths);
  score.idf1 = SafeRatio(2.0 * score.idtp, truths + predictions);
  return score;
}

}  // namespace eval

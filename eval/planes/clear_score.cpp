#include "eval/planes/clear_score.h"

#include <cmath>
#include <limits>
#include <set>

#include "eval/planes/hungarian.h"

namespace eval {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kContinuityBonus = 1000.0;  // TrackEval's: above any sum of similarities
constexpr double kMostlyTracked = 0.8,
                 kPartlyTracked = 0.2;  // shares of a truth's frames (CLEAR)

class ClearCounter {
 public:
  void Add(const TrackingFrame& frame) {
    const int truths = static_cast<int>(frame.truth_ids.size());
    const int predictions = static_cast<int>(frame.predicted_ids.size());
    ++score_.frames;
    for (const int id : frame.truth_ids) ++life_[id].frames;
    int matched = 0;
    // TrackEval keeps the last match over frames in which one side is empty.
    if (truths > 0 && predictions > 0) matched = Match(frame);
    score_.tp += matched;
    score_.fn += truths - matched;
    score_.fp += predictions - matched;
  }

  ClearScore Finish() {
    ClearScore& s = score_;
    for (const auto& [id, life] : life_) {
      const double share = double(life.matched) / double(life.frames);
      ++(share > kMostlyTracked    ? s.mostly_tracked
         : share >= kPartlyTracked ? s.partly_tracked
                                   : s.mostly_lost);
      if (life.beginnings > 0) s.fragmentations += life.beginnings - 1;
    }
    const double truths = s.tp + s.fn;
    s.mota = SafeRatio(s.tp - s.fp - s.id_switches, truths);
    s.moda = SafeRatio(s.tp - s.fp, truths);
    s.smota = SafeRatio(s.similarity_sum - s.fp - s.id_switches, truths);
    const double log_switches = s.id_switches > 0 ? std::log10(s.id_switches) : 0.0;
    s.motal = SafeRatio(s.tp - s.fp - log_switches, truths);
    s.motp = SafeRatio(s.similarity_sum, s.tp);
    s.recall = SafeRatio(s.tp, truths);
    s.precision = SafeRatio(s.tp, s.tp + s.fp);
    s.f1 = SafeRatio(s.tp, s.tp + 0.5 * s.fn + 0.5 * s.fp);
    return s;
  }

 private:
  struct Life {
    int frames = 0, matched = 0;
    int beginnings = 0;  ///< matches that follow no match
  };

  Eigen::MatrixXd WeightsOf(const TrackingFrame& frame) const {
    Eigen::MatrixXd weight = frame.similarity;
    for (Eigen::Index i = 0; i < weight.rows(); ++i) {
      const auto previous = previous_match_.find(frame.truth_ids[std::size_t(i)]);
      for (Eigen::Index j = 0; j < weight.cols(); ++j) {
        const bool same = previous != previous_match_.end() &&
                          previous->second == frame.predicted_ids[std::size_t(j)];
        if (same) weight(i, j) += kContinuityBonus;
        if (frame.similarity(i, j) < kMatchThreshold - kEpsilon) weight(i, j) = 0.0;
      }
    }
    return weight;
  }

  int Match(const TrackingFrame& frame) {
    const Eigen::MatrixXd weight = WeightsOf(frame);
    const std::vector<int> column_of = AssignMaxWeight(weight);
    const std::map<int, int> before = std::move(previous_match_);
    previous_match_.clear();
    int matched = 0;
    for (Eigen::Index i = 0; i < weight.rows(); ++i) {
      const int j = column_of[std::size_t(i)];
      if (j < 0 || !(weight(i, j) > kEpsilon)) continue;
      const int truth = frame.truth_ids[std::size_t(i)];
      const int predicted = frame.predicted_ids[std::size_t(j)];
      const auto last = last_match_.find(truth);
      if (last != last_match_.end() && last->second != predicted) ++score_.id_switches;
      last_match_[truth] = predicted;
      previous_match_[truth] = predicted;
      ++life_[truth].matched;
      if (before.count(truth) == 0) ++life_[truth].beginnings;
      score_.similarity_sum += frame.similarity(i, j);
      ++matched;
    }
    return matched;
  }

  ClearScore score_;
  std::map<int, Life> life_;           // by truth
  std::map<int, int> last_match_;      // of a truth, at any earlier frame
  std::map<int, int> previous_match_;  // of a truth, in the last frame with both sides
};

}  // namespace

ClearScore ScoreClear(const std::vector<TrackingFrame>& frames) {
  ClearCounter counter;
  for (const TrackingFrame& frame : frames) counter.Add(frame);
  return counter.Finish();
}

}  // namespace eval

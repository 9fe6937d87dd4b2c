#include "eval/planes/tracking.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "eval/planes/hungarian.h"

namespace eval {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kMatchThreshold = 0.5;
constexpr double kContinuityBonus = 1000.0;
constexpr int kAlphas = 19;

/// Ids of the whole sequence as rising indices.
struct Indices {
  std::map<int, int> truth, predicted;
};

Indices NumberIds(const std::vector<TrackingFrame>& frames) {
  Indices ids;
  for (const TrackingFrame& frame : frames) {
    for (const int id : frame.truth_ids) ids.truth.emplace(id, 0);
    for (const int id : frame.predicted_ids) ids.predicted.emplace(id, 0);
  }
  int next = 0;
  for (auto& [id, index] : ids.truth) index = next++;
  next = 0;
  for (auto& [id, index] : ids.predicted) index = next++;
  return ids;
}

double SafeRatio(double part, double whole) { return whole > 0.0 ? part / whole : 0.0; }

/// Global alignment score A of HOTA and how often each id appears.
struct Alignments {
  Eigen::MatrixXd potential_matches;
  Eigen::VectorXd truth_count, predicted_count;

  double Score(int i, int j) const {
    return potential_matches(i, j) /
           (truth_count[i] + predicted_count[j] - potential_matches(i, j));
  }
};

Alignments AlignAll(const std::vector<TrackingFrame>& frames, const Indices& ids) {
  const auto n = static_cast<Eigen::Index>(ids.truth.size());
  const auto m = static_cast<Eigen::Index>(ids.predicted.size());
  Alignments all{Eigen::MatrixXd::Zero(n, m), Eigen::VectorXd::Zero(n),
                 Eigen::VectorXd::Zero(m)};
  for (const TrackingFrame& frame : frames) {
    const Eigen::MatrixXd& s = frame.similarity;
    const Eigen::VectorXd rows = s.rowwise().sum();
    const Eigen::RowVectorXd cols = s.colwise().sum();
    for (Eigen::Index i = 0; i < s.rows(); ++i) {
      for (Eigen::Index j = 0; j < s.cols(); ++j) {
        const double either = rows[i] + cols[j] - s(i, j);
        if (!(either > kEpsilon)) continue;
        all.potential_matches(ids.truth.at(frame.truth_ids[std::size_t(i)]),
                              ids.predicted.at(frame.predicted_ids[std::size_t(j)])) +=
            s(i, j) / either;
      }
    }
    for (const int id : frame.truth_ids) all.truth_count[ids.truth.at(id)] += 1.0;
    for (const int id : frame.predicted_ids) all.predicted_count[ids.predicted.at(id)] += 1.0;
  }
  return all;
}

struct HotaCounts {
  double tp = 0.0, fn = 0.0, fp = 0.0;
  Eigen::MatrixXd matches;
};

void CountHotaFrame(const TrackingFrame& frame, const Indices& ids, const Alignments& all,
                    std::vector<HotaCounts>& counts) {
  const double truths = static_cast<double>(frame.truth_ids.size());
  const double predictions = static_cast<double>(frame.predicted_ids.size());
  Eigen::MatrixXd weight = frame.similarity;
  for (Eigen::Index i = 0; i < weight.rows(); ++i) {
    for (Eigen::Index j = 0; j < weight.cols(); ++j) {
      weight(i, j) *= all.Score(ids.truth.at(frame.truth_ids[std::size_t(i)]),
                                ids.predicted.at(frame.predicted_ids[std::size_t(j)]));
    }
  }
  const std::vector<int> column_of = AssignMaxWeight(weight);
  for (int a = 0; a < kAlphas; ++a) {
    const double alpha = 0.05 * (a + 1);
    double matched = 0.0;
    for (std::size_t i = 0; i < column_of.size(); ++i) {
      const int j = column_of[i];
      if (j < 0 || !(frame.similarity(Eigen::Index(i), j) >= alpha - kEpsilon)) continue;
      matched += 1.0;
      counts[std::size_t(a)].matches(ids.truth.at(frame.truth_ids[i]),
                                     ids.predicted.at(frame.predicted_ids[std::size_t(j)])) +=
          1.0;
    }
    counts[std::size_t(a)].tp += matched;
    counts[std::size_t(a)].fn += truths - matched;
    counts[std::size_t(a)].fp += predictions - matched;
  }
}

/// (1 / TP) sum over matches of TPA / (TPA + FNA + FPA).
double AssociationAccuracy(const HotaCounts& counts, const Alignments& all) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < counts.matches.rows(); ++i) {
    for (Eigen::Index j = 0; j < counts.matches.cols(); ++j) {
      const double n = counts.matches(i, j);
      if (n > 0.0) sum += n * n / (all.truth_count[i] + all.predicted_count[j] - n);
    }
  }
  return sum / std::max(1.0, counts.tp);
}

}  // namespace

ClearScore ScoreClear(const std::vector<TrackingFrame>& frames) {
  ClearScore score;
  std::map<int, int> last_match;      // of a truth, at any earlier frame
  std::map<int, int> previous_match;  // of a truth, in the last frame with both sides
  double similarity_sum = 0.0;
  for (const TrackingFrame& frame : frames) {
    const int truths = static_cast<int>(frame.truth_ids.size());
    const int predictions = static_cast<int>(frame.predicted_ids.size());
    if (truths == 0 || predictions == 0) {
      score.fn += truths;
      score.fp += predictions;
      continue;
    }
    Eigen::MatrixXd weight = frame.similarity;
    for (int i = 0; i < truths; ++i) {
      const auto previous = previous_match.find(frame.truth_ids[std::size_t(i)]);
      for (int j = 0; j < predictions; ++j) {
        const bool same = previous != previous_match.end() &&
                          previous->second == frame.predicted_ids[std::size_t(j)];
        if (same) weight(i, j) += kContinuityBonus;
        if (frame.similarity(i, j) < kMatchThreshold - kEpsilon) weight(i, j) = 0.0;
      }
    }
    const std::vector<int> column_of = AssignMaxWeight(weight);
    previous_match.clear();
    int matched = 0;
    for (int i = 0; i < truths; ++i) {
      const int j = column_of[std::size_t(i)];
      if (j < 0 || !(weight(i, j) > kEpsilon)) continue;
      const int truth = frame.truth_ids[std::size_t(i)];
      const int predicted = frame.predicted_ids[std::size_t(j)];
      const auto last = last_match.find(truth);
      if (last != last_match.end() && last->second != predicted) ++score.id_switches;
      last_match[truth] = predicted;
      previous_match[truth] = predicted;
      similarity_sum += frame.similarity(i, j);
      ++matched;
    }
    score.tp += matched;
    score.fn += truths - matched;
    score.fp += predictions - matched;
  }
  score.mota = SafeRatio(score.tp - score.fp - score.id_switches, score.tp + score.fn);
  score.motp = SafeRatio(similarity_sum, score.tp);
  return score;
}

IdentityScore ScoreIdentity(const std::vector<TrackingFrame>& frames) {
  const Indices ids = NumberIds(frames);
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

HotaScore ScoreHota(const std::vector<TrackingFrame>& frames) {
  const Indices ids = NumberIds(frames);
  const Alignments all = AlignAll(frames, ids);
  HotaCounts none;
  none.matches =
      Eigen::MatrixXd::Zero(all.potential_matches.rows(), all.potential_matches.cols());
  std::vector<HotaCounts> counts(kAlphas, none);
  for (const TrackingFrame& frame : frames) CountHotaFrame(frame, ids, all, counts);
  HotaScore score;
  for (const HotaCounts& c : counts) {
    const double det_a = SafeRatio(c.tp, c.tp + c.fn + c.fp);
    const double ass_a = AssociationAccuracy(c, all);
    score.det_a += det_a / kAlphas;
    score.ass_a += ass_a / kAlphas;
    score.hota += std::sqrt(det_a * ass_a) / kAlphas;
  }
  return score;
}

}  // namespace eval

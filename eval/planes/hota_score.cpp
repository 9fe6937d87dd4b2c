#include "eval/planes/hota_score.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "eval/planes/hungarian.h"

namespace eval {
namespace {

constexpr double kHotaEpsilon = std::numeric_limits<double>::epsilon();

/// Global alignment score A of HOTA and how often each id appears.
struct Alignments {
  Eigen::MatrixXd potential_matches;
  Eigen::VectorXd truth_count, predicted_count;

  double Score(int i, int j) const {
    return potential_matches(i, j) /
           (truth_count[i] + predicted_count[j] - potential_matches(i, j));
  }
};

Alignments AlignAll(const std::vector<TrackingFrame>& frames, const TrackingIndices& ids) {
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
        if (!(either > kHotaEpsilon)) continue;
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
  double tp = 0.0, fn = 0.0, fp = 0.0, similarity_sum = 0.0;
  Eigen::MatrixXd matches;
};

void CountHotaFrame(const TrackingFrame& frame, const TrackingIndices& ids,
                    const Alignments& all, std::vector<HotaCounts>& counts) {
  const double truths = static_cast<double>(frame.truth_ids.size());
  const double predictions = static_cast<double>(frame.predicted_ids.size());
  const auto row_of = [&](Eigen::Index i) {
    return ids.truth.at(frame.truth_ids[std::size_t(i)]);
  };
  const auto column_at = [&](Eigen::Index j) {
    return ids.predicted.at(frame.predicted_ids[std::size_t(j)]);
  };
  Eigen::MatrixXd weight = frame.similarity;
  for (Eigen::Index i = 0; i < weight.rows(); ++i) {
    for (Eigen::Index j = 0; j < weight.cols(); ++j) {
      weight(i, j) *= all.Score(row_of(i), column_at(j));
    }
  }
  const std::vector<int> column_of = AssignMaxWeight(weight);
  for (std::size_t a = 0; a < counts.size(); ++a) {
    const double alpha = 0.05 * static_cast<double>(a + 1);
    double matched = 0.0;
    for (Eigen::Index i = 0; i < weight.rows(); ++i) {
      const int j = column_of[std::size_t(i)];
      if (j < 0 || !(frame.similarity(i, j) >= alpha - kHotaEpsilon)) continue;
      matched += 1.0;
      counts[a].similarity_sum += frame.similarity(i, j);
      counts[a].matches(row_of(i), column_at(j)) += 1.0;
    }
    counts[a].tp += matched;
    counts[a].fn += truths - matched;
    counts[a].fp += predictions - matched;
  }
}

HotaFigures FiguresOf(const HotaCounts& counts, const Alignments& all) {
  HotaFigures f;
  f.tp = counts.tp, f.fn = counts.fn, f.fp = counts.fp;
  f.det_a = SafeRatio(f.tp, f.tp + f.fn + f.fp);
  f.det_recall = SafeRatio(f.tp, f.tp + f.fn);
  f.det_precision = SafeRatio(f.tp, f.tp + f.fp);
  f.loc_a = f.tp > 0.0 ? counts.similarity_sum / f.tp : 1.0;
  // (1 / TP) sum over matches of TPA / (TPA + FNA + FPA), and its two halves.
  const double matches = std::max(1.0, f.tp);
  for (Eigen::Index i = 0; i < counts.matches.rows(); ++i) {
    for (Eigen::Index j = 0; j < counts.matches.cols(); ++j) {
      const double n = counts.matches(i, j);
      if (!(n > 0.0)) continue;
      f.ass_a += n * n / (all.truth_count[i] + all.predicted_count[j] - n) / matches;
      f.ass_recall += n * n / all.truth_count[i] / matches;
      f.ass_precision += n * n / all.predicted_count[j] / matches;
    }
  }
  f.hota = std::sqrt(f.det_a * f.ass_a);
  f.owta = std::sqrt(f.det_recall * f.ass_a);
  return f;
}

HotaFigures MeanOf(const std::array<HotaFigures, kHotaThresholds>& figures) {
  HotaFigures mean;
  for (double HotaFigures::*member :
       {&HotaFigures::hota, &HotaFigures::det_a, &HotaFigures::det_recall,
        &HotaFigures::det_precision, &HotaFigures::ass_a, &HotaFigures::ass_recall,
        &HotaFigures::ass_precision, &HotaFigures::loc_a, &HotaFigures::owta, &HotaFigures::tp,
        &HotaFigures::fn, &HotaFigures::fp}) {
    for (const HotaFigures& f : figures) mean.*member += f.*member / double(kHotaThresholds);
  }
  return mean;
}

}  // namespace

HotaScore ScoreHota(const std::vector<TrackingFrame>& frames) {
  const TrackingIndices ids = NumberIds(frames);
  const Alignments all = AlignAll(frames, ids);
  HotaCounts none;
  none.matches =
      Eigen::MatrixXd::Zero(all.potential_matches.rows(), all.potential_matches.cols());
  std::vector<HotaCounts> counts(kHotaThresholds, none);
  for (const TrackingFrame& frame : frames) CountHotaFrame(frame, ids, all, counts);
  HotaScore score;
  for (std::size_t a = 0; a < counts.size(); ++a) score.at[a] = FiguresOf(counts[a], all);
  static_cast<HotaFigures&>(score) = MeanOf(score.at);
  return score;
}

}  // namespace eval

#include "eval/planes/association.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace eval {
namespace {

using Table = std::map<int, std::map<int, int>>;

long long PairsOf(long long n) { return n * (n - 1) / 2; }

int Sum(const std::map<int, int>& row) {
  int sum = 0;
  for (const auto& [id, n] : row) sum += n;
  return sum;
}

/// Rows with at least two entries that carry weight.
int CountMixed(const Table& rows, const EntryRule& rule) {
  return static_cast<int>(std::count_if(rows.begin(), rows.end(), [&](const auto& row) {
    return StrongEntries(row.second, rule).size() >= 2;
  }));
}

double HarmonicMean(double a, double b) { return a + b > 0.0 ? 2.0 * a * b / (a + b) : 0.0; }

void ScorePairs(const Table& by_truth, const Table& by_map, AssociationScore& score) {
  double b_cubed_precision = 0.0, b_cubed_recall = 0.0;
  for (const auto& [truth, row] : by_truth) {
    const double n_truth = Sum(row);
    score.pair_truth += PairsOf(Sum(row));
    for (const auto& [map_plane, n] : row) {
      score.pair_tp += PairsOf(n);
      b_cubed_precision += double(n) * n / Sum(by_map.at(map_plane));
      b_cubed_recall += double(n) * n / n_truth;
    }
  }
  for (const auto& [map_plane, row] : by_map) score.pair_predicted += PairsOf(Sum(row));
  score.pair =
      MakeScores(double(score.pair_tp), double(score.pair_predicted), double(score.pair_truth));
  const double n = double(score.records_with_truth);
  if (n > 0.0) {
    score.b_cubed.precision = b_cubed_precision / n;
    score.b_cubed.recall = b_cubed_recall / n;
    score.b_cubed.f1 = HarmonicMean(score.b_cubed.precision, score.b_cubed.recall);
  }
}

/// @param owner                       of the map plane
/// @param known_planes, known_truths  map planes, and truths that own one, as of the frame before
JudgedDecision Judge(const AssociationRecord& record, int owner,
                     const std::set<int>& known_planes, const std::set<int>& known_truths) {
  JudgedDecision judged;
  judged.truth_had_owner = known_truths.count(record.truth) > 0;
  const bool known = known_planes.count(record.map_plane) > 0;
  if (known || owner != record.truth) judged.owner = owner;
  if (owner != record.truth) {
    judged.outcome = DecisionOutcome::kWrong;
  } else if (known) {
    judged.outcome = record.truth == 0 ? DecisionOutcome::kNoiseAgain : DecisionOutcome::kRight;
  } else {
    judged.outcome = record.truth == 0        ? DecisionOutcome::kSpurious
                     : judged.truth_had_owner ? DecisionOutcome::kMissed
                                              : DecisionOutcome::kFirst;
  }
  return judged;
}

DecisionCounts CountDecisions(const std::vector<AssociationRecord>& records) {
  DecisionCounts counts;
  for (const JudgedDecision& judged : JudgeDecisions(records)) {
    switch (judged.outcome) {
      case DecisionOutcome::kRight:
        ++counts.tp;
        break;
      case DecisionOutcome::kWrong:
        ++counts.fp;
        if (judged.truth_had_owner) ++counts.fn;
        break;
      case DecisionOutcome::kMissed:
        ++counts.fn;
        break;
      case DecisionOutcome::kFirst:
        ++counts.tn;
        break;
      case DecisionOutcome::kSpurious:
      case DecisionOutcome::kNoiseAgain:
        ++counts.spurious;
        break;
    }
  }
  counts.scores = MakeScores(counts.tp, counts.tp + counts.fp, counts.tp + counts.fn);
  return counts;
}

}  // namespace

std::vector<int> StrongEntries(const std::map<int, int>& row, const EntryRule& rule) {
  const double min_records = std::max(rule.min_records, rule.min_share * Sum(row));
  std::vector<int> strong;
  for (const auto& [id, n] : row) {
    if (n >= min_records) strong.push_back(id);
  }
  return strong;
}

std::map<int, int> OwnersOf(const std::vector<AssociationRecord>& records) {
  struct Making {
    int frame = 0;
    std::map<int, long long> pixels;  // by truth
  };
  std::map<int, Making> made;
  for (const AssociationRecord& r : records) {
    Making& making = made.try_emplace(r.map_plane, Making{r.frame, {}}).first->second;
    if (r.frame == making.frame) making.pixels[r.truth] += r.pixels;
  }
  std::map<int, int> owners;
  for (const auto& [map_plane, making] : made) {
    const auto rank = [](const std::pair<const int, long long>& entry) {
      return std::tuple(entry.second, entry.first != 0, -entry.first);
    };
    owners[map_plane] =
        std::max_element(making.pixels.begin(), making.pixels.end(),
                         [&](const auto& a, const auto& b) { return rank(a) < rank(b); })
            ->first;
  }
  return owners;
}

std::vector<JudgedDecision> JudgeDecisions(const std::vector<AssociationRecord>& records) {
  std::vector<JudgedDecision> judged;
  judged.reserve(records.size());
  const std::map<int, int> owners = OwnersOf(records);
  std::set<int> known_planes;  // as of the frame before
  std::set<int> known_truths;  // that own one of them
  for (auto first = records.begin(); first != records.end();) {
    const auto last = std::find_if(first, records.end(), [&](const AssociationRecord& r) {
      return r.frame != first->frame;
    });
    for (auto r = first; r != last; ++r) {
      judged.push_back(Judge(*r, owners.at(r->map_plane), known_planes, known_truths));
    }
    for (auto r = first; r != last; ++r) {
      known_planes.insert(r->map_plane);
      const int owner = owners.at(r->map_plane);
      if (owner != 0) known_truths.insert(owner);
    }
    first = last;
  }
  return judged;
}

PrecisionRecall MakeScores(double tp, double predicted, double truth) {
  PrecisionRecall scores;
  if (predicted > 0.0) scores.precision = tp / predicted;
  if (truth > 0.0) scores.recall = tp / truth;
  scores.f1 = HarmonicMean(scores.precision, scores.recall);
  return scores;
}

AssociationScore ScoreAssociation(const std::vector<AssociationRecord>& records,
                                  const EntryRule& rule) {
  AssociationScore score;
  Table by_truth, by_map;
  LabelPairs pairs;
  for (const AssociationRecord& record : records) {
    ++score.records;
    if (record.truth == 0) continue;
    ++score.records_with_truth;
    ++by_truth[record.truth][record.map_plane];
    ++by_map[record.map_plane][record.truth];
    ++pairs[{record.truth, record.map_plane}];
  }
  score.merged_map_planes = CountMixed(by_map, rule);
  score.split_truth_planes = CountMixed(by_truth, rule);
  ScorePairs(by_truth, by_map, score);
  score.partition = ScorePartition(pairs);
  score.decision = CountDecisions(records);
  return score;
}

}  // namespace eval

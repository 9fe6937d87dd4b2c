#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "eval/regression/baseline.h"

namespace eval {

/// What a suite says about the gate.
struct GateRules {
  double alpha = 0.01;  ///< chance of a false alarm, over all figures and looks together
  int looks = 1;        ///< how often the same gate may be asked, with more seeds each time
  bool times = true;    ///< compare times too; needs the processor of the baseline
  bool undecided_passes = false;
  std::map<std::string, double> worst;  ///< by figure: what no case may be worse than
};

enum class Verdict {
  kSame,       ///< the 95 % interval of the mean harm ends below what matters
  kUndecided,  ///< neither the one nor the other can be told; more seeds may tell
  kWorse,      ///< surely worse, by more than matters
};

/// Pairs of cases from which on a figure can be judged: of fewer no test can ever say p < 0.01
/// (metrics.md 5.2).
inline constexpr std::size_t kMinPairs = 7;

/// How far a figure has come by steps that were each too small to be worse (history.h).
struct Drift {
  double harm = 0.0;          ///< of the candidate over the median of the baselines
  std::size_t baselines = 0;  ///< that were accepted so far
};

/// One figure of one arm.
struct MetricVerdict {
  std::string arm;
  GatedMetric metric;
  Verdict verdict = Verdict::kSame;
  std::size_t pairs = 0;
  bool equal = false;                ///< no pair differs at all
  double shift = 0.0;                ///< Hodges-Lehmann, a harm
  double p = 1.0;                    ///< after Holm, over all figures and arms
  std::optional<Drift> drift;        ///< of a figure that is not worse by itself
  double upper = 0.0;                ///< end of the interval of the mean harm
  std::vector<std::string> replays;  ///< keys of the cases with most harm, at most three
};

/// A figure that became much worse in every seed of one scene: the mean over many scenes hides that, and few
/// seeds prove nothing by the tests.
struct SceneVerdict {
  std::string arm, scene;
  GatedMetric metric;
  Verdict verdict = Verdict::kUndecided;  ///< kWorse from kMinScenePairs seeds on
  std::size_t pairs = 0;
  double least = 0.0;  ///< the smallest harm of its seeds
  std::vector<std::string> replays;
};

/// Something that is counted, or has a bound of its own.
struct CountVerdict {
  std::string where;  ///< an arm, or a case
  std::string what;
  double baseline = 0.0, candidate = 0.0;
  bool worse = false;
};

struct GateReport {
  std::vector<MetricVerdict> metrics;
  std::vector<SceneVerdict> scenes;  ///< those with something to say
  std::vector<CountVerdict> counts;
  std::size_t unknown_cases = 0;  ///< of the candidate, that the baseline does not have
  std::set<std::string>
      unknown_figures;  ///< that no case of the baseline has: an older program's

  /// Whether something is worse than the baseline, or has drifted.
  bool AnyWorse() const;
  /// Whether something is worse that measuring times again cannot mend.
  bool AnyWorseButTimes() const;
  /// Arms with a figure that is undecided; times left out, which more seeds do not mend on a
  /// machine that has other work.
  std::vector<std::string> UndecidedArms() const;
  /// Arms with a time that may be worse, judged by one run of each case: its shift is above half of
  /// what matters.
  std::vector<std::string> ArmsWithDoubtfulTimes() const;
};

/// Compares cases with the baseline's, paired by key (docs/suites.md tells the rule). A case that
/// failed now alone has the worst rank of its figures; one that failed before says nothing of them.
/// @param candidate  cases of the arms that are to be gated
GateReport CompareWithBaseline(const Baseline& baseline, const GateCases& candidate,
                               const GateRules& rules);

/// The figures of one case that are beyond their bounds. @param worst  by figure, see GateRules
std::vector<std::string> BeyondBounds(const Figures& figures,
                                      const std::map<std::string, double>& worst);

/// The figures with a bound that one case has not: a case that is done must not pass by them.
std::vector<std::string> UndefinedOfBounded(const Figures& figures,
                                            const std::map<std::string, double>& worst);

/// A table of plain lines: what became worse, by how much, which cases to replay; then what is
/// undecided, and how many figures are the same. Ends in a newline.
std::string GateTable(const GateReport& report);

}  // namespace eval

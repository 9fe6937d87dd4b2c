#include "eval/regression/gate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "eval/regression/history.h"
#include "eval/regression/paired_tests.h"

namespace eval {
namespace {

constexpr std::size_t kMaxExactFlips = 15;  // metrics.md 5.3: sign flips up to here, then ranks
constexpr std::size_t kMaxExactRanks = 200;  // the normal approximation then errs by under 1e-4
constexpr std::size_t kResamples = 2000;  // the interval's ends vary by some 3 % of its width
constexpr double kCoverage = 0.95;        // metrics.md 5.3
constexpr double kMaxLostShare = 0.01;    // of all frames; as much as a score may lose
constexpr std::size_t kMaxReplays = 3;
// A change of a scene's every seed that no other rounding makes: an error twice as large, a score lower by 0.1.
// Counts are left out, as one more of few doubles them.
constexpr std::size_t kMinScenePairs = 3;
const double kGrossRatio = std::log(2.0);
constexpr double kGrossLoss = 0.1;

struct Pair {
  std::string key;
  /// Infinite for a case that fails now, or whose figure is not defined now.
  double harm = 0.0;
};

/// The harm of one figure of one case; nothing when there is nothing to compare.
std::optional<double> HarmOf(const GatedMetric& metric, const GateCase& before,
                             const GateCase& now) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const auto value = [&](const GateCase& one) {
    const auto found = one.figures.find(metric.figure);
    return found == one.figures.end() ? std::nullopt : found->second;
  };
  const std::optional<double> was = value(before), is = value(now);
  // A case that failed before has nothing to compare with: as a gain it would outweigh harm elsewhere.
  if (!was) return std::nullopt;
  return is ? Harm(metric.kind, *was, *is) : kInfinite;
}

/// Harms in which that of a failure is finite and outweighs all others together.
std::vector<double> FiniteHarms(const std::vector<Pair>& pairs) {
  double sum = 1.0;
  for (const Pair& pair : pairs) sum += std::isfinite(pair.harm) ? std::abs(pair.harm) : 0.0;
  std::vector<double> harms;
  harms.reserve(pairs.size());
  for (const Pair& pair : pairs) {
    harms.push_back(std::isfinite(pair.harm) ? pair.harm : sum);
  }
  return harms;
}

/// "desk" of "desk-21/kinect1/own/full/default".
std::string SceneOfKey(const std::string& key) {
  const std::string label = key.substr(0, key.find('/'));
  return label.substr(0, label.rfind('-'));
}

double OneSidedP(const std::vector<double>& harms) {
  if (harms.size() <= kMaxExactFlips) return SignFlipP(harms);
  return harms.size() <= kMaxExactRanks ? WilcoxonExactP(harms) : WilcoxonNormalP(harms, true);
}

std::vector<std::string> Worst(std::vector<Pair> pairs) {
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.harm > b.harm; });
  std::vector<std::string> keys;
  for (const Pair& pair : pairs) {
    if (keys.size() < kMaxReplays && pair.harm > 0.0) keys.push_back(pair.key);
  }
  return keys;
}

/// Everything about one figure of one arm but the verdict, which needs all p-values.
MetricVerdict Measure(const std::string& arm, const GatedMetric& metric,
                      const std::vector<Pair>& pairs) {
  MetricVerdict found;
  found.arm = arm;
  found.metric = metric;
  found.pairs = pairs.size();
  const std::vector<double> harms = FiniteHarms(pairs);
  found.equal =
      std::all_of(harms.begin(), harms.end(), [](double harm) { return harm == 0.0; });
  if (found.equal) return found;
  found.p = OneSidedP(harms);
  found.shift = HodgesLehmannShift(harms);
  found.upper =
      BootstrapMeanInterval(harms, DrawResamples(harms.size(), kResamples), kCoverage).high;
  found.replays = Worst(pairs);
  return found;
}

/// Scenes of an arm of several whose every seed is much worse.
void AddScenes(const std::string& arm, const GatedMetric& metric,
               const std::vector<Pair>& pairs, std::vector<SceneVerdict>& scenes) {
  if (metric.kind == MetricKind::kCount || metric.kind == MetricKind::kTime) return;
  std::map<std::string, std::vector<Pair>> by_scene;
  for (const Pair& pair : pairs) by_scene[SceneOfKey(pair.key)].push_back(pair);
  for (const auto& [scene, own] : by_scene) {
    const double least =
        std::min_element(own.begin(), own.end(), [](const Pair& a, const Pair& b) {
          return a.harm < b.harm;
        })->harm;
    if (least < (metric.kind == MetricKind::kScore ? kGrossLoss : kGrossRatio)) continue;
    scenes.push_back({arm, scene, metric,
                      own.size() < kMinScenePairs ? Verdict::kUndecided : Verdict::kWorse,
                      own.size(), least, Worst(own)});
  }
}

Verdict Judge(const MetricVerdict& found, double alpha) {
  if (found.equal) return Verdict::kSame;
  if (found.pairs < kMinPairs) return Verdict::kUndecided;
  const double max_harm = MaxHarm(found.metric.kind);
  if (found.p < alpha && found.shift > max_harm) return Verdict::kWorse;
  return found.upper < max_harm ? Verdict::kSame : Verdict::kUndecided;
}

class Comparison {
 public:
  Comparison(const Baseline& baseline, const GateCases& candidate, const GateRules& rules)
      : baseline_(baseline), candidate_(candidate), rules_(rules) {
    for (const auto& [key, one] : candidate) {
      if (baseline.cases.count(key) > 0) arms_.insert(ArmOfKey(key));
    }
  }

  GateReport Report() const {
    GateReport report;
    for (const GatedMetric& metric : GatedMetrics()) {
      const auto anywhere = [&](const GateCases& cases) {
        return std::any_of(cases.begin(), cases.end(), [&](const auto& one) {
          return one.second.figures.count(metric.figure) > 0;
        });
      };
      if (!anywhere(baseline_.cases) && anywhere(candidate_))
        report.unknown_figures.insert(metric.figure);
    }
    for (const std::string& arm : arms_) AddArm(arm, report);
    std::vector<double> p;
    for (const MetricVerdict& found : report.metrics) p.push_back(found.p);
    const std::vector<double> adjusted = HolmAdjusted(p);
    for (std::size_t i = 0; i < adjusted.size(); ++i) {
      report.metrics[i].p = adjusted[i];
      // Each look at the same gate may spend an equal part of the false alarms.
      MetricVerdict& found = report.metrics[i];
      found.verdict = Judge(found, rules_.alpha / rules_.looks);
      if (found.verdict != Verdict::kWorse && found.pairs >= kMinPairs &&
          found.metric.kind != MetricKind::kTime) {
        found.drift = DriftOf(baseline_.history, found.arm, found.metric, found.shift);
      }
    }
    for (const auto& [key, one] : candidate_) {
      if (baseline_.cases.count(key) == 0) {
        ++report.unknown_cases;
        if (!one.done)
          report.counts.push_back({key, "failed, and not in the baseline", 0, 1, true});
      }
      AddBounds(key, one, report);
    }
    return report;
  }

 private:
  template <typename Visit>
  void ForPairs(const std::string& arm, const Visit& visit) const {
    for (const auto& [key, now] : candidate_) {
      const auto before = baseline_.cases.find(key);
      if (before != baseline_.cases.end() && ArmOfKey(key) == arm)
        visit(key, before->second, now);
    }
  }

  void AddArm(const std::string& arm, GateReport& report) const {
    for (const GatedMetric& metric : GatedMetrics()) {
      if (metric.kind == MetricKind::kTime && !rules_.times) continue;
      std::vector<Pair> pairs;
      ForPairs(arm, [&](const std::string& key, const GateCase& before, const GateCase& now) {
        if (const auto harm = HarmOf(metric, before, now)) pairs.push_back({key, *harm});
      });
      if (pairs.empty()) continue;
      report.metrics.push_back(Measure(arm, metric, pairs));
      AddScenes(arm, metric, pairs, report.scenes);
    }
    CountVerdict failed{.where = arm, .what = "failed cases"};
    CountVerdict lost{.where = arm, .what = "frames without a pose"};
    CountVerdict both{.where = arm, .what = "cases done now and before", .baseline = 1.0};
    double frames = 0.0;
    ForPairs(arm, [&](const std::string&, const GateCase& before, const GateCase& now) {
      failed.baseline += before.done ? 0 : 1;
      failed.candidate += now.done ? 0 : 1;
      if (!before.done || !now.done) return;
      ++both.candidate;
      lost.baseline += LostFrames(before);
      lost.candidate += LostFrames(now);
      frames += Value(before, kFramesFigure);
    });
    failed.worse = failed.candidate > failed.baseline;
    lost.worse = lost.candidate > lost.baseline + kMaxLostShare * frames;
    both.worse = both.candidate < both.baseline;
    report.counts.insert(report.counts.end(), {failed, lost, both});
  }

  static double Value(const GateCase& one, const char* figure) {
    const auto found = one.figures.find(figure);
    return found == one.figures.end() ? 0.0 : found->second.value_or(0.0);
  }
  static double LostFrames(const GateCase& one) {
    return Value(one, kFramesFigure) - Value(one, kTrackedFigure);
  }

  void AddBounds(const std::string& key, const GateCase& now, GateReport& report) const {
    for (const std::string& figure : BeyondBounds(now.figures, rules_.worst)) {
      report.counts.push_back({key, figure + " beyond its bound", rules_.worst.at(figure),
                               now.figures.at(figure).value_or(0.0), true});
    }
    if (!now.done) return;  // a failure is counted as such
    for (const std::string& figure : UndefinedOfBounded(now.figures, rules_.worst)) {
      report.counts.push_back({key, figure + " is bounded, but not defined",
                               rules_.worst.at(figure),
                               std::numeric_limits<double>::quiet_NaN(), true});
    }
  }

  const Baseline& baseline_;
  const GateCases& candidate_;
  const GateRules& rules_;
  std::set<std::string> arms_;
};

const char* WordOf(Verdict verdict) {
  return verdict == Verdict::kWorse ? "WORSE" : "undecided";
}

void AddReplays(const std::vector<std::string>& replays, std::string& table) {
  for (const std::string& key : replays) table += fmt::format("{:>16} {}\n", "replay", key);
}

void AddDrifts(const GateReport& report, std::string& table) {
  for (const MetricVerdict& found : report.metrics) {
    if (!found.drift) continue;
    table += fmt::format(
        "DRIFT     {:<34} {:>10} {:>10} {:>8} {:>5}  {}, over the median of {} baselines\n",
        found.metric.figure, HarmText(found.metric.kind, found.drift->harm), "", "",
        found.pairs, found.arm, found.drift->baselines);
  }
}

void AddMetricLines(const GateReport& report, Verdict verdict, std::string& table) {
  for (const MetricVerdict& found : report.metrics) {
    if (found.verdict != verdict) continue;
    table +=
        fmt::format("{:<9} {:<34} {:>10} {:>10} {:>8.2g} {:>5}  {}\n", WordOf(verdict),
                    found.metric.figure, HarmText(found.metric.kind, found.shift),
                    HarmText(found.metric.kind, found.upper), found.p, found.pairs, found.arm);
    AddReplays(found.replays, table);
  }
  for (const SceneVerdict& found : report.scenes) {
    if (found.verdict != verdict) continue;
    table += fmt::format("{:<9} {:<34} {:>10} {:>10} {:>8} {:>5}  {} of {}, in every seed\n",
                         WordOf(verdict), found.metric.figure,
                         HarmText(found.metric.kind, found.least), "", "", found.pairs,
                         found.scene, found.arm);
    AddReplays(found.replays, table);
  }
}

}  // namespace

bool GateReport::AnyWorse() const {
  return AnyWorseButTimes() ||
         std::any_of(metrics.begin(), metrics.end(),
                     [](const MetricVerdict& m) { return m.verdict == Verdict::kWorse; });
}

bool GateReport::AnyWorseButTimes() const {
  return std::any_of(metrics.begin(), metrics.end(),
                     [](const MetricVerdict& m) {
                       return m.drift || (m.verdict == Verdict::kWorse &&
                                          m.metric.kind != MetricKind::kTime);
                     }) ||
         std::any_of(scenes.begin(), scenes.end(),
                     [](const SceneVerdict& s) { return s.verdict == Verdict::kWorse; }) ||
         std::any_of(counts.begin(), counts.end(),
                     [](const CountVerdict& c) { return c.worse; });
}

std::vector<std::string> GateReport::UndecidedArms() const {
  std::set<std::string> arms;
  for (const MetricVerdict& found : metrics) {
    if (found.metric.kind == MetricKind::kTime) continue;
    if (found.verdict == Verdict::kUndecided) arms.insert(found.arm);
  }
  for (const SceneVerdict& found : scenes) {
    if (found.verdict == Verdict::kUndecided) arms.insert(found.arm);
  }
  return {arms.begin(), arms.end()};
}

std::vector<std::string> GateReport::ArmsWithDoubtfulTimes() const {
  std::set<std::string> arms;
  for (const MetricVerdict& found : metrics) {
    const bool time = found.metric.kind == MetricKind::kTime;
    if (time && found.shift > MaxHarm(MetricKind::kTime) / 2) arms.insert(found.arm);
  }
  return {arms.begin(), arms.end()};
}

GateReport CompareWithBaseline(const Baseline& baseline, const GateCases& candidate,
                               const GateRules& rules) {
  return Comparison(baseline, candidate, rules).Report();
}

std::vector<std::string> BeyondBounds(const Figures& figures,
                                      const std::map<std::string, double>& worst) {
  std::vector<std::string> beyond;
  for (const GatedMetric& metric : GatedMetrics()) {
    const auto bound = worst.find(metric.figure);
    const auto value = figures.find(metric.figure);
    if (bound == worst.end() || value == figures.end() || !value->second) continue;
    const double sign = metric.kind == MetricKind::kScore ? -1.0 : 1.0;
    if (sign * *value->second > sign * bound->second) beyond.emplace_back(metric.figure);
  }
  return beyond;
}

std::vector<std::string> UndefinedOfBounded(const Figures& figures,
                                            const std::map<std::string, double>& worst) {
  std::vector<std::string> undefined;
  for (const auto& [figure, bound] : worst) {
    const auto value = figures.find(figure);
    if (value == figures.end() || !value->second) undefined.push_back(figure);
  }
  return undefined;
}

std::string GateTable(const GateReport& report) {
  std::string lines;
  for (const CountVerdict& count : report.counts) {
    if (!count.worse) continue;
    lines += fmt::format("WORSE     {}: {}, baseline or bound {}  {}\n", count.what,
                         count.candidate, count.baseline, count.where);
  }
  AddMetricLines(report, Verdict::kWorse, lines);
  AddDrifts(report, lines);
  AddMetricLines(report, Verdict::kUndecided, lines);
  std::string table;
  if (!lines.empty()) {
    table = fmt::format("{:<9} {:<34} {:>10} {:>10} {:>8} {:>5}  {}\n", "verdict", "figure",
                        "shift", "95 % end", "p", "pairs", "arm");
  }
  table += lines;
  const auto same =
      std::count_if(report.metrics.begin(), report.metrics.end(),
                    [](const MetricVerdict& m) { return m.verdict == Verdict::kSame; });
  table += fmt::format("{} of {} figures are the same\n", same, report.metrics.size());
  if (std::any_of(report.metrics.begin(), report.metrics.end(), [](const MetricVerdict& m) {
        return m.metric.kind == MetricKind::kTime && m.verdict == Verdict::kUndecided;
      })) {
    table += "undecided times pass; a machine with nothing else to do can tell\n";
  }
  if (report.unknown_cases > 0) {
    table += fmt::format("{} cases are not in the baseline; --accept takes them in\n",
                         report.unknown_cases);
  }
  if (!report.unknown_figures.empty()) {
    table += fmt::format("not in the baseline, so not compared: {}; --accept takes them in\n",
                         fmt::join(report.unknown_figures, ", "));
  }
  return table;
}

}  // namespace eval

#include "slam/model/class_belief.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace slam {
namespace {

// Of planes as they are labelled, links to boxes included. Measured with the simulated detector
// `noisy`: 0.20, 0.07, 0.01 and 0.41, on landmarks seen 20 times or more. Wider ones are the
// defaults: decisions depend on none of them (docs/association.md, what rates are worth).
constexpr double kMiss = 0.35;      // a detector misses an object of its classes this often
constexpr double kFalse = 0.06;     // a plane without class is linked to some box this often
constexpr double kConfused = 0.03;  // an object is given one particular other class this often
constexpr double kPriorNone = 0.6;  // most planes belong to no detected object
// Frames are not independent: evidence beyond this many of them says no more.
constexpr double kMaxEvidence = 20.0;

/// P(observed | true class).
double Emission(const std::string& truth, const std::string& observed) {
  if (truth.empty()) return observed.empty() ? 1 - kFalse : kFalse;
  if (observed.empty()) return kMiss;
  return observed == truth ? 1 - kMiss : kConfused;
}

struct Posterior {
  std::vector<std::string> names;
  std::vector<double> probabilities;
};

/// P(class | evidence) over no class, the classes of the evidence, and those of `also`.
Posterior PosteriorOf(const std::map<std::string, double>& belief,
                      const std::set<std::string>& also) {
  // Evidence beyond the bound is scaled down to it.
  Posterior out;
  double total = 0.0;
  for (const auto& [name, evidence] : belief) total += evidence;
  const double scale = total > kMaxEvidence ? kMaxEvidence / total : 1.0;
  // The hypotheses: no class first, then each class once.
  out.names.emplace_back();
  std::set<std::string> classes = also;
  for (const auto& [name, evidence] : belief) classes.insert(name);
  for (const std::string& name : classes) {
    if (!name.empty()) out.names.push_back(name);
  }
  // Bayes in logarithms: prior times the likelihood of all evidence.
  const double other =
      (1 - kPriorNone) / static_cast<double>(std::max<std::size_t>(2, out.names.size()) - 1);
  std::vector<double> logs;
  for (const std::string& truth : out.names) {
    double log_p = std::log(truth.empty() ? kPriorNone : other);
    for (const auto& [name, evidence] : belief) {
      log_p += scale * evidence * std::log(Emission(truth, name));
    }
    logs.push_back(log_p);
  }
  // Normalised; the largest is taken out first, so that nothing underflows.
  const double largest = *std::max_element(logs.begin(), logs.end());
  double sum = 0.0;
  for (const double log_p : logs) out.probabilities.push_back(std::exp(log_p - largest));
  for (const double p : out.probabilities) sum += p;
  for (double& p : out.probabilities) p /= sum;
  return out;
}

}  // namespace

double ClassLikelihood(const std::map<std::string, double>& belief,
                       const std::string& observed) {
  const Posterior posterior = PosteriorOf(belief, {observed});
  double likelihood = 0.0;
  for (std::size_t i = 0; i < posterior.names.size(); ++i) {
    likelihood += posterior.probabilities[i] * Emission(posterior.names[i], observed);
  }
  return likelihood;
}

std::string BelievedClass(const std::map<std::string, double>& belief) {
  const Posterior posterior = PosteriorOf(belief, {});
  const auto best =
      std::max_element(posterior.probabilities.begin(), posterior.probabilities.end());
  return posterior.names[static_cast<std::size_t>(best - posterior.probabilities.begin())];
}

double SameClassOdds(const std::map<std::string, double>& one,
                     const std::map<std::string, double>& other) {
  std::set<std::string> classes;
  for (const auto& [name, evidence] : one) classes.insert(name);
  for (const auto& [name, evidence] : other) classes.insert(name);
  const Posterior p = PosteriorOf(one, classes), q = PosteriorOf(other, classes);
  const Posterior prior = PosteriorOf({}, classes);
  double odds = 0.0;
  for (std::size_t i = 0; i < p.names.size(); ++i) {
    odds += p.probabilities[i] * q.probabilities[i] / prior.probabilities[i];
  }
  return odds;
}

void UpdateClassBelief(MapPlane& map_plane, const std::string& class_name, double score) {
  constexpr double kMinScore = 0.1;  // a detection that was reported is evidence of something
  map_plane.class_belief[class_name] +=
      class_name.empty() ? 1.0 : std::clamp(score, kMinScore, 1.0);
  map_plane.class_name = BelievedClass(map_plane.class_belief);
}

}  // namespace slam

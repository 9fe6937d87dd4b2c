#include "slam/places/train_vocabulary.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>
#include <set>

#include "slam/base/random.h"
#include "slam/base/require.h"
#include "slam/features/match_features.h"

namespace slam {
namespace {

constexpr int kBits = 256;               // in a descriptor
constexpr int kMoreThanAll = kBits + 1;  // more bits than any two descriptors differ in
constexpr double kTooFarSquared = 1e9;   // more than the square of that

using Members = std::vector<const Descriptor*>;

/// First centres (k-means++): each next one is drawn in proportion to the squared distance to
/// the nearest so far.
std::vector<Descriptor> FirstCentres(const Members& members, int count, Random& random) {
  std::vector<Descriptor> centres{
      *members[static_cast<std::size_t>(random.Below(static_cast<int>(members.size())))]};
  std::vector<double> squares(members.size(), kTooFarSquared);
  while (static_cast<int>(centres.size()) < count) {
    double sum = 0;
    for (std::size_t i = 0; i < members.size(); ++i) {
      const double distance = DescriptorDistance(*members[i], centres.back());
      squares[i] = std::min(squares[i], distance * distance);
      sum += squares[i];
    }
    if (!(sum > 0)) break;  // fewer different descriptors than centres
    double left = random.Uniform() * sum;
    std::size_t chosen = 0;
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (!(squares[i] > 0)) continue;
      chosen = i;
      left -= squares[i];
      if (left < 0) break;
    }
    centres.push_back(*members[chosen]);
  }
  return centres;
}

/// Position of the nearest centre; the first at a tie.
std::size_t NearestCentre(const Descriptor& descriptor,
                          const std::vector<Descriptor>& centres) {
  std::size_t nearest = 0;
  int smallest = kMoreThanAll;
  for (std::size_t c = 0; c < centres.size(); ++c) {
    const int distance = DescriptorDistance(descriptor, centres[c]);
    if (distance < smallest) {
      smallest = distance;
      nearest = c;
    }
  }
  return nearest;
}

/// Bits that most members have; a tie keeps the bit as it was.
Descriptor Majority(const Members& members, const Descriptor& before) {
  std::array<int, kBits> ones{};
  for (const Descriptor* member : members) {
    for (std::size_t bit = 0; bit < ones.size(); ++bit) {
      ones[bit] += ((*member)[bit / 8] >> (bit % 8)) & 1;
    }
  }
  Descriptor out = before;
  for (std::size_t bit = 0; bit < ones.size(); ++bit) {
    const int twice = 2 * ones[bit], all = static_cast<int>(members.size());
    const auto mask = static_cast<std::uint8_t>(1u << (bit % 8));
    if (twice > all) out[bit / 8] = static_cast<std::uint8_t>(out[bit / 8] | mask);
    if (twice < all) out[bit / 8] = static_cast<std::uint8_t>(out[bit / 8] & ~mask);
  }
  return out;
}

/// Centres, and by centre the members that are nearest to it.
struct Clusters {
  std::vector<Descriptor> centres;
  std::vector<Members> members;
};

/// Divides the members among centres until these stay (k-majority).
Clusters Cluster(const Members& members, const TrainingConfig& config, Random random) {
  Clusters out;
  out.centres = FirstCentres(members, config.branching, random);
  for (int i = 0; i < config.iterations; ++i) {
    out.members.assign(out.centres.size(), {});
    for (const Descriptor* member : members) {
      out.members[NearestCentre(*member, out.centres)].push_back(member);
    }
    const std::vector<Descriptor> before = out.centres;
    for (std::size_t c = 0; c < out.centres.size(); ++c) {
      if (!out.members[c].empty()) out.centres[c] = Majority(out.members[c], before[c]);
    }
    if (out.centres == before) break;
  }
  // Divide them as the finished tree will.
  out.members.assign(out.centres.size(), {});
  for (const Descriptor* member : members) {
    out.members[NearestCentre(*member, out.centres)].push_back(member);
  }
  return out;
}

/// Weights by word: ln(images / images that have the word).
std::vector<float> Weigh(const Vocabulary& tree,
                         const std::vector<std::vector<Descriptor>>& images) {
  std::vector<int> having(static_cast<std::size_t>(tree.words()));
  for (const auto& image : images) {
    std::set<int> words;
    for (const Descriptor& descriptor : image) words.insert(tree.Word(descriptor));
    for (const int word : words) ++having[static_cast<std::size_t>(word)];
  }
  std::vector<float> weights;
  weights.reserve(having.size());
  const auto all = static_cast<double>(images.size());
  for (const int count : having) {
    weights.push_back(static_cast<float>(std::log(all / std::max(count, 1))));
  }
  return weights;
}

}  // namespace

Vocabulary TrainVocabulary(const std::vector<std::vector<Descriptor>>& images,
                           const TrainingConfig& config,
                           const std::function<void(double done)>& progress) {
  Require(config.branching >= 2 && config.branching <= 256 && config.depth >= 1 &&
              config.depth <= 8 && config.iterations >= 1 && config.min_members >= 1,
          "TrainVocabulary: a setting is outside its domain");
  struct Task {
    std::size_t node;
    int level;
    Members members;
  };
  // The root is to be divided, with all descriptors.
  std::vector<VocabularyNode> nodes(1);
  std::deque<Task> tasks{{0, 0, {}}};
  for (const auto& image : images) {
    for (const Descriptor& descriptor : image) tasks.front().members.push_back(&descriptor);
  }
  const auto total = static_cast<double>(tasks.front().members.size());
  Require(total > 0, "TrainVocabulary: no descriptor to learn from");
  double divided = 0;
  // Breadth first: the children of a node stand side by side, in the order of their parents.
  while (!tasks.empty()) {
    const Task task = std::move(tasks.front());
    tasks.pop_front();
    if (task.level == config.depth ||
        task.members.size() < static_cast<std::size_t>(config.min_members)) {
      continue;
    }
    const Clusters clusters = Cluster(task.members, config, Random{config.seed, task.node});
    divided += static_cast<double>(task.members.size());
    if (progress) progress(std::min(1.0, divided / (total * config.depth)));
    if (clusters.centres.size() < 2) continue;
    nodes[task.node].first_child = static_cast<int>(nodes.size());
    nodes[task.node].children = static_cast<int>(clusters.centres.size());
    for (std::size_t c = 0; c < clusters.centres.size(); ++c) {
      tasks.push_back({nodes.size(), task.level + 1, clusters.members[c]});
      nodes.push_back({clusters.centres[c], 0, 0, -1});
    }
  }
  const auto leaves = std::count_if(nodes.begin(), nodes.end(),
                                    [](const VocabularyNode& n) { return n.children == 0; });
  const Vocabulary even(nodes, std::vector<float>(static_cast<std::size_t>(leaves), 1.0f));
  return {nodes, Weigh(even, images)};
}

}  // namespace slam

#include "slam/places/vocabulary.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

#include "io/input_error.h"
#include "io/read_file.h"
#include "slam/base/require.h"
#include "slam/features/match_features.h"

namespace slam {
namespace {

// The file: magic, version, nodes, words, checksum of what follows; the nodes (centre, index of
// the first child, children); the weights by word. Little-endian.
constexpr std::string_view kMagic = "PASWORDS";
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kHeader = 8 + 4 + 4 + 4 + 8, kNode = 32 + 4 + 4, kWeight = 4;

/// FNV-1a, 64 bits.
std::uint64_t Checksum(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325ull;
  for (const char c : bytes) hash = (hash ^ static_cast<std::uint8_t>(c)) * 0x100000001b3ull;
  return hash;
}

template <typename T>
void Put(std::string& bytes, T value) {
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    bytes.push_back(static_cast<char>(static_cast<std::uint8_t>(value >> (8 * i))));
  }
}

template <typename T>
T Take(std::string_view& bytes) {
  T value = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    value = static_cast<T>(
        value | static_cast<T>(static_cast<T>(static_cast<std::uint8_t>(bytes[i])) << (8 * i)));
  }
  bytes.remove_prefix(sizeof(T));
  return value;
}

VocabularyNode TakeNode(std::string_view& bytes) {
  VocabularyNode node;
  std::memcpy(node.centre.data(), bytes.data(), node.centre.size());
  bytes.remove_prefix(node.centre.size());
  node.first_child = static_cast<int>(Take<std::uint32_t>(bytes));
  node.children = static_cast<int>(Take<std::uint32_t>(bytes));
  return node;
}

}  // namespace

double Likeness(const WordBag& a, const WordBag& b) {
  double shared = 0;
  auto j = b.begin();
  for (const auto& [word, weight] : a) {
    while (j != b.end() && j->first < word) ++j;
    if (j == b.end()) break;
    if (j->first == word) shared += std::min(weight, j->second);
  }
  return shared;
}

Vocabulary::Vocabulary(std::vector<VocabularyNode> nodes, std::vector<float> weights)
    : nodes_(std::move(nodes)), weights_(std::move(weights)) {
  constexpr const char* kNoTree =
      "Vocabulary: the nodes are no tree with a weight for each leaf";
  Require(!nodes_.empty(), kNoTree);
  // Number the leaves; children must follow in the order of their parents.
  std::size_t next = 1, words = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    VocabularyNode& node = nodes_[i];
    if (node.children == 0) {
      node.word = static_cast<int>(words++);
      continue;
    }
    Require(node.children > 0 && next > i && node.first_child == static_cast<int>(next) &&
                nodes_.size() - next >= static_cast<std::size_t>(node.children),
            kNoTree);
    next += static_cast<std::size_t>(node.children);
  }
  Require(next == nodes_.size() && words == weights_.size(), kNoTree);
  for (const float weight : weights_) Require(weight >= 0 && std::isfinite(weight), kNoTree);
}

Vocabulary Vocabulary::Read(const std::filesystem::path& file) {
  return Parse(io::ReadFile(file, "make one with pas vocabulary"), file.string());
}

Vocabulary Vocabulary::Parse(std::string_view bytes, const std::string& name) {
  const std::string mend = "; make one with pas vocabulary";
  if (bytes.size() < kHeader || bytes.substr(0, kMagic.size()) != kMagic) {
    throw io::InputError(name, "is no vocabulary of binary words" + mend);
  }
  bytes.remove_prefix(kMagic.size());
  if (const auto version = Take<std::uint32_t>(bytes); version != kVersion) {
    throw io::InputError(name, "is a vocabulary of version " + std::to_string(version) +
                                   ", expected " + std::to_string(kVersion) + mend);
  }
  const std::size_t nodes = Take<std::uint32_t>(bytes), words = Take<std::uint32_t>(bytes);
  const auto checksum = Take<std::uint64_t>(bytes);
  if (bytes.size() != nodes * kNode + words * kWeight || Checksum(bytes) != checksum) {
    throw io::InputError(name, "is damaged: its length or checksum is wrong" + mend);
  }
  std::vector<VocabularyNode> tree(nodes);
  for (VocabularyNode& node : tree) node = TakeNode(bytes);
  std::vector<float> weights(words);
  for (float& weight : weights) weight = std::bit_cast<float>(Take<std::uint32_t>(bytes));
  try {
    return Vocabulary(std::move(tree), std::move(weights));
  } catch (const std::invalid_argument& fault) {
    throw io::InputError(name, fault.what() + mend);
  }
}

std::string Vocabulary::Bytes() const {
  std::string body;
  for (const VocabularyNode& node : nodes_) {
    body.append(reinterpret_cast<const char*>(node.centre.data()), node.centre.size());
    Put(body, static_cast<std::uint32_t>(node.first_child));
    Put(body, static_cast<std::uint32_t>(node.children));
  }
  for (const float weight : weights_) Put(body, std::bit_cast<std::uint32_t>(weight));
  std::string bytes(kMagic);
  Put(bytes, kVersion);
  Put(bytes, static_cast<std::uint32_t>(nodes_.size()));
  Put(bytes, static_cast<std::uint32_t>(weights_.size()));
  Put(bytes, Checksum(body));
  return bytes + body;
}

int Vocabulary::Word(const Descriptor& descriptor) const {
  const VocabularyNode* node = &nodes_.front();
  while (node->children > 0) {
    const VocabularyNode* nearest = nullptr;
    int smallest = std::numeric_limits<int>::max();
    for (int c = 0; c < node->children; ++c) {
      const VocabularyNode& child = nodes_[static_cast<std::size_t>(node->first_child + c)];
      const int distance = DescriptorDistance(descriptor, child.centre);
      if (distance >= smallest) continue;
      smallest = distance;
      nearest = &child;
    }
    node = nearest;
  }
  return node->word;
}

WordBag Vocabulary::Bag(const std::vector<PointFeature>& features) const {
  std::map<int, double> weights;
  for (const PointFeature& feature : features) {
    const int word = Word(feature.descriptor);
    const auto weight = static_cast<double>(weights_[static_cast<std::size_t>(word)]);
    if (weight > 0) weights[word] += weight;
  }
  // Weights are shares: their sum is one.
  double sum = 0;
  for (const auto& [word, weight] : weights) sum += weight;
  WordBag bag(weights.begin(), weights.end());
  for (auto& [word, weight] : bag) weight /= sum;
  return bag;
}

}  // namespace slam

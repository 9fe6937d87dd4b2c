#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "slam/model/frame.h"

namespace slam {

/// An image as binary words: (word, weight), words ascending, weights positive with sum one.
/// Empty for an image without features.
using WordBag = std::vector<std::pair<int, double>>;

/// Likeness of two images in [0, 1]: 1 - |a - b|_1 / 2, which is the weight that they share.
/// Source: Nister and Stewenius 2006, as used by Galvez-Lopez and Tardos 2012.
double Likeness(const WordBag& a, const WordBag& b);

/// A node of the tree of words.
struct VocabularyNode {
  Descriptor centre{};
  int first_child = 0;  ///< its children stand side by side, after it
  int children = 0;     ///< 0: a leaf, which is a word
  int word = -1;        ///< number of a leaf; -1: no leaf
};

/// A tree of binary words for ORB descriptors. A descriptor goes down to the nearest child
/// (the first at a tie) until it comes to a leaf. A word weighs the more the fewer of the
/// training images had it.
class Vocabulary {
 public:
  /// The one that comes with the program; the data are part of it, nothing is read from disk.
  static const Vocabulary& Shipped();

  /// @throws InputError naming the file when it is missing, damaged or of another version.
  static Vocabulary Read(const std::filesystem::path& file);

  /// @param name  for messages
  /// @throws InputError, see Read
  static Vocabulary Parse(std::string_view bytes, const std::string& name);

  /// @param nodes  [0] is the root; children after their parent
  /// @param weights  by word, not negative
  /// @throws std::invalid_argument when this is no tree.
  Vocabulary(std::vector<VocabularyNode> nodes, std::vector<float> weights);

  /// What Parse reads; the same vocabulary gives the same bytes on every machine.
  std::string Bytes() const;

  int words() const { return static_cast<int>(weights_.size()); }
  int Word(const Descriptor& descriptor) const;
  WordBag Bag(const std::vector<PointFeature>& features) const;

 private:
  std::vector<VocabularyNode> nodes_;
  std::vector<float> weights_;  ///< by word
};

}  // namespace slam
